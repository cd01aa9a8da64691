"""What cannot be read, and in which words it is refused."""

import pytest

from usdmotion.errors import FileError, SceneError


def test_a_file_that_is_not_there_or_not_usd_is_refused_by_name(tmp_path, read):
    with pytest.raises(FileError, match=r"none.usda: there is no such file"):
        read(tmp_path / "none.usda")
    (tmp_path / "bad.usda").write_text("#usda 1.0\ndef {")
    with pytest.raises(FileError, match=r"bad.usda: USD cannot read it: .*:2:"):
        read(tmp_path / "bad.usda")


@pytest.mark.parametrize(
    ("header", "body"),
    [
        ("subLayers = [@./gone.usda@]", ""),
        ("", 'def "Prop" (references = @./gone.usda@) {}'),
        ("", 'def "Prop" (references = </Gone>) {}'),
    ],
)
def test_a_stage_that_does_not_compose_is_refused(text, save, read, header, body):
    with pytest.raises(SceneError, match=r"shot.usda: <.*> does not compose: .*(gone|Gone)"):
        read(save(text.man() + body, header=header))


def test_arrays_of_a_wrong_length_are_refused(text, save, read):
    animation = text.poses(scales=False) + "\nhalf3[] scales = [(1, 1, 1)]"
    with pytest.raises(SceneError, match="</Man/Walk> has 1 scales at its default for 4 joints"):
        read(save(text.man(animation=animation)))


@pytest.mark.parametrize(
    ("turn", "why"), [("(0.5, 0, 0, 0)", "length one"), ("(nan, 0, 0, 0)", "length one")]
)
def test_a_rotation_that_is_none_is_refused(text, save, read, turn, why):
    animation = f"""uniform token[] joints = ["hip"]
    float3[] translations = [(0, 1, 0)]
    half3[] scales = [(1, 1, 1)]
    quatf[] rotations.timeSamples = {{ 1: [(1, 0, 0, 0)], 2: [{turn}] }}"""
    with pytest.raises(SceneError, match=rf"</Man/Walk> has a rotation .*{why}"):
        read(save(text.man(animation=animation)))


def test_a_quaternion_of_zeros_is_no_rotation_as_usd_has_it(text, save, check):
    animation = """uniform token[] joints = ["hip"]
    float3[] translations = [(0, 1, 0)]
    half3[] scales = [(1, 1, 1)]
    quatf[] rotations.timeSamples = { 1: [(0, 0, 0, 0)], 2: [(0, 0, 0, 0)] }"""
    check(save(text.man(animation=animation)))


def test_a_translation_that_is_no_number_is_refused(text, save, read):
    animation = """uniform token[] joints = ["hip"]
    float3[] translations = [(0, nan, 0)]
    half3[] scales = [(1, 1, 1)]
    quatf[] rotations = [(1, 0, 0, 0)]"""
    with pytest.raises(SceneError, match="</Man/Walk> has a translation that is not a number"):
        read(save(text.man(animation=animation)))


def test_a_sheared_goal_is_refused(text, first):
    sheared = """def MotionGoal "Goal" {
        matrix4d xformOp:transform = ((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }"""
    with pytest.raises(SceneError, match="Hold/Goal> is sheared"):
        first(text.hold(sheared))


def test_more_faults_than_one_are_counted(text, save, read):
    bad = text.hold(attributes='uniform token usdmotion:axes = "w"')
    worse = text.hold(name="Other", attributes='uniform token usdmotion:axes = "v"')
    with pytest.raises(SceneError, match="and 1 more, which `usdmotion inspect` lists"):
        read(save(text.man(edit=text.edit(bad + worse))))


def test_an_animation_of_other_joints_is_refused(text, save, read):
    free = text.edit(attributes="rel usdmotion:source = </Run>")
    run = f'def SkelAnimation "Run" {{\n{text.poses(joints=("tail",))}\n}}'
    with pytest.raises(SceneError, match="</Run> has none of the joints of </Man/Bones>"):
        read(save(text.man(edit=free) + run))


def test_an_animation_that_names_a_joint_twice_is_refused(text, save, read):
    with pytest.raises(SceneError, match="</Man/Walk> lists the joint 'hip' more than once"):
        read(save(text.man(animation=text.poses(joints=("hip", "hip/knee", "hip")))))

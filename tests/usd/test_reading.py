"""What is read from edits, constraints and goals, and what is refused."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import usd
from usdmotion.constraints import Constraint, attribute, built_in
from usdmotion.errors import FileError, SceneError

SOURCE_LAYER = "timeCodesPerSecond = 24\nmetersPerUnit = 0.01"


def edit(inside="", name="Edit", attributes=""):
    return f'\ndef MotionEdit "{name}" {{\n{attributes}\n{inside}\n}}\n'


def hold(inside="", name="Hold", kind="MotionPositionConstraint", attributes=""):
    return (
        f'\ndef {kind} "{name}" {{\nuniform token usdmotion:joint = "hip/knee/ankle"\n'
        f"{attributes}\n{inside}\n}}\n"
    )


def goal(attributes="", name="Goal", translate="(1, 2, 3)"):
    return f"""
    def MotionGoal "{name}" {{
        double3 xformOp:translate = {translate}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        {attributes}
    }}
    """


@pytest.fixture
def first(text, save, read):
    """Return a function that reads the first constraint of a man with some edit."""

    def run(inside, body="", **options):
        path = save(text.man(edit=edit(inside), **options) + body, header=SOURCE_LAYER)
        (scene,) = read(path).scenes
        return scene.constraints[0]

    return run


# When an edit is solved ---------------------------------------------------------------------------


def codes(text, save, read, attributes="", animation=None, header="metersPerUnit = 1", **options):
    body = text.man(edit=edit(attributes=attributes), animation=animation)
    return read(save(body, header=header), **options).scenes[0].time_codes.tolist()


def test_an_edit_is_solved_at_the_samples_of_its_source(text, save, read):
    animation = text.poses((-1, 2.5, 9))
    assert codes(text, save, read, animation=animation) == [-1, 2.5, 9]


def test_a_range_keeps_the_samples_inside_its_ends_and_those_on_them(text, save, read):
    span = "uniform timecode[] usdmotion:range = [2.0000005, 4]"
    assert codes(text, save, read, span) == [2, 3, 4]


def test_frames_of_the_caller_overrule_the_range(text, save, read):
    span = "uniform timecode[] usdmotion:range = [2, 4]"
    assert codes(text, save, read, span, frames=(4, 9)) == [4, 5]


def test_a_range_without_a_sample_is_refused(text, save, read):
    with pytest.raises(SceneError, match="</Man/Bones/Edit> has no sample of its source from 7"):
        codes(text, save, read, frames=(7, 9))
    with pytest.raises(SceneError, match="swap the two"):
        codes(text, save, read, frames=(4, 2))


def test_a_sample_rate_makes_even_samples_that_end_where_the_range_does(text, save, read):
    rate = "uniform double usdmotion:sampleRate = 12"
    assert codes(text, save, read, rate) == [1, 3, 5]
    assert codes(text, save, read, rate, frames=(1, 4)) == [1, 3, 4]


STILL = """uniform token[] joints = ["hip"]
float3[] translations = [(0, 1, 0)]
quatf[] rotations = [(1, 0, 0, 0)]
half3[] scales = [(1, 1, 1)]"""


def test_a_source_that_does_not_move_is_solved_on_the_frames_of_the_stage(text, save, read):
    header = "startTimeCode = 10\nendTimeCode = 16\ntimeCodesPerSecond = 48\nframesPerSecond = 24"
    assert codes(text, save, read, animation=STILL, header=header) == [10, 12, 14, 16]


def test_a_source_that_does_not_move_on_a_stage_without_range_is_one_frame(text, save, check):
    shot = check(save(text.man(animation=STILL)))
    assert shot.scenes[0].time_codes.tolist() == [0]


def test_seconds_are_counted_from_the_first_frame_that_is_solved(text, save, read):
    path = save(text.man(edit=edit(hold(attributes="uniform timecode[] usdmotion:times = [2, 4]"))))
    (scene,) = read(path, frames=(3, 5)).scenes
    assert scene.constraints[0].times == (-1 / 24, 1 / 24)
    np.testing.assert_allclose(scene.cast.times, (0, 1 / 24, 2 / 24))


# Which edits --------------------------------------------------------------------------------------


def test_edits_can_be_chosen_by_their_paths(text, save, read):
    path = save(text.man("Ann") + text.man("Bob"))
    (scene,) = read(path, edits=["/Bob/Bones/Edit"]).scenes
    assert scene.edits[0].path == "/Bob/Bones/Edit"


def test_an_edit_that_is_not_there_is_refused_with_those_that_are(text, save, read):
    with pytest.raises(SceneError, match="</No> is no MotionEdit; there are: /Man/Bones/Edit"):
        read(save(text.man()), edits=["/No"])


def test_a_stage_without_edits_is_refused(text, save, read):
    with pytest.raises(SceneError, match="no MotionEdit to solve"):
        read(save(text.man(edit="")))


def test_an_edit_that_is_not_active_is_not_there(text, save, read):
    off = 'def MotionEdit "Off" (active = false) {}'
    (scene,) = read(save(text.man(edit=edit() + off))).scenes
    assert [each.path for each in scene.edits] == ["/Man/Bones/Edit"]


def test_two_edits_of_one_skeleton_are_refused(text, save, read):
    path = save(text.man(edit=edit() + edit(name="Other")))
    with pytest.raises(SceneError, match="</Man/Bones/Edit> and </Man/Bones/Other> both solve"):
        read(path)
    assert read(path, edits=["/Man/Bones/Other"]).takes[0].result == "/Man/Bones/Other_result"


def test_an_edit_anywhere_names_its_skeleton_and_its_source(text, save, read):
    free = edit(attributes="rel usdmotion:skeleton = </Man/Bones>\nrel usdmotion:source = </Run>")
    run = f'def SkelAnimation "Run" {{\n{text.poses((7, 8), seed=5)}\n}}'
    shot = read(save(text.man(edit="") + free + run))
    assert shot.takes[0].source == "/Run"
    assert shot.scenes[0].time_codes.tolist() == [7, 8]
    assert shot.takes[0].result == "/Edit_result"


@pytest.mark.parametrize(
    "attribute",
    ["uniform double usdmotion:smoothing = 6", "uniform int usdmotion:passes = 2"],
)
def test_what_this_version_cannot_do_is_refused_by_name(text, save, read, attribute):
    name = attribute.split()[2]
    with pytest.raises(SceneError, match=f"</Man/Bones/Edit> sets {name}, which this version"):
        read(save(text.man(edit=edit(attributes=attribute))))


def test_solver_and_options_are_read_as_authored(text, save, read):
    attributes = """uniform token usdmotion:solver = "ccd"
    custom int usdmotion:option:iterations = 7
    custom double usdmotion:option:gain = 0.25
    custom bool usdmotion:option:finish = false"""
    (scene,) = read(save(text.man(edit=edit(attributes=attributes)))).scenes
    assert scene.edits[0].solver == "ccd"
    assert scene.edits[0].options == {"iterations": 7, "gain": 0.25, "finish": False}


# What the scene is --------------------------------------------------------------------------------


def test_the_root_is_the_topmost_joint_that_travels_and_carries_the_body(text, save, read):
    joints = ("world", "world/hip", "world/hip/knee", "world/hip/knee/ankle")
    rest = f"uniform matrix4d[] restTransforms = {text.listed([text.at(0, 1, 0)] * 4)}"
    animation = f"""uniform token[] joints = {text.quoted(joints)}
    half3[] scales = {text.listed([(1, 1, 1)] * 4)}
    quatf[] rotations = {text.listed([(1, 0, 0, 0)] * 4)}
    float3[] translations.timeSamples = {{
        1: [(0, 0, 0), (0, 9, 0), (0, -4, 0), (0, -4, 0)],
        2: [(0, 0, 0), (1, 9, 0), (0, -5, 0), (0, -4, 0)],
    }}"""
    path = save(text.man(joints=joints, rest=rest, bind="", animation=animation))
    assert read(path).scenes[0].characters[0].root == 1


def test_a_joint_that_only_stretches_is_not_the_root(text, save, read):
    animation = f"""uniform token[] joints = {text.quoted(text.JOINTS)}
    half3[] scales = {text.listed([(1, 1, 1)] * 4)}
    quatf[] rotations = {text.listed([(1, 0, 0, 0)] * 4)}
    float3[] translations.timeSamples = {{
        1: [(0, 9, 0), (0, -4, 0), (0, -4, 0), (0, 4, 0)],
        2: [(0, 9, 0), (0, -4, 0), (0, -4, 0), (0, 5, 0)],
    }}"""
    assert read(save(text.man(animation=animation))).scenes[0].characters[0].root == 0


BODY = """
    uniform token[] usdmotion:parts = ["", "sacroiliac", "", ""]
    uniform float[] usdmotion:masses = [1, 2, 3, 4]
    uniform point3f[] usdmotion:massCenters = [(0, 0, 0), (0, 10, 0), (0, 0, 0), (0, 0, 0)]
    uniform float3[] usdmotion:limitsMax = [(inf, inf, inf), (10, 0, 0), (1, 2, 3), (4, 5, 6)]
"""


def test_a_body_is_read_in_metres_and_degrees(text, save, read):
    man = text.man(skeleton=BODY, xform=SCALED).replace(
        'def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI"])',
        'def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI", "MotionSkeletonAPI"])',
    )
    character = read(save(man, header="metersPerUnit = 0.01")).scenes[0].characters[0]
    assert character.root == 1
    assert character.body.masses.tolist() == [1, 2, 3, 4]
    np.testing.assert_allclose(character.body.mass_centers[1], (0, 0.2, 0))
    assert character.body.limits_max[3].tolist() == [4, 5, 6]
    assert np.isneginf(character.body.limits_min).all()


SCALED = """float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:scale"]"""


# Constraints --------------------------------------------------------------------------------------


def test_every_attribute_of_a_constraint_is_read_in_our_units(first):
    held = first(
        hold(
            attributes="""uniform int usdmotion:priority = 3
            double usdmotion:weight = 0.5
            double usdmotion:activity.timeSamples = { 1: 0, 5: 1 }
            uniform timecode[] usdmotion:times = [1, 2, 4, 5]
            uniform point3d usdmotion:point = (1, 2, 3)
            uniform token[] usdmotion:recruits = ["hip/knee", "hip"]
            uniform double usdmotion:tolerance = 0.5
            uniform token usdmotion:axes = "xz"
        """
        )
    )
    assert (held.priority, held.weight, held.axes) == (3, 0.5, "xz")
    np.testing.assert_allclose(held.activity, (0, 0.25, 0.5, 0.75, 1))
    np.testing.assert_allclose(held.times, (0, 1 / 24, 3 / 24, 4 / 24))
    np.testing.assert_allclose(held.point, (0.01, 0.02, 0.03))
    assert held.recruits == ("hip/knee", "hip")
    assert held.tolerance == pytest.approx(0.005)
    assert held.path == "/Man/Bones/Edit/Hold"
    assert held.skeleton == "/Man/Bones"


def test_a_tolerance_of_a_rotation_stays_in_degrees_and_quaternions_become_xyzw(first):
    held = first(
        hold(
            kind="MotionOrientationConstraint",
            attributes="""uniform double usdmotion:tolerance = 0.5
            uniform quatf usdmotion:rotation = (0.8, 0, 0.6, 0)
            uniform vector3f usdmotion:freeAxis = (0, 1, 0)
        """,
        )
    )
    assert held.tolerance == 0.5
    np.testing.assert_allclose(held.rotation, (0, 0.6, 0, 0.8), rtol=1e-6)
    assert held.free_axis.tolist() == [0, 1, 0]


def test_an_activity_may_be_a_spline(first):
    held = first(hold(attributes="double usdmotion:activity.spline = { 1: 0, 3: 1 }"))
    assert np.shape(held.activity) == (5,)
    assert held.activity[0] == 0.0
    assert held.activity[-1] == 1.0


def test_what_is_animated_but_does_not_change_is_one_value(first):
    held = first(hold(attributes="double usdmotion:activity.timeSamples = { 1: 0.5, 5: 0.5 }"))
    assert held.activity == 0.5


def test_key_times_follow_the_offsets_of_layers(text, save, read):
    times = "uniform timecode[] usdmotion:times = [1, 2]"
    save(text.man(edit=edit(hold(attributes=times))), "asset.usda", "metersPerUnit = 1")
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 10; scale = 3)) {}'
    (scene,) = read(save(body)).scenes
    assert scene.constraints[0].times == (0, 3 / 24)


def test_a_point_in_a_scaled_joint_is_in_metres(text, save, read):
    point = hold(attributes="uniform point3d usdmotion:point = (1, 0, 0)")
    animation = (
        text.poses(scales=False)
        + """
    half3[] scales = [(2, 2, 2), (1, 1, 1), (3, 1, 1), (1, 1, 1)]"""
    )
    man = text.man(edit=edit(point), xform=SCALED, animation=animation)
    (scene,) = read(save(man, header=SOURCE_LAYER)).scenes
    np.testing.assert_allclose(scene.constraints[0].point, (0.01 * 2 * 2 * 3, 0, 0))


def test_constraints_are_read_at_any_depth_in_the_order_of_the_stage(text, save, read):
    inside = hold(name="B") + f'def Scope "Feet" {{\n{hold(name="A")}\n}}' + hold(name="C")
    (scene,) = read(save(text.man(edit=edit(inside)))).scenes
    assert [each.path.rsplit("/", 1)[1] for each in scene.constraints] == ["B", "A", "C"]


@pytest.mark.parametrize("kind", ["MotionStudioConstraint", "MotionSomethingConstraint"])
def test_a_constraint_that_nobody_can_solve_is_refused_by_name(text, save, read, kind):
    path = save(text.man(edit=edit(hold(kind=kind))))
    with pytest.raises(SceneError, match=f"</Man/Bones/Edit/Hold> is a {kind}, which nothing"):
        read(path)


def test_a_constraint_that_is_not_active_may_be_anything(text, save, read):
    off = 'def MotionStudioConstraint "Off" (active = false) {}'
    assert read(save(text.man(edit=edit(off)))).scenes[0].constraints == ()


@pytest.mark.parametrize(
    ("attribute", "why"),
    [
        ('uniform token[] usdmotion:recruits = ["hip", "nose"]', "'nose'"),
        ('uniform token usdmotion:axes = "w"', "'w' in usdmotion:axes"),
        ("uniform timecode[] usdmotion:times = [3, 2]", "sort them"),
    ],
)
def test_a_constraint_at_fault_is_refused_in_the_words_of_its_fault(
    text, save, read, attribute, why
):
    with pytest.raises(SceneError, match=rf"shot.usda: </Man/Bones/Edit/Hold>.*{why}"):
        read(save(text.man(edit=edit(hold(attributes=attribute)))))


# Goals --------------------------------------------------------------------------------------------


def test_a_goal_is_where_its_parents_in_the_stage_put_it(first):
    place = """double3 xformOp:translate = (100, 0, 0)
    double xformOp:rotateZ = 90
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]"""
    (found,) = first(hold(goal()), xform=place).goals
    np.testing.assert_allclose(found.translation, (0.98, 0.01, 0.03), atol=1e-12)
    half = np.sqrt(0.5)
    np.testing.assert_allclose(found.rotation, (0, 0, half, half), atol=1e-12)
    np.testing.assert_allclose(found.axes, (0, 0, half, half), atol=1e-12)
    assert found.joint is None


PROP = """def Xform "Prop" {
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (0, 0, 40) }
    double xformOp:rotateZ = 90
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]
}"""


def test_a_goal_follows_the_prim_that_is_its_space(first):
    (found,) = first(hold(goal("rel usdmotion:space = </Prop>")), PROP).goals
    assert found.translation.shape == (5, 3)
    np.testing.assert_allclose(found.translation[0], (-0.04, 0.02, 0.06), atol=1e-12)
    np.testing.assert_allclose(found.translation[4], (-0.04, 0.02, 0.46), atol=1e-12)
    assert found.rotation.shape == (4,)


def test_an_offset_is_turned_and_sized_but_not_moved_by_its_space(first):
    attributes = 'rel usdmotion:space = </Prop>\nuniform token usdmotion:mode = "offset"'
    (found,) = first(hold(goal(attributes)), PROP).goals
    assert found.mode == "offset"
    np.testing.assert_allclose(found.translation, (-0.04, 0.02, 0.06), atol=1e-12)
    np.testing.assert_allclose(found.rotation, (0, 0, 0, 1), atol=1e-12)


def test_an_offset_of_an_orientation_is_told_in_the_axes_of_its_space(first):
    turned = """def MotionGoal "Goal" {
        double xformOp:rotateX = 90
        uniform token[] xformOpOrder = ["xformOp:rotateX"]
        rel usdmotion:space = </Prop>
        uniform token usdmotion:mode = "offset"
    }"""
    (found,) = first(hold(turned), PROP).goals
    half = np.sqrt(0.5)  # about x, in a space that is turned by 90 degrees: about y
    np.testing.assert_allclose(found.rotation, (0, half, 0, half), atol=1e-12)


def test_a_goal_in_the_frame_of_a_joint_is_local_to_it(first):
    attributes = 'rel usdmotion:space = </Man/Bones>\nuniform token usdmotion:spaceJoint = "hip"'
    (found,) = first(hold(goal(attributes)), xform=SCALED).goals
    assert found.joint == ("/Man/Bones", "hip")
    np.testing.assert_allclose(found.translation, (0.02, 0.04, 0.06))


def test_a_skeleton_without_a_joint_is_a_space_like_any_prim(first):
    (found,) = first(hold(goal("rel usdmotion:space = </Man/Bones>")), xform=SCALED).goals
    assert found.joint is None
    np.testing.assert_allclose(found.translation, (0.02, 0.04, 0.06))


def test_a_joint_of_no_skeleton_is_refused(first):
    with pytest.raises(SceneError, match="Edit/Hold/Goal> names the joint 'hip' in"):
        first(hold(goal('uniform token usdmotion:spaceJoint = "hip"')))


def test_several_goals_are_read_in_order_with_their_own_activities(first):
    inside = goal("double usdmotion:activity = 0.25", "A") + goal(
        "uniform timecode[] usdmotion:times = [2, 3]", "B"
    )
    a, b = first(hold(inside)).goals
    assert (a.activity, a.times) == (0.25, ())
    np.testing.assert_allclose(b.times, (1 / 24, 2 / 24))


# Characters together ------------------------------------------------------------------------------


def joint_goal(who, joint="hip"):
    return goal(
        f'rel usdmotion:space = </{who}/Bones>\nuniform token usdmotion:spaceJoint = "{joint}"'
    )


def test_a_goal_in_the_joint_of_another_makes_it_a_character_of_the_scene(text, save, check):
    ann = text.man("Ann", edit=edit(hold(joint_goal("Bob"))))
    bob = text.man("Bob", edit="", animation=text.poses((1, 9), seed=4), xform=SCALED)
    shot = check(save(ann + bob))
    (scene,) = shot.scenes
    assert [each.path for each in scene.characters] == ["/Ann/Bones", "/Bob/Bones"]
    assert len(scene.edits) == 1


def test_edits_coupled_through_a_joint_share_a_scene_and_their_times(text, save, check):
    ann = text.man("Ann", edit=edit(hold(joint_goal("Bob"))))
    bob = text.man("Bob", animation=text.poses((2, 3.5, 9), seed=4))
    eve = text.man("Eve")
    shot = check(save(eve + ann + bob), law=False)
    assert [[each.path for each in scene.edits] for scene in shot.scenes] == [
        ["/Eve/Bones/Edit"],
        ["/Ann/Bones/Edit", "/Bob/Bones/Edit"],
    ]
    assert shot.scenes[1].time_codes.tolist() == [1, 2, 3, 3.5, 4, 5, 9]


def test_edits_that_look_at_the_same_bystander_are_still_solved_alone(text, save, read):
    ann, eve = (text.man(name, edit=edit(hold(joint_goal("Bob")))) for name in ("Ann", "Eve"))
    assert len(read(save(ann + eve + text.man("Bob", edit=""))).scenes) == 2


def test_a_joint_that_its_skeleton_does_not_have_is_refused(text, save, read):
    ann = text.man("Ann", edit=edit(hold(joint_goal("Bob", "tail"))))
    with pytest.raises(SceneError, match=r"'tail'.*</Bob/Bones> does not have"):
        read(save(ann + text.man("Bob")))


# What cannot be read ------------------------------------------------------------------------------


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


def test_a_sheared_goal_is_refused(first):
    sheared = """def MotionGoal "Goal" {
        matrix4d xformOp:transform = ((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }"""
    with pytest.raises(SceneError, match="Hold/Goal> is sheared"):
        first(hold(sheared))


def test_more_faults_than_one_are_counted(text, save, read):
    bad = hold(attributes='uniform token usdmotion:axes = "w"')
    worse = hold(name="Other", attributes='uniform token usdmotion:axes = "v"')
    with pytest.raises(SceneError, match="and 1 more, which `usdmotion inspect` lists"):
        read(save(text.man(edit=edit(bad + worse))))


@dataclass(frozen=True, eq=False, kw_only=True)
class StudioConstraint(Constraint):
    """A kind that some plugin brings."""

    schema: ClassVar[str] = "MotionStudioConstraint"
    strength: float = attribute(2.0, animated=True)
    reach: float = attribute(0.0, unit="length")
    names: tuple[str, ...] = attribute(())


def test_a_kind_of_a_plugin_is_read_like_our_own(text, save):
    attributes = """custom double usdmotion:strength.timeSamples = { 1: 0, 5: 4 }
    custom double usdmotion:reach = 50
    custom token[] usdmotion:names = ["a", "b"]"""
    body = text.man(edit=edit(hold(kind="MotionStudioConstraint", attributes=attributes)))
    shot = usd.read(save(body, header=SOURCE_LAYER), kinds=[*built_in(), StudioConstraint])
    (held,) = shot.scenes[0].constraints
    assert isinstance(held, StudioConstraint)
    np.testing.assert_allclose(held.strength, (0, 1, 2, 3, 4))
    assert (held.reach, held.names, held.joint) == (0.5, ("a", "b"), "hip/knee/ankle")


def test_a_value_that_is_blocked_for_a_while_is_refused(first):
    with pytest.raises(SceneError, match="Edit/Hold> has nan in usdmotion:weight at 2"):
        first(hold(attributes="double usdmotion:weight.timeSamples = { 1: 3, 2: None, 4: 5 }"))


def test_an_animation_of_other_joints_is_refused(text, save, read):
    free = edit(attributes="rel usdmotion:source = </Run>")
    run = f'def SkelAnimation "Run" {{\n{text.poses(joints=("tail",))}\n}}'
    with pytest.raises(SceneError, match="</Run> has none of the joints of </Man/Bones>"):
        read(save(text.man(edit=free) + run))


def test_an_animation_that_names_a_joint_twice_is_refused(text, save, read):
    with pytest.raises(SceneError, match="</Man/Walk> lists the joint 'hip' more than once"):
        read(save(text.man(animation=text.poses(joints=("hip", "hip/knee", "hip")))))

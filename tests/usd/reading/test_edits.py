"""Which edits are solved, of which skeletons, and what of a body."""

import numpy as np
import pytest

from usdmotion.errors import SceneError


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
    (scene,) = read(save(text.man(edit=text.edit() + off))).scenes
    assert [each.path for each in scene.edits] == ["/Man/Bones/Edit"]


def test_two_edits_of_one_skeleton_are_refused(text, save, read):
    path = save(text.man(edit=text.edit() + text.edit(name="Other")))
    with pytest.raises(SceneError, match="</Man/Bones/Edit> and </Man/Bones/Other> both solve"):
        read(path)
    assert read(path, edits=["/Man/Bones/Other"]).takes[0].result == "/Man/Bones/Other_result"


def test_an_edit_anywhere_names_its_skeleton_and_its_source(text, save, read):
    free = text.edit(
        attributes="rel usdmotion:skeleton = </Man/Bones>\nrel usdmotion:source = </Run>"
    )
    run = f'def SkelAnimation "Run" {{\n{text.poses((7, 8), seed=5)}\n}}'
    shot = read(save(text.man(edit="") + free + run))
    assert shot.takes[0].source == "/Run"
    assert shot.scenes[0].time_codes.tolist() == [7, 8]
    assert shot.takes[0].result == "/Edit_result"


def test_smoothing_and_passes_are_read_as_authored(text, save, read):
    attributes = "uniform double usdmotion:smoothing = 6\nuniform int usdmotion:passes = 3"
    (scene,) = read(save(text.man(edit=text.edit(attributes=attributes)))).scenes
    assert (scene.edits[0].smoothing, scene.edits[0].passes) == (6.0, 3)


def test_cleaning_is_read_as_authored_or_as_given(text, save, read):
    path = save(text.man(edit=text.edit(attributes="uniform double usdmotion:cleaning = 8")))
    for given, expected in ((None, 8.0), (12.0, 12.0), (0.0, 0.0)):
        (scene,) = read(path, cleaning=given).scenes
        assert scene.edits[0].cleaning == expected
    (scene,) = read(save(text.man())).scenes
    assert scene.edits[0].cleaning == 0.0


@pytest.mark.parametrize("cutoff", ["-1", "inf", "nan"])
def test_a_cutoff_that_is_none_is_refused(text, save, read, cutoff):
    attribute = f"uniform double usdmotion:cleaning = {cutoff}"
    with pytest.raises(SceneError, match=r"</Man/Bones/Edit> .*usdmotion:cleaning"):
        read(save(text.man(edit=text.edit(attributes=attribute))))


def test_solver_and_options_are_read_as_authored(text, save, read):
    attributes = """uniform token usdmotion:solver = "ccd"
    custom int usdmotion:option:iterations = 7
    custom double usdmotion:option:gain = 0.25
    custom bool usdmotion:option:finish = false"""
    (scene,) = read(save(text.man(edit=text.edit(attributes=attributes)))).scenes
    assert scene.edits[0].solver == "ccd"
    assert scene.edits[0].options == {"iterations": 7, "gain": 0.25, "finish": False}


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
    man = text.man(skeleton=BODY, xform=text.SCALED).replace(
        'def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI"])',
        'def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI", "MotionSkeletonAPI"])',
    )
    character = read(save(man, header="metersPerUnit = 0.01")).scenes[0].characters[0]
    assert character.root == 1
    assert character.body.masses.tolist() == [1, 2, 3, 4]
    np.testing.assert_allclose(character.body.mass_centers[1], (0, 0.2, 0))
    assert character.body.limits_max[3].tolist() == [4, 5, 6]
    assert np.isneginf(character.body.limits_min).all()

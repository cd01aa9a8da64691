"""The sixteen things that USD characters do in the wild; UsdSkel itself says what is right."""

import numpy as np
import pytest
from pxr import Usd

from usdmotion.errors import SceneError


def test_rest_transforms_may_be_missing_where_every_joint_is_animated(text, save, check):
    shot = check(save(text.man(rest="")))
    assert len(shot.scenes[0].time_codes) == 5


def test_missing_rest_transforms_of_a_joint_that_needs_them_are_refused(text, save, read):
    path = save(text.man(rest="", animation=text.poses(joints=("hip", "hip/knee"))))
    with pytest.raises(SceneError, match=r"</Man/Bones> has no restTransforms.*'hip/knee/ankle'"):
        read(path)


def test_bind_transforms_may_be_missing(text, save, check):
    check(save(text.man(bind="")))


def test_bind_transforms_may_be_identities_on_unskinned_joints(text, save, check):
    bind = f"uniform matrix4d[] bindTransforms = {text.listed([text.IDENTITY] * 4)}"
    check(save(text.man(bind=bind)))


def test_the_rest_pose_may_be_another_than_the_bind_pose(text, save, check):
    rest = "uniform matrix4d[] restTransforms = " + text.listed(
        f"( (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), ({x}, 2, 3, 1) )" for x in range(4)
    )
    shot = check(save(text.man(rest=rest, animation=text.poses(joints=("hip", "hip/knee")))))
    skeleton = shot.scenes[0].characters[0].skeleton
    np.testing.assert_allclose(skeleton.rest_translations[3], (3, 2, 3))
    half = np.sqrt(0.5)
    np.testing.assert_allclose(skeleton.rest_rotations[3], (0, 0, half, half), atol=1e-12)


def test_meshes_may_name_some_joints_in_an_order_of_their_own(text, save, check):
    mesh = """
    def Mesh "Skin" (prepend apiSchemas = ["SkelBindingAPI"]) {
        uniform token[] skel:joints = ["hip/head", "hip"]
        rel skel:skeleton = </Man/Bones>
        int[] primvars:skel:jointIndices = [0, 1] (
            elementSize = 2
            interpolation = "constant"
        )
        float[] primvars:skel:jointWeights = [0.5, 0.5] (
            elementSize = 2
            interpolation = "constant"
        )
    }"""
    shot = check(save(text.man(inside=mesh)))
    assert shot.scenes[0].characters[0].skeleton.joints == text.JOINTS


def test_an_animation_may_cover_some_joints_in_another_order_and_the_others_rest(text, save, check):
    joints = ("hip/head", "elsewhere", "hip")
    shot = check(save(text.man(animation=text.poses(joints=joints))))
    motion = shot.scenes[0].characters[0].motion
    np.testing.assert_allclose(motion.translations[:, 1], [text.OFFSETS[1]] * 5)
    assert shot.takes[0].joints == joints


def test_an_animation_without_scales_shows_the_rest_pose_and_so_it_is_read(text, save, check):
    shot = check(save(text.man(animation=text.poses(scales=False))), law=False)
    motion = shot.scenes[0].characters[0].motion
    np.testing.assert_allclose(motion.translations[0], text.OFFSETS)


@pytest.mark.parametrize("rate", [24, 23.976, 29.97, 60])
def test_layers_may_have_different_time_codes_per_second(text, save, check, rate, skel):
    save(text.man(), "asset.usda", f"timeCodesPerSecond = {rate}\nmetersPerUnit = 1")
    body = 'def "World" {\ndef "Man" (references = @./asset.usda@</Man>) {}\n}'
    path = save(body, header="timeCodesPerSecond = 48\nmetersPerUnit = 1")
    shot = check(path)
    motion = shot.scenes[0].characters[0].motion
    np.testing.assert_allclose(motion.times, np.arange(5) / rate, rtol=1e-12)
    np.testing.assert_allclose(shot.scenes[0].time_codes, np.arange(1, 6) * 48 / rate)


def test_times_may_be_negative_and_layer_offsets_may_have_a_scale(text, save, check):
    save(text.man(animation=text.poses((-7, -3, 0, 0.5))), "asset.usda", "metersPerUnit = 1")
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 10; scale = 0.5)) {}'
    shot = check(save(body))
    np.testing.assert_allclose(shot.scenes[0].time_codes, (6.5, 8.5, 10, 10.25))
    np.testing.assert_allclose(shot.scenes[0].characters[0].motion.times[-1], 3.75 / 24)


@pytest.mark.parametrize("unit", [1, 0.01])
def test_units_may_be_mixed_by_reference(text, save, check, unit):
    save(text.man(), "asset.usda", "metersPerUnit = 0.01")
    body = """def Xform "Man" (references = @./asset.usda@</Man>) {
        double3 xformOp:scale = (0.5, 0.5, 0.5)
        double3 xformOp:translate = (3, 2, 1)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }"""
    shot = check(save(body, header=f"metersPerUnit = {unit}"))
    rest = shot.scenes[0].characters[0].skeleton.rest_translations
    np.testing.assert_allclose(rest[2], np.array(text.OFFSETS[2]) * 0.5 * unit)


@pytest.mark.parametrize(("axis", "up"), [("Y", (0, 1, 0)), ("Z", (0, 0, 1))])
def test_either_axis_may_be_up(text, save, check, axis, up):
    shot = check(save(text.man(), header=f'upAxis = "{axis}"'))
    assert tuple(shot.scenes[0].up) == up


def test_a_skeleton_may_stand_under_a_moving_uniformly_scaled_root(text, save, check):
    shot = check(save(text.man(xform=text.MOVING)))
    motion = shot.scenes[0].characters[0].motion
    lengths = np.linalg.norm(motion.translations[:, 1], axis=1)
    np.testing.assert_allclose(lengths, np.linspace(2, 3, 5) * np.sqrt(17), rtol=1e-6)


@pytest.mark.parametrize(
    ("scale", "why"), [("(1, 2, 1)", "unevenly"), ("(-1, 1, 1)", "mirrored"), ("(0, 0, 0)", "noth")]
)
def test_any_other_scale_of_the_root_is_refused_by_name(text, save, read, scale, why):
    xform = f'float3 xformOp:scale = {scale}\nuniform token[] xformOpOrder = ["xformOp:scale"]'
    with pytest.raises(SceneError, match=rf"shot.usda: </Man/Bones>.*{why}"):
        read(save(text.man(xform=xform)))


def test_a_scale_that_is_uneven_only_for_a_while_is_refused_too(text, save, read):
    xform = """float3 xformOp:scale.timeSamples = { 1: (1, 1, 1), 3: (1, 1.1, 1), 5: (1, 1, 1) }
    uniform token[] xformOpOrder = ["xformOp:scale"]"""
    with pytest.raises(SceneError, match="</Man/Bones> is scaled unevenly"):
        read(save(text.man(xform=xform)))


def test_there_may_be_several_skeletons(text, save, check):
    path = save(text.man("Ann") + text.man("Bob", animation=text.poses((1, 4), seed=3)))
    shot = check(path)
    assert [len(scene.time_codes) for scene in shot.scenes] == [5, 2]


INSTANCED = """
class "Assets" {
%s
}
def Xform "One" (
    instanceable = true
    prepend references = </Assets/Man>
    %s
) {
    %s
}
def MotionEdit "Edit" {
    rel usdmotion:skeleton = </One/Bones>
}
"""
WALK = 'def SkelAnimation "Walk" {\n%s\n}'
ON_INSTANCE = "rel skel:animationSource = </Walk>"


def instanced(text, **options):
    asset = text.man(edit="", **options)
    api = 'prepend apiSchemas = ["SkelBindingAPI"]'
    return INSTANCED % (asset, api, ON_INSTANCE) + WALK % text.poses()


def test_an_instance_may_be_bound_from_outside(text, save, check):
    shot = check(save(instanced(text, on_skeleton="")))
    assert shot.takes[0].holder == "/One"


def test_an_instance_with_a_binding_inside_is_refused(text, save, read):
    body = instanced(text, on_skeleton="rel skel:animationSource = </Assets/Man/Walk>")
    with pytest.raises(SceneError, match=r"</One/Bones> is inside an instance and .*out of reach"):
        read(save(body))


def test_an_instance_with_two_skeletons_cannot_be_bound_from_outside(text, save, read):
    second = f'def Skeleton "More" {{\nuniform token[] joints = ["a"]\n{text.REST}\n}}'
    body = instanced(text, on_skeleton="", inside=second.replace(text.REST, ""))
    with pytest.raises(SceneError, match="</One/Bones> is inside an instance with </One/More>"):
        read(save(body))


def test_an_edit_inside_an_instance_is_refused(text, save, read):
    asset = text.man()
    with pytest.raises(SceneError, match="</One/Bones/Edit> is inside an instance"):
        read(save(INSTANCED % (asset, "", "")), edits=["/One/Bones/Edit"])


@pytest.mark.parametrize("where", ["root", "skeleton", "inherited"])
def test_the_animation_may_be_bound_on_the_root_on_the_skeleton_or_above(text, save, check, where):
    if where == "root":
        body = text.man(on_root=True, on_skeleton="")
    elif where == "skeleton":
        body = text.man()
    else:
        inner = text.man(on_skeleton="", home="All/Man")
        api = '(prepend apiSchemas = ["SkelBindingAPI"])'
        body = f'def SkelRoot "All" {api} {{ rel skel:animationSource = </All/Man/Walk>\n{inner} }}'
    shot = check(save(body))
    assert shot.takes[0].source.endswith("/Walk")


def test_leaf_names_may_be_equal_under_different_parents(text, save, check):
    joints = ("hip", "hip/left", "hip/right", "hip/left/foot", "hip/right/foot")
    rest = "uniform matrix4d[] restTransforms = " + text.listed(
        text.at(*place) for place in [(0, 9, 0), (1, -1, 0), (-1, -1, 0), (0, -4, 1), (0, -4, 2)]
    )
    animation = text.poses(joints=("hip/right/foot", "hip"))
    shot = check(save(text.man(joints=joints, rest=rest, bind="", animation=animation)))
    motion = shot.scenes[0].characters[0].motion
    assert np.ptp(motion.rotations[:, 3], axis=0).max() == 0.0
    assert np.ptp(motion.rotations[:, 4], axis=0).max() > 0.1


def test_quaternions_may_flip_their_signs_between_samples(text, save, check, skel):
    flipped = f"""uniform token[] joints = {text.quoted(text.JOINTS)}
    float3[] translations = {text.listed(text.OFFSETS)}
    half3[] scales = {text.listed([(1, 1, 1)] * 4)}
    quatf[] rotations.timeSamples = {{
        1: [(1, 0, 0, 0), (0.8, 0.6, 0, 0), (1, 0, 0, 0), (0.6, 0, 0.8, 0)],
        5: [(-1, 0, 0, 0), (-0.6, -0.8, 0, 0), (0.8, 0, 0.6, 0), (-0.8, 0, -0.6, 0)],
    }}"""
    path = save(text.man(animation=flipped, edit=EVEN))
    shot = check(path)
    assert len(shot.scenes[0].time_codes) == 9


EVEN = """def MotionEdit "Edit" {
    uniform double usdmotion:sampleRate = 48
}"""


def test_helper_joints_without_skin_are_joints_like_any_other(text, save, check):
    joints = (*text.JOINTS, "helper", "helper/tip")
    rest = "uniform matrix4d[] restTransforms = " + text.listed([text.IDENTITY] * 6)
    shot = check(save(text.man(joints=joints, rest=rest, bind="")))
    assert shot.scenes[0].characters[0].skeleton.parents.tolist() == [-1, 0, 1, 0, -1, 4]


EXTRAS = """
    uniform token[] blendShapes = ["smile", "frown"]
    float[] blendShapeWeights.timeSamples = { 1: [0.1, 0], 5: [1, 0.3] }
    custom double studio:mood.timeSamples = { 2: 0.25, 3: 0.75 }
    custom string studio:note = "keep me"
    custom rel studio:prop = </Man>
    double studio:curve.spline = { 0: 0, 10: 1 }
"""


def test_blend_shapes_and_custom_attributes_survive(text, save, check, tmp_path):
    save(text.man(animation=text.poses() + EXTRAS), "asset.usda", "metersPerUnit = 1")
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 100; scale = 2)) {}'
    check(save(body))
    stage = Usd.Stage.Open(str(tmp_path / "written" / "composed.usda"))
    old, new = (stage.GetPrimAtPath(f"/Man/{name}") for name in ("Walk", "Bones/Edit_result"))
    for name in ("blendShapes", "blendShapeWeights", "studio:mood", "studio:note", "studio:curve"):
        for code in (0, 101, 103.3, 105, 107, 110, 200):
            assert new.GetAttribute(name).Get(code) == old.GetAttribute(name).Get(code), name
    assert new.GetAttribute("studio:mood").GetTimeSamples() == [104, 106]
    assert new.GetAttribute("studio:curve").HasSpline()
    assert new.GetRelationship("studio:prop").GetTargets() == ["/Man"]

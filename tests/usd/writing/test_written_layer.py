"""What is in the layer that is written."""

import os

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import usd
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion


def array(stage, path, name, code):
    return np.asarray(stage.GetPrimAtPath(path).GetAttribute(name).Get(code))


RESULT = "/Man/Bones/Edit_result"


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usd"])
def test_what_was_solved_is_what_usd_shows(shot, solved, skel, suffix, bent):
    result = bent(shot, move=0.5)
    stage = solved(shot, result, suffix=suffix)
    transforms = skel.query(stage, "/Man/Bones").ComputeJointLocalTransforms(3)
    found = np.array(transforms[1].ExtractTranslation())
    np.testing.assert_allclose(found, result.motion.translations[2, 1], atol=1e-6)
    turn = transforms[1].ExtractRotationQuat()
    quaternion = np.array([*turn.GetImaginary(), turn.GetReal()])
    np.testing.assert_allclose(np.abs(quaternion @ result.motion.rotations[2, 1]), 1.0, atol=1e-6)


def test_a_result_in_a_scaled_space_is_written_in_its_own_units(
    text, save, read, solved, skel, bent
):
    xform = """float3 xformOp:scale.timeSamples = { 1: (2, 2, 2), 5: (4, 4, 4) }
    uniform token[] xformOpOrder = ["xformOp:scale"]"""
    animation = (
        text.poses(scales=False)
        + """
    half3[] scales = [(0.5, 0.5, 0.5), (1, 1, 1), (1, 1, 1), (1, 1, 1)]"""
    )
    path = save(text.man(xform=xform, animation=animation), header="metersPerUnit = 0.01")
    shot = read(path)
    before = array(Usd.Stage.Open(str(path)), "/Man/Walk", "translations", 3)
    stage = solved(shot, bent(shot, move=0.03))
    moved = array(stage, RESULT, "translations", 3) - before
    np.testing.assert_allclose(moved[1], 0.03 / 0.01 / 3 / 0.5, rtol=1e-5)
    assert not moved[[0, 2, 3]].any()


def test_what_has_not_changed_keeps_every_bit(shot, solved, bent):
    stage = solved(shot, bent(shot, frames=slice(2, 4)))
    for name in ("translations", "rotations", "scales"):
        for code in (1, 2, 3, 4, 5):
            old, new = (array(stage, path, name, code) for path in ("/Man/Walk", RESULT))
            changed = {(1, "rotations")} if code in (3, 4) else set()
            for joint in range(4):
                same = old[joint].tobytes() == new[joint].tobytes()
                assert same == ((joint, name) not in changed)


def test_outside_the_solved_range_the_samples_of_the_source_are_copied(
    text, save, read, solved, bent
):
    shot = read(save(text.man()), frames=(2, 4))
    stage = solved(shot, bent(shot))
    attribute = stage.GetPrimAtPath(RESULT).GetAttribute("rotations")
    assert attribute.GetTimeSamples() == [1, 2, 3, 4, 5]
    old = array(stage, "/Man/Walk", "rotations", 5)
    assert old.tobytes() == array(stage, RESULT, "rotations", 5).tobytes()


def test_a_joint_that_its_source_does_not_cover_is_added_when_it_changes(
    text, save, read, solved, skel, bent
):
    shot = read(save(text.man(animation=text.poses(joints=("hip/head", "tail", "hip")))))
    stage = solved(shot, bent(shot))
    animation = stage.GetPrimAtPath(RESULT)
    joints = ["hip/head", "tail", "hip", "hip/knee"]
    assert list(animation.GetAttribute("joints").Get()) == joints
    still = skel.query(stage, "/Man/Bones").ComputeJointLocalTransforms(2)
    np.testing.assert_allclose(np.array(still[2])[3, :3], text.OFFSETS[2])
    np.testing.assert_allclose(np.array(still[1])[3, :3], text.OFFSETS[1])
    assert not np.allclose(np.array(still[1])[:3, :3], np.eye(3))


def test_a_source_that_shows_the_rest_pose_has_a_result_of_all_joints(
    text, save, read, solved, bent
):
    shot = read(save(text.man(animation=text.poses(scales=False))))
    stage = solved(shot, bent(shot))
    animation = stage.GetPrimAtPath(RESULT)
    assert tuple(animation.GetAttribute("joints").Get()) == text.JOINTS
    np.testing.assert_allclose(animation.GetAttribute("translations").Get(0), text.OFFSETS)


def test_what_a_result_adds_to_its_source_has_continuous_signs(text, save, read, solved):
    turns = [(np.cos(a), np.sin(a), 0, 0) for a in np.linspace(0, 2, 5)]
    flips = [1, -1, -1, 1, -1]
    animation = """uniform token[] joints = ["hip"]
    float3[] translations = [(0, 1, 0)]
    half3[] scales = [(1, 1, 1)]
    quatf[] rotations.timeSamples = """ + text.sampled(
        {
            code: f"[{tuple(float(flip * each) for each in turn)}]"
            for code, flip, turn in zip(range(1, 6), flips, turns, strict=True)
        }
    )
    shot = read(save(text.man(animation=animation)))
    angles = np.linspace(0.1, 12.0, 5)  # twice around
    motion = shot.scenes[0].characters[0].motion
    added = from_vector(angles[:, None] * (1.0, 0.0, 0.0))
    rotations = motion.rotations.copy()
    rotations[:, 0] = multiply(rotations[:, 0], added)
    result = usd.Result(
        "/Man/Bones/Edit", Motion(motion.times, motion.translations, rotations), "x", {}
    )
    stage = solved(shot, result)
    codes = (1, 2, 3, 4, 5)
    old = np.array([array(stage, "/Man/Walk", "rotations", code)[0] for code in codes])
    new = np.array([array(stage, RESULT, "rotations", code)[0] for code in codes])
    found = multiply(new, old * (-1, -1, -1, 1))
    assert (np.einsum("fi,fi->f", found[1:], found[:-1]) > 0).all()
    np.testing.assert_allclose(np.abs(np.einsum("fi,fi->f", new, rotations[:, 0])), 1, atol=1e-6)


def test_the_layer_says_where_it_comes_from(shot, solved, tmp_path, bent):
    stage = solved(shot, bent(shot))
    animation = stage.GetPrimAtPath(RESULT)
    assert animation.HasAPI("MotionResultAPI")
    edit, source = (animation.GetRelationship(f"usdmotion:result:{n}") for n in ("edit", "source"))
    assert edit.GetTargets() == ["/Man/Bones/Edit"]
    assert source.GetTargets() == ["/Man/Walk"]
    data = Sdf.Layer.FindOrOpen(str(tmp_path / "edit.usda")).customLayerData["usdmotion"]
    digest = animation.GetAttribute("usdmotion:result:inputHash").Get()
    assert data["solver"] == animation.GetAttribute("usdmotion:result:solver").Get() == "bender"
    assert data["version"] == animation.GetAttribute("usdmotion:result:version").Get()
    assert data["options"] == {"/Man/Bones/Edit": {"angle": 0.3}}
    assert data["hashes"] == {"/Man/Bones/Edit": digest}
    assert len(digest) == 64
    assert str(tmp_path) not in (tmp_path / "edit.usda").read_text()


HEADER = """timeCodesPerSecond = 48
framesPerSecond = 24
metersPerUnit = 0.01
upAxis = "Z"
startTimeCode = -3
endTimeCode = 99
defaultPrim = "Man\""""


def test_every_layer_carries_the_rates_units_and_axis_of_the_stage(
    text, save, read, solved, tmp_path, bent
):
    shot = read(save(text.man(), header=HEADER))
    solved(shot, bent(shot))
    for name in ("edit.usda", "composed.usda"):
        layer = Sdf.Layer.FindOrOpen(str(tmp_path / name))
        assert (layer.timeCodesPerSecond, layer.framesPerSecond) == (48, 24)
        assert (layer.startTimeCode, layer.endTimeCode) == (-3, 99)
        assert layer.pseudoRoot.GetInfo("metersPerUnit") == 0.01
        assert layer.pseudoRoot.GetInfo("upAxis") == "Z"


def test_the_composed_layer_is_tiny_and_opens_anywhere(text, save, read, tmp_path, bent):
    shot = read(save(text.man(), header=HEADER))
    (tmp_path / "out").mkdir()
    usd.write(shot, [bent(shot)], tmp_path / "out" / "shot.edit.usdc")
    usd.compose(shot, tmp_path / "out" / "shot.edit.usdc", tmp_path / "all.usda")
    layer = Sdf.Layer.FindOrOpen(str(tmp_path / "all.usda"))
    assert list(layer.subLayerPaths) == ["./out/shot.edit.usdc", "./shot.usda"]
    assert layer.defaultPrim == "Man"
    assert layer.pseudoRoot.GetInfo("fallbackPrimTypes")["MotionGoal"] == ["Xform"]
    assert not list(layer.rootPrims)
    os.rename(tmp_path, tmp_path.with_name("elsewhere"))
    moved = Usd.Stage.Open(str(tmp_path.with_name("elsewhere") / "all.usda"))
    assert not moved.GetCompositionErrors()
    assert moved.GetPrimAtPath(RESULT)

"""The layer that is written: what is in it, and that it is there whole or not at all."""

import os

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import usd
from usdmotion.errors import FileError, SceneError
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion


def bent(shot, joint="hip/knee", *, angle=0.3, move=0.0, frames=slice(None)):
    """Return a result in which one joint of the first edit is turned, and moved."""
    scene = shot.scenes[0]
    character = scene.character(scene.edits[0].skeleton)
    index = character.skeleton.index[joint]
    motion = character.motion
    translations, rotations = motion.translations.copy(), motion.rotations.copy()
    turn = from_vector(np.array((angle, 0.0, 0.0)))
    rotations[frames, index] = multiply(rotations[frames, index], turn)
    translations[frames, index] += move
    return usd.Result(
        scene.edits[0].path,
        Motion(motion.times, translations, rotations),
        "bender",
        {"angle": angle},
    )


@pytest.fixture
def shot(text, save, read):
    return read(save(text.man()))


@pytest.fixture
def solved(tmp_path):
    """Return a function that writes results over a shot and opens the stage that shows them."""

    def run(shot, *results, suffix=".usda"):
        layer, composed = tmp_path / f"edit{suffix}", tmp_path / "composed.usda"
        usd.write(shot, results, layer)
        usd.compose(shot, layer, composed)
        return Usd.Stage.Open(str(composed))

    return run


def array(stage, path, name, code):
    return np.asarray(stage.GetPrimAtPath(path).GetAttribute(name).Get(code))


RESULT = "/Man/Bones/Edit_result"


# What is in it ------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usd"])
def test_what_was_solved_is_what_usd_shows(shot, solved, skel, suffix):
    result = bent(shot, move=0.5)
    stage = solved(shot, result, suffix=suffix)
    transforms = skel.query(stage, "/Man/Bones").ComputeJointLocalTransforms(3)
    found = np.array(transforms[1].ExtractTranslation())
    np.testing.assert_allclose(found, result.motion.translations[2, 1], atol=1e-6)
    turn = transforms[1].ExtractRotationQuat()
    quaternion = np.array([*turn.GetImaginary(), turn.GetReal()])
    np.testing.assert_allclose(np.abs(quaternion @ result.motion.rotations[2, 1]), 1.0, atol=1e-6)


def test_a_result_in_a_scaled_space_is_written_in_its_own_units(text, save, read, solved, skel):
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


def test_what_has_not_changed_keeps_every_bit(shot, solved):
    stage = solved(shot, bent(shot, frames=slice(2, 4)))
    for name in ("translations", "rotations", "scales"):
        for code in (1, 2, 3, 4, 5):
            old, new = (array(stage, path, name, code) for path in ("/Man/Walk", RESULT))
            changed = {(1, "rotations")} if code in (3, 4) else set()
            for joint in range(4):
                same = old[joint].tobytes() == new[joint].tobytes()
                assert same == ((joint, name) not in changed)


def test_outside_the_solved_range_the_samples_of_the_source_are_copied(text, save, read, solved):
    shot = read(save(text.man()), frames=(2, 4))
    stage = solved(shot, bent(shot))
    attribute = stage.GetPrimAtPath(RESULT).GetAttribute("rotations")
    assert attribute.GetTimeSamples() == [1, 2, 3, 4, 5]
    old = array(stage, "/Man/Walk", "rotations", 5)
    assert old.tobytes() == array(stage, RESULT, "rotations", 5).tobytes()


def test_a_joint_that_its_source_does_not_cover_is_added_when_it_changes(
    text, save, read, solved, skel
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


def test_a_source_that_shows_the_rest_pose_has_a_result_of_all_joints(text, save, read, solved):
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


def test_the_layer_says_where_it_comes_from(shot, solved, tmp_path):
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
    text, save, read, solved, tmp_path
):
    shot = read(save(text.man(), header=HEADER))
    solved(shot, bent(shot))
    for name in ("edit.usda", "composed.usda"):
        layer = Sdf.Layer.FindOrOpen(str(tmp_path / name))
        assert (layer.timeCodesPerSecond, layer.framesPerSecond) == (48, 24)
        assert (layer.startTimeCode, layer.endTimeCode) == (-3, 99)
        assert layer.pseudoRoot.GetInfo("metersPerUnit") == 0.01
        assert layer.pseudoRoot.GetInfo("upAxis") == "Z"


def test_the_composed_layer_is_tiny_and_opens_anywhere(text, save, read, tmp_path):
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


# Solving again ------------------------------------------------------------------------------------


def test_a_stage_that_carries_its_result_gives_the_same_result_again(
    text, save, read, solved, tmp_path
):
    shot = read(save(text.man()))
    solved(shot, bent(shot))
    first = (tmp_path / "edit.usda").read_bytes()
    again = read(tmp_path / "composed.usda")
    assert again.takes[0].source == "/Man/Walk"
    usd.write(again, [bent(again)], tmp_path / "second.usda")
    assert (tmp_path / "second.usda").read_bytes() == first


def test_another_edit_stacks_on_a_result_and_keeps_its_place_when_the_first_is_solved_again(
    text, save, read, tmp_path
):
    edits = "\n".join(f'def MotionEdit "{name}" {{}}' for name in ("One", "Two"))
    path = save(text.man(edit=edits))
    for name in ("One", "Two"):
        shot = read(path, edits=[f"/Man/Bones/{name}"])
        usd.write(shot, [bent(shot)], tmp_path / f"{name}.usda")
        usd.compose(shot, tmp_path / f"{name}.usda", tmp_path / f"with{name}.usda")
        path = tmp_path / f"with{name}.usda"
    assert read(path, edits=["/Man/Bones/Two"]).takes[0].source == "/Man/Bones/One_result"
    first = read(path, edits=["/Man/Bones/One"])
    assert first.takes[0].source == "/Man/Walk"
    assert first.takes[0].bound == "/Man/Bones/Two_result"


def test_a_source_made_from_its_own_result_is_refused(text, save, read, tmp_path):
    source = 'def MotionEdit "Edit" {\nrel usdmotion:source = </Man/Bones/Edit_result>\n}'
    shot = read(save(text.man(), "first.usda"))
    usd.write(shot, [bent(shot)], tmp_path / "edit.usda")
    path = save(text.man(edit=source), header="subLayers = [@./edit.usda@]")
    with pytest.raises(SceneError, match=r"</Man/Bones/Edit> starts from .* its own result"):
        read(path)


def test_something_else_where_the_result_would_go_is_refused(text, save, read):
    other = 'def Scope "Edit_result" {}\ndef MotionEdit "Edit" {}'
    with pytest.raises(SceneError, match=r"<.*Edit_result> is where the result of .* rename one"):
        read(save(text.man(edit=other)))


def test_the_hash_knows_what_was_read(text, save, read, tmp_path):
    def digest(path):
        shot = read(path)
        usd.write(shot, [bent(shot)], tmp_path / "hashed.usda")
        data = Sdf.Layer.OpenAsAnonymous(str(tmp_path / "hashed.usda")).customLayerData
        return data["usdmotion"]["hashes"]["/Man/Bones/Edit"]

    same = digest(save(text.man()))
    assert digest(save(text.man(), "copy.usda")) == same
    assert digest(save(text.man(animation=text.poses(seed=1)), "other.usda")) != same
    assert digest(save(text.man(), "units.usda", "metersPerUnit = 0.02")) != same
    constraint = 'def MotionPositionConstraint "P" {\nuniform token usdmotion:joint = "hip"\n}'
    edit = f'def MotionEdit "Edit" {{\n{constraint}\n}}'
    assert digest(save(text.man(edit=edit), "held.usda")) != same


# Whole or not at all ------------------------------------------------------------------------------


def test_an_input_is_never_written_to(text, save, read, tmp_path):
    save(text.man(), "asset.usda", "metersPerUnit = 1")
    path = save('def "Man" (references = @./asset.usda@</Man>) {}')
    shot = read(path)
    before = {each: each.read_bytes() for each in tmp_path.iterdir()}
    for name in ("asset.usda", "shot.usda"):
        with pytest.raises(FileError, match=rf"{name}: .* no input is written to"):
            usd.write(shot, [bent(shot)], tmp_path / name)
        (tmp_path / "link.usda").symlink_to(tmp_path / name)
        with pytest.raises(FileError, match="no input is written to"):
            usd.write(shot, [bent(shot)], tmp_path / "link.usda")
        (tmp_path / "link.usda").unlink()
        with pytest.raises(FileError, match="no input is written to"):
            usd.compose(shot, tmp_path / "edit.usda", tmp_path / name)
    with pytest.raises(FileError, match="no input is written to"):
        usd.compose(shot, tmp_path / "edit.usda", tmp_path / "edit.usda")
    assert {each: each.read_bytes() for each in tmp_path.iterdir()} == before


@pytest.mark.parametrize(
    ("name", "why"),
    [("edit.txt", "name a file that ends in .usda"), ("none/edit.usda", "there is no folder")],
)
def test_a_place_where_no_layer_can_be_is_refused(shot, tmp_path, name, why):
    before = sorted(tmp_path.iterdir())
    with pytest.raises(FileError, match=f"{name}: {why}"):
        usd.write(shot, [bent(shot)], tmp_path / name)
    assert sorted(tmp_path.iterdir()) == before


def test_a_layer_that_cannot_be_moved_into_its_place_leaves_nothing_behind(shot, tmp_path):
    (tmp_path / "edit.usda").mkdir()
    before = sorted(tmp_path.iterdir())
    with pytest.raises(FileError, match=r"edit.usda: cannot be written"):
        usd.write(shot, [bent(shot)], tmp_path / "edit.usda")
    assert sorted(tmp_path.iterdir()) == before


def test_a_result_that_does_not_fit_its_edit_is_refused_and_leaves_no_file(shot, tmp_path):
    motion = shot.scenes[0].characters[0].motion
    short = Motion(motion.times[:2], motion.translations[:2], motion.rotations[:2])
    with pytest.raises(SceneError, match="the result of </Man/Bones/Edit> has"):
        usd.write(shot, [usd.Result("/Man/Bones/Edit", short, "x", {})], tmp_path / "edit.usda")
    assert not (tmp_path / "edit.usda").exists()


def test_a_result_of_an_edit_that_was_not_read_is_refused(shot, tmp_path):
    motion = shot.scenes[0].characters[0].motion
    with pytest.raises(SceneError, match="a result of </Other>, which was not read"):
        usd.write(shot, [usd.Result("/Other", motion, "x", {})], tmp_path / "edit.usda")


def test_an_older_layer_is_replaced(shot, tmp_path, leave):
    output = tmp_path / "edit.usda"
    usd.write(shot, [bent(shot)], output)
    first = output.read_bytes()
    usd.write(shot, leave(shot), output)
    assert output.read_bytes() != first
    usd.write(shot, [bent(shot)], output)
    assert output.read_bytes() == first


def test_a_binary_layer_is_the_same_bytes_twice(shot, tmp_path):
    for name in ("one.usdc", "two.usdc"):
        usd.write(shot, [bent(shot)], tmp_path / name)
    assert (tmp_path / "one.usdc").read_bytes() == (tmp_path / "two.usdc").read_bytes()


def test_constraints_and_results_of_several_scenes_share_one_layer(
    text, save, read, tmp_path, leave
):
    shot = read(save(text.man("Ann") + text.man("Bob")))
    usd.write(shot, leave(shot), tmp_path / "edit.usda")
    usd.compose(shot, tmp_path / "edit.usda", tmp_path / "all.usda")
    stage = Usd.Stage.Open(str(tmp_path / "all.usda"))
    assert all(stage.GetPrimAtPath(f"/{name}/Bones/Edit_result") for name in ("Ann", "Bob"))

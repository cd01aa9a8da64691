"""Results are read back from what is shown, and told whether they are still of the shot."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import pipeline, usd
from usdmotion import solved as solved_scenes
from usdmotion.constraints import built_in
from usdmotion.errors import FileError, SceneError
from usdmotion.measuring import measure

EDIT = "/Arm/Skeleton/Edit"
SOURCE = "usdmotion:result:source"


@pytest.fixture
def solved(arm_shot, tmp_path):
    """Return what writes and solves a shot: it, its edit layer, the composed stage, the report."""

    def solve(lift=0.05, **options):
        shot = arm_shot(lift)
        edit, composed = tmp_path / "arm.edit.usda", tmp_path / "composed.usda"
        report = pipeline.solve(shot, edit, compose=composed, **options)
        return shot, edit, composed, report

    return solve


def outcome(path, shot=None):
    (found,) = usd.read_outcomes(path, shot=shot, kinds=built_in())
    return found


def errors(found):
    return measure(found.problem, found.solution, found.scene.constraints)


def test_what_is_read_back_is_what_was_solved(solved):
    _, edit, composed, report = solved(2.0)
    for path in (edit, composed):
        found = outcome(path)
        (record,) = found.records
        assert (record.edit, record.solver, record.shown) == (EDIT, "prioritized_ik", True)
        assert not record.stale
        assert record.options["iterations"] > 0
        asked = report.edits[0].constraints[0]
        assert errors(found).max() == pytest.approx(asked.max, abs=1e-6)
        assert asked.max > 1.0


def test_the_input_is_the_source_and_not_the_result(solved):
    shot, edit, _, _ = solved()
    (scene,) = usd.read(shot, kinds=built_in()).scenes
    found = outcome(edit)
    given = found.scene.characters[0].motion
    assert np.array_equal(given.rotations, scene.characters[0].motion.rotations)
    assert not np.array_equal(given.rotations, found.motions["/Arm/Skeleton"].rotations)


def test_a_result_of_what_has_changed_since_is_stale(solved, arm_shot):
    _, edit, composed, _ = solved(0.05)
    arm_shot(0.07)
    for path in (edit, composed):
        found = outcome(path)
        assert [record.stale for record in found.records] == [True]
        assert errors(found).max() == pytest.approx(0.02, abs=1e-5)


def test_frames_that_were_asked_for_are_remembered(solved):
    _, edit, _, _ = solved(frames=(3.0, 6.0))
    found = outcome(edit)
    assert found.scene.time_codes.tolist() == [3.0, 4.0, 5.0, 6.0]
    assert not found.records[0].stale


def test_notes_are_remembered(solved, monkeypatch):
    monkeypatch.setattr(solved_scenes, "broken", lambda scene: ["it"])
    monkeypatch.setattr(solved_scenes, "sentence", lambda violation: f"{violation} breaks the rule")
    _, edit, _, report = solved()
    assert outcome(edit).notes == report.notes == ("it breaks the rule",)


def test_a_result_that_is_not_bound_is_told(solved):
    _, _, composed, _ = solved()
    stage = Usd.Stage.Open(str(composed))
    (source,) = stage.GetPrimAtPath(f"{EDIT}_result").GetRelationship(SOURCE).GetTargets()
    stage.GetPrimAtPath("/Arm/Skeleton").GetRelationship("skel:animationSource").SetTargets(
        [source]
    )
    stage.GetRootLayer().Save()
    assert [record.shown for record in outcome(composed).records] == [False]


def copied(shot, suffix):
    stage = Usd.Stage.Open(str(shot))
    stage.GetRootLayer().Export(str(shot.with_suffix(suffix)))


@pytest.mark.parametrize("suffix", [".usd", ".usdc"])
def test_the_shot_is_the_file_that_the_layer_is_named_after(solved, suffix):
    shot, edit, _, _ = solved()
    copied(shot, suffix)
    shot.unlink()
    assert not outcome(edit).records[0].stale


def test_among_several_it_is_the_one_that_the_layer_was_made_from(solved, arm_shot):
    shot, edit, _, _ = solved(0.05)
    copied(shot, ".usdc")
    changed = arm_shot(0.07, name="changed.usda")
    shutil.move(changed, shot)
    assert not outcome(edit).records[0].stale
    copied(shot, ".usdc")
    with pytest.raises(SceneError, match="which of those beside it is that shot; name it with"):
        outcome(edit)


def test_a_shot_elsewhere_can_be_named(solved, tmp_path):
    shot, edit, _, _ = solved()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    moved = Path(shutil.move(shot, elsewhere / "other.usda"))
    with pytest.raises(SceneError, match="no file beside it is named as that shot"):
        outcome(edit)
    assert not outcome(edit, moved).records[0].stale


def test_what_cannot_be_is_refused(solved, arm_shot, tmp_path, save):
    shot, edit, _, _ = solved()
    with pytest.raises(SceneError, match="there is no result of a MotionEdit"):
        outcome(shot)
    with pytest.raises(FileError, match="it is no layer that `usdmotion solve` wrote"):
        outcome(shot, shot)
    with pytest.raises(SceneError, match="it has not the edits of"):
        outcome(edit, save('def Scope "Empty" {}', name="empty.usda"))
    with pytest.raises(FileError, match="there is no such file"):
        outcome(tmp_path / "absent.usda")


def test_a_result_whose_edit_is_gone_is_refused(solved):
    shot, _, composed, _ = solved()
    stage = Usd.Stage.Open(str(shot))
    stage.GetPrimAtPath(EDIT).SetActive(False)
    stage.Save()
    with pytest.raises(SceneError):
        outcome(composed)


def test_a_flattened_stage_still_has_its_result(solved, tmp_path):
    _, _, composed, _ = solved(2.0)
    flat = tmp_path / "flat.usda"
    Usd.Stage.Open(str(composed)).Flatten().Export(str(flat))
    found, before = outcome(flat), outcome(composed)
    assert np.allclose(errors(found), errors(before), atol=1e-9)
    assert replace(found.records[0], options={}).solver == "prioritized_ik"


_UNEVEN = pytest.param(
    0.3,
    marks=pytest.mark.skipif(
        Usd.GetVersion() < (0, 26, 5),
        reason="an older USD reads other values where a sample's time is rounded by an offset",
    ),
)


def shifted(path, folder, offset, scale=1.0):
    """Return a stage that shows another one at other times."""
    stage = Usd.Stage.Open(str(path))
    layer = Sdf.Layer.CreateNew(str(folder / f"at_{offset:g}_{scale:g}.usda"))
    layer.subLayerPaths = [str(path)]
    layer.subLayerOffsets[0] = Sdf.LayerOffset(offset, scale)
    shown = Usd.Stage.Open(layer)
    for name in ("TimeCodesPerSecond", "FramesPerSecond"):
        getattr(shown, f"Set{name}")(getattr(stage, f"Get{name}")())
    UsdGeom.SetStageMetersPerUnit(shown, UsdGeom.GetStageMetersPerUnit(stage))
    UsdGeom.SetStageUpAxis(shown, UsdGeom.GetStageUpAxis(stage))
    layer.Save()
    return Path(layer.realPath)


@pytest.mark.parametrize("frames", [None, (3.0, 6.0)])
@pytest.mark.parametrize("offset", [100.0, -7.0, 0.25, _UNEVEN])
def test_a_result_that_is_shown_later_with_its_shot_is_not_stale(solved, tmp_path, offset, frames):
    _, _, composed, _ = solved(2.0, frames=frames)
    before, found = outcome(composed), outcome(shifted(composed, tmp_path, offset))
    assert not found.records[0].stale
    assert np.allclose(found.scene.time_codes, before.scene.time_codes + offset)
    assert np.allclose(errors(found), errors(before), atol=1e-9)


def test_a_result_that_is_shown_slower_is_stale(solved, tmp_path):
    _, _, composed, _ = solved()
    assert outcome(shifted(composed, tmp_path, 0.0, 2.0)).records[0].stale


def test_a_result_is_stale_where_only_its_shot_is_shown_later(solved, tmp_path):
    shot, edit, _, _ = solved()
    assert outcome(edit, shifted(shot, tmp_path, 100.0)).records[0].stale


def hold(rotations):
    rotations.Set(rotations.Get(5.0), 4.0)


def delay(rotations):
    rotations.Set(rotations.Get(4.0), 4.5)
    rotations.ClearAtTime(4.0)


def lighten(rotations):
    rotations.GetPrim().GetAttribute("studio:mood").Set(1.0, 5.0)


def begin_later(rotations):
    edit = rotations.GetStage().GetPrimAtPath(EDIT)
    edit.GetAttribute("usdmotion:range").Set(Sdf.TimeCodeArray([4.0, 7.0]))


@pytest.fixture
def moody(arm_shot):
    """Return a shot whose source holds more than joints, solved on some of its frames."""
    shot = arm_shot(0.05)
    stage = Usd.Stage.Open(str(shot))
    mood = source_on(stage).CreateAttribute("studio:mood", Sdf.ValueTypeNames.Float)
    for code in (2.0, 5.0):
        mood.Set(code / 10.0, code)
    stage.GetPrimAtPath(EDIT).GetAttribute("usdmotion:range").Set(Sdf.TimeCodeArray([3.0, 7.0]))
    stage.Save()
    return shot


def source_on(stage):
    (source,) = (each for each in stage.Traverse() if each.GetTypeName() == "SkelAnimation")
    return source


@pytest.mark.parametrize("change", [None, hold, delay, lighten, begin_later])
def test_a_result_is_stale_where_what_it_was_made_from_changes_shown_later_or_not(
    moody, tmp_path, change
):
    edit, composed = tmp_path / "arm.edit.usda", tmp_path / "composed.usda"
    pipeline.solve(moody, edit, compose=composed)
    if change is not None:
        stage = Usd.Stage.Open(str(moody))
        change(source_on(stage).GetAttribute("rotations"))
        stage.Save()
    for path in (composed, shifted(composed, tmp_path, 100.0)):
        assert outcome(path).records[0].stale == (change is not None)


def test_one_that_does_not_move_is_stale_where_its_stage_begins_later(arm_shot, tmp_path):
    shot, edit = arm_shot(0.05), tmp_path / "arm.edit.usda"
    stage = Usd.Stage.Open(str(shot))
    for attribute in source_on(stage).GetAttributes():
        if codes := attribute.GetTimeSamples():
            value = attribute.Get(codes[0])
            attribute.Clear()
            attribute.Set(value)
    stage.Save()
    pipeline.solve(shot, edit)
    assert not outcome(edit).records[0].stale
    stage.SetStartTimeCode(stage.GetStartTimeCode() + 1.0)
    stage.SetEndTimeCode(stage.GetEndTimeCode() + 1.0)
    stage.Save()
    assert outcome(edit).records[0].stale

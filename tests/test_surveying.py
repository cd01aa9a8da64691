"""What there is to see of a stage as it stands."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd

from usdmotion import pipeline
from usdmotion.surveying import survey

EDIT = "/Arm/Skeleton/Edit"


def seen(path: Path):
    return survey(Usd.Stage.Open(str(path)), path, program="nobody")


@pytest.fixture
def composed(arm_shot, tmp_path):
    shot = arm_shot(2.0)
    pipeline.solve(shot, tmp_path / "arm.edit.usda", compose=tmp_path / "composed.usda")
    return tmp_path / "composed.usda"


def test_an_edit_is_seen_with_its_result_or_as_it_asks(arm_shot, composed):
    (before,) = seen(arm_shot(2.0)).scenes
    (after,) = seen(composed).scenes
    assert [each.edits[0].solved for each in (before, after)] == [False, True]
    (asked,), (met,) = before.edits[0].courses, after.edits[0].courses
    assert asked.after is None and np.array_equal(asked.before, met.before)
    assert met.after[:, 1].max() > met.before[:, 1].max()
    assert [each.name for each in after.edits[0].misses] == ["Wrist"]


def test_a_result_that_is_old_or_not_shown_is_told(arm_shot, composed):
    assert seen(composed).notes == ()
    arm_shot(1.9)
    stage = Usd.Stage.Open(str(composed))
    binding = stage.GetPrimAtPath("/Arm/Skeleton").GetRelationship("skel:animationSource")
    source = stage.GetPrimAtPath(f"{EDIT}_result").GetRelationship("usdmotion:result:source")
    binding.SetTargets(source.GetTargets())
    stale, hidden = survey(stage, composed, program="nobody").notes
    assert "is stale" in stale and "is not what is shown" in hidden


def test_an_edit_that_is_off_is_not_seen_solved_or_not(arm_shot, composed):
    for path in (arm_shot(2.0), composed):
        stage = Usd.Stage.Open(str(path))
        stage.GetPrimAtPath(EDIT).SetActive(False)
        assert survey(stage, path, program="nobody").scenes == ()


def test_edits_of_one_skeleton_are_seen_side_by_side(arm_shot):
    path = arm_shot(0.05)
    stage = Usd.Stage.Open(str(path))
    other = stage.GetPrimAtPath(f"{EDIT}/Wrist")
    for name in ("Other", "Empty"):
        stage.DefinePrim(f"/Arm/Skeleton/{name}", "MotionEdit")
    constraint = stage.DefinePrim("/Arm/Skeleton/Other/Wrist", other.GetTypeName())
    constraint.GetAttribute("usdmotion:joint").Set(other.GetAttribute("usdmotion:joint").Get())
    found = survey(stage, path, program="nobody").scenes
    assert [edit.path for scene in found for edit in scene.edits] == [EDIT, "/Arm/Skeleton/Other"]


def test_an_edit_at_fault_does_not_hide_the_others(arm_shot, composed):
    stage = Usd.Stage.Open(str(composed))
    for name, joint in (("Good", "base"), ("Bad", "knee")):
        stage.DefinePrim(f"/Arm/Skeleton/{name}", "MotionEdit")
        wanted = stage.DefinePrim(f"/Arm/Skeleton/{name}/Hold", "MotionPositionConstraint")
        wanted.GetAttribute("usdmotion:joint").Set(joint)
    found = survey(stage, composed, program="nobody")
    names = [edit.path.rsplit("/", 1)[-1] for scene in found.scenes for edit in scene.edits]
    assert names == ["Edit", "Good"]
    (fault,) = found.faults
    assert fault.startswith("what </Arm/Skeleton/Bad> asks is not seen: ") and "knee" in fault
    assert found.notes == found.faults


def test_an_edit_that_instances_share_is_told_once(arm_shot):
    shot, stage = str(arm_shot()), Usd.Stage.CreateInMemory()
    for name in ("First", "Second"):
        instance = stage.DefinePrim(f"/{name}")
        instance.GetReferences().AddReference(shot, "/Arm")
        instance.SetInstanceable(True)
    found = survey(stage, Path("crowd.usda"), program="nobody")
    assert found.scenes == ()
    (fault,) = found.faults
    assert fault.startswith("what </First/Skeleton/Edit> asks is not seen: </First/")
    assert "is inside an instance" in fault

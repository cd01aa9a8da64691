"""A shot that stays open: what is changed is solved again, and written as if it had been solved."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import (
    FileError,
    Goal,
    PositionConstraint,
    SceneError,
    Session,
    pipeline,
    usd,
)

EDIT = "/Arm/Skeleton/Edit"
WRIST, GOAL = f"{EDIT}/Wrist", f"{EDIT}/Wrist/Goal1"
ELBOW = PositionConstraint(
    path=f"{EDIT}/Elbow",
    skeleton="/Arm/Skeleton",
    joint="base/shoulder/elbow",
    priority=2,
    times=(0.2, 0.3),
)
CODES = (1, 2, 3, 4, 5)


def moved(shot: Path, lift: float) -> Path:
    """Write into a shot that its goal is elsewhere."""
    stage = Usd.Stage.Open(Sdf.Layer.OpenAsAnonymous(str(shot)))
    goal = UsdGeom.Xformable(stage.GetPrimAtPath(GOAL))
    goal.GetOrderedXformOps()[0].Set((0.0, lift, 0.0))
    stage.GetRootLayer().Export(str(shot))
    return shot


def test_what_nobody_has_changed_is_written_as_solve_writes_it(arm_shot, tmp_path):
    shot = arm_shot(0.05)
    report = pipeline.solve(shot, tmp_path / "solved.usda", compose=tmp_path / "one.usda")
    session = Session.open(shot)
    session.write(tmp_path / "session.usda")
    assert (tmp_path / "session.usda").read_bytes() == (tmp_path / "solved.usda").read_bytes()
    rows = [each.constraints for each in session.report().edits]
    assert rows == [each.constraints for each in report.edits]


def test_what_was_changed_is_written_as_if_the_stage_had_said_so(arm_shot, tmp_path):
    shot = arm_shot(0.05)
    session = Session.open(shot)
    change = session.change(GOAL, translation=[0.0, 0.08, 0.0])
    assert change.skeletons == ("/Arm/Skeleton",)
    assert change.frames == slice(0, 12)
    assert change.time_codes.tolist() == list(range(1, 13))
    session.write(tmp_path / "session.usda", compose=tmp_path / "composed.usda")
    pipeline.solve(moved(shot, 0.08), tmp_path / "solved.usda")
    assert (tmp_path / "session.usda").read_bytes() == (tmp_path / "solved.usda").read_bytes()
    assert Usd.Stage.Open(str(tmp_path / "composed.usda")).GetPrimAtPath(f"{EDIT}_result")


def test_constraints_come_go_and_change(arm_shot):
    session = Session.open(arm_shot(0.05))
    assert [each.path for each in session.constraints] == [WRIST]
    added = session.set(ELBOW)
    assert (added.frames.start, [each.path for each in session.constraints]) == (
        5,
        [WRIST, ELBOW.path],
    )
    assert session.change(ELBOW.path, times=(0.2, 0.25)).frames.start >= 6
    assert session.constraint(ELBOW.path).times == (0.2, 0.25)
    assert session.change(ELBOW.path, priority=1).frames.start == 5
    assert session.remove(ELBOW.path).frames.start == 5
    assert session.constraint(GOAL).path == WRIST
    assert [row.path for row in session.report().edits[0].constraints] == [WRIST]


def test_a_change_is_undone_by_what_was_there_before(arm_shot, tmp_path):
    session = Session.open(arm_shot(0.05))
    session.write(tmp_path / "before.usda")
    before = session.constraint(WRIST)
    session.change(WRIST, priority=3, goals=[Goal(translation=np.array([0.4, 1.5, 0.0]))])
    session.set(before)
    session.write(tmp_path / "after.usda")
    assert (tmp_path / "after.usda").read_bytes() == (tmp_path / "before.usda").read_bytes()


def test_the_motion_is_there_at_once(arm_shot):
    session = Session.open(arm_shot(0.05))
    before = session.motion("/Arm/Skeleton")
    change = session.change(GOAL, translation=[0.0, 0.08, 0.0])
    after = session.motion("/Arm/Skeleton", change.frames)
    assert after.rotations.shape == (12, 4, 4)
    assert not np.array_equal(after.rotations, before.rotations)


@pytest.mark.parametrize(
    ("refused", "sentence"),
    [
        (lambda s: s.change(GOAL, translation=[1.0]), "cannot have .* as its translation; give 3"),
        (lambda s: s.change(WRIST, colour="red"), "has no 'colour' to be changed"),
        (lambda s: s.change(WRIST, joint="tail"), "names the joint 'tail', which"),
        (lambda s: s.change(f"{EDIT}/None", priority=1), "is no constraint or goal of this"),
        (lambda s: s.remove(f"{EDIT}/None"), f"it has <{WRIST}>"),
        (lambda s: s.set(PositionConstraint(path="/Elsewhere/x", skeleton="/A")), "under no edit"),
        (lambda s: s.motion("/Elsewhere"), "is not solved in this session; it has </Arm/Skel"),
    ],
    ids=["value", "field", "joint", "path", "removed", "edit", "skeleton"],
)
def test_what_cannot_be_is_refused_and_changes_nothing(arm_shot, tmp_path, refused, sentence):
    session = Session.open(arm_shot(0.05))
    session.write(tmp_path / "before.usda")
    with pytest.raises(SceneError, match=sentence):
        refused(session)
    session.write(tmp_path / "after.usda")
    assert (tmp_path / "after.usda").read_bytes() == (tmp_path / "before.usda").read_bytes()


def test_a_file_that_is_not_there_and_a_layer_that_was_read_are_named(arm_shot, tmp_path):
    with pytest.raises(FileError, match=r"absent\.usda: there is no such file"):
        Session.open(tmp_path / "absent.usda")
    shot = arm_shot()
    with pytest.raises(FileError, match=shot.name):
        Session.open(shot).write(shot)


def test_characters_that_are_solved_together_change_together(text, save):
    ride = text.goal(
        """rel usdmotion:space = </Bob/Bones>
        uniform token usdmotion:spaceJoint = "hip/head" """
    )
    lift = text.goal('uniform token usdmotion:mode = "offset"', translate="(0, 4, 0)")
    ann = text.man("Ann", edit=text.edit(text.hold(ride)))
    head = text.hold(lift).replace("hip/knee/ankle", "hip/head")
    bob = text.man("Bob", edit=text.edit(head), animation=text.poses(seed=3))
    shot = save(ann + bob)
    session = Session.open(shot)
    (raised,) = (each for each in session.constraints if each.skeleton == "/Bob/Bones")
    goal = raised.goals[0].path
    before = session.motion("/Ann/Bones")
    change = session.change(goal, translation=2.0 * raised.goals[0].translation)
    assert set(change.skeletons) == {"/Ann/Bones", "/Bob/Bones"}
    assert not np.array_equal(session.motion("/Ann/Bones").rotations, before.rotations)
    assert session.report().met


def test_characters_that_have_nothing_to_do_with_each_other_do_not(text, save):
    lift = text.goal('uniform token usdmotion:mode = "offset"', translate="(0, 4, 0)")
    both = [
        text.man(name, edit=text.edit(text.hold(lift)), animation=text.poses(seed=3))
        for name in ("Ann", "Bob")
    ]
    session = Session.open(save("".join(both)))
    ann = session.constraint("/Ann/Bones/Edit/Hold")
    before = session.motion("/Bob/Bones")
    change = session.change(ann.path, times=(0.0, 0.05))
    assert change.skeletons == ("/Ann/Bones",)
    assert np.array_equal(session.motion("/Bob/Bones").rotations, before.rotations)


def test_changed_constraints_are_authored_by_those_who_own_the_stage(arm_shot, tmp_path):
    shot = arm_shot(0.05)
    session = Session.open(shot)
    session.change(GOAL, translation=[0.0, 0.08, 0.0])
    stage = Usd.Stage.Open(str(shot))
    usd.author(stage, WRIST, session.constraint(WRIST))
    stage.GetRootLayer().Save()
    session.write(tmp_path / "session.usda")
    pipeline.solve(shot, tmp_path / "solved.usda")
    assert (tmp_path / "session.usda").read_bytes() == (tmp_path / "solved.usda").read_bytes()

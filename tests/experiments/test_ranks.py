"""2004, section 6: priorities are ranks; and 2003, section 3.1: the recruiting rule."""

from dataclasses import replace

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, feet, token, write_walk


def conflict(walking, ranks):
    """Return three constraints that cannot all be met, with their priorities."""
    high, middle, low = ranks

    def wants(name, joint, priority, outward):
        goal = Goal(mode="offset", translation=np.array([outward, 0.1, 0.4]))
        return PositionConstraint(
            path=name,
            skeleton=SKELETON,
            joint=token(walking, joint),
            priority=priority,
            goals=(goal,),
        )

    return [
        wants("Wrist", "LeftHand", middle, 0.5),
        *feet(walking, priority=high),
        wants("Elbow", "LeftForeArm", low, -0.3),
    ]


def result(layer: Sdf.Layer) -> dict[str, bytes]:
    stage = Usd.Stage.Open(layer)
    prim = stage.GetPrimAtPath(f"{SKELETON}/Edit_result")
    names = ("joints", "translations", "rotations", "scales")
    arrays = {}
    for name in names:
        attribute = prim.GetAttribute(name)
        times = attribute.GetTimeSamples() or [Usd.TimeCode.Default()]
        arrays[name] = str([attribute.Get(time) for time in times]).encode()
    return arrays


def test_priorities_2_10_15_and_1_2_3_give_the_same_bytes(tmp_path, solve):
    walking = walk(seconds=1.0)
    answers = []
    for name, ranks in (("far", (2, 10, 15)), ("near", (1, 2, 3))):
        shot = tmp_path / f"{name}.usda"
        write_walk(shot, walking, "Edit", conflict(walking, ranks))
        answers.append(result(Sdf.Layer.FindOrOpen(str(solve(shot, SKELETON).edit_layer))))
    assert answers[0] == answers[1]


def test_the_order_in_which_constraints_stand_does_not_count(tmp_path, solve):
    walking = walk(seconds=1.0)
    asked = conflict(walking, (1, 2, 3))
    takes = []
    for name, constraints in (("one", asked), ("other", asked[::-1])):
        shot = tmp_path / f"{name}.usda"
        write_walk(shot, walking, "Edit", constraints)
        takes.append(solve(shot, SKELETON).after)
    assert np.abs(takes[0].world - takes[1].world).max() < 1e-5


def test_other_ranks_give_another_answer(tmp_path, solve):
    walking = walk(seconds=1.0)
    takes = []
    for name, ranks in (("feet", (1, 2, 3)), ("elbow", (3, 2, 1))):
        shot = tmp_path / f"{name}.usda"
        write_walk(shot, walking, "Edit", conflict(walking, ranks))
        takes.append(solve(shot, SKELETON).after)
    assert np.abs(takes[0].world - takes[1].world).max() > 0.05


@pytest.fixture
def breaking(tmp_path):
    """Write feet that may move the legs alone, under a wrist that moves the pelvis too."""
    walking = walk(seconds=1.0)
    legs = ("UpLeg", "Leg", "Foot")
    planted = [
        replace(each, recruits=tuple(token(walking, f"{each.path[:-4]}{part}") for part in legs))
        for each in feet(walking, priority=1)
        if each.path.endswith("Heel")
    ]
    wrist = PositionConstraint(
        path="Wrist",
        skeleton=SKELETON,
        joint=token(walking, "LeftHand"),
        priority=2,
        goals=(Goal(mode="offset", translation=np.array([1.5, 0.0, 0.0])),),
    )
    shot = tmp_path / "breaking.usda"
    write_walk(shot, walking, "Edit", [*planted, wrist])
    return shot


def test_a_stack_that_breaks_the_recruiting_rule_is_named_with_what_mends_it(breaking, solve):
    notes = [each for each in solve(breaking, SKELETON).report.notes if "recruit" in each]
    assert len(notes) == 2
    for side in ("Left", "Right"):
        (note,) = (each for each in notes if f"{SKELETON}/Edit/{side}Heel" in each)
        assert f"<{SKELETON}/Edit/Wrist>" in note
        assert "recruit Hips" in note


def test_mended_the_high_constraint_is_met_and_the_low_one_gets_nearer(breaking, solve):
    point = walk(seconds=1.0).heel_point
    broken = solve(breaking, SKELETON)
    mended = solve(breaking, SKELETON, mend_recruiting=True)
    assert not any("recruit" in each for each in mended.report.notes)
    for solved in (broken, mended):
        # Even a broken stack keeps its ranks here: the wrist gets only as far as the feet allow.
        assert max(solved.moved(f"{side}Foot", point) for side in ("Left", "Right")) <= 0.01
    left = [solved.report.edits[0].constraints[-1].max for solved in (broken, mended)]
    assert left[1] < left[0] - 0.01

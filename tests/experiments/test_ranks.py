"""2004, section 6: priorities are ranks; and 2003, section 3.1: the recruiting rule."""

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import demos
from usdmotion.demos.gait import walk
from usdmotion.demos.ranks import conflict
from usdmotion.demos.walker import SKELETON, VARIANTS, write_walk


def result(layer: Sdf.Layer) -> dict[str, bytes]:
    stage = Usd.Stage.Open(layer)
    prim = stage.GetPrimAtPath(f"{SKELETON}/Ranks_result")
    names = ("joints", "translations", "rotations", "scales")
    arrays = {}
    for name in names:
        attribute = prim.GetAttribute(name)
        times = attribute.GetTimeSamples() or [Usd.TimeCode.Default()]
        arrays[name] = str([attribute.Get(time) for time in times]).encode()
    return arrays


def selecting(shot, variant):
    """Write a stage over another one that selects a variant of its edit."""
    over = shot.with_name(f"{variant}.usda")
    layer = Sdf.Layer.FindOrOpen(str(shot))
    new = Sdf.Layer.CreateNew(str(over))
    new.TransferContent(layer)
    new.GetPrimAtPath(f"{SKELETON}/Ranks").variantSelections[VARIANTS] = variant
    new.Save()
    return over


def test_priorities_2_10_15_and_1_2_3_give_the_same_bytes(tmp_path, solve):
    shot = demos.build("ranks", tmp_path)
    answers, asked = [], []
    for variant in ("far_apart", "one_two_three"):
        solved = solve(selecting(shot, variant), SKELETON)
        answers.append(result(Sdf.Layer.FindOrOpen(str(solved.edit_layer))))
        asked.append({each.priority for each in solved.report.edits[0].constraints})
    assert asked == [{2, 10, 15}, {1, 2, 3}]
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
    return demos.build("recruiting", tmp_path)


def test_a_stack_that_breaks_the_recruiting_rule_is_named_with_what_mends_it(breaking, solve):
    notes = [each for each in solve(breaking, SKELETON).report.notes if "recruit" in each]
    assert len(notes) == 2
    for side in ("Left", "Right"):
        (note,) = (each for each in notes if f"{SKELETON}/Recruiting/{side}Heel" in each)
        assert f"<{SKELETON}/Recruiting/Wrist>" in note
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

"""2004, section 6: priorities are ranks; and 2003, section 3.1: the recruiting rule."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

SIDES = {"l": 1.0, "r": -1.0}


def wants(clip, part, priority, outward, up=0.0):
    """Return a constraint that a joint is to go outward and up [m on 1.7 m]."""
    left = np.cross(clip.up, clip.ahead(len(clip.seconds) // 2))
    offset = (SIDES[part[0]] * outward * left + up * clip.up) * clip.height / 1.7
    return PositionConstraint(
        path=part,
        skeleton=clip.skeleton,
        joint=clip.token(part),
        priority=priority,
        goals=(Goal(mode="offset", translation=offset),),
    )


def conflict(clip, high, middle, low):
    """Return constraints that cannot all be met, with their priorities."""
    return [
        wants(clip, "l_radiocarpal", middle, 0.5, 0.4),
        *clip.feet(priority=high),
        wants(clip, "l_elbow", low, -0.3),
    ]


@pytest.fixture(scope="module")
def near(clip, ask):
    """Return the answer with the priorities 1, 2, 3."""
    return ask(clip, conflict(clip, 1, 2, 3), knees="")


def test_priorities_2_10_15_and_1_2_3_give_the_same_bits(clip, ask, near):
    far = ask(clip, conflict(clip, 2, 10, 15), knees="")
    assert np.array_equal(far.after.local, near.after.local)
    assert np.array_equal(far.after.world, near.after.world)


def test_other_ranks_give_another_answer(clip, ask, near):
    elbow = ask(clip, conflict(clip, 3, 2, 1), knees="")
    assert near.millimetres(near.after.world[:, :, 3, :3] - elbow.after.world[:, :, 3, :3]) > 50.0


@pytest.fixture(scope="module")
def breaking(clip):
    """Return feet that may move the legs alone, under a wrist that moves the pelvis too."""
    legs = {side: clip.chain(f"{side}_talocrural", f"{side}_hip") for side in SIDES}
    planted = [
        replace(each, recruits=legs[each.path[0]])
        for each in clip.feet(priority=1)
        if each.path.endswith("ankle")
    ]
    return [*planted, wants(clip, "l_radiocarpal", 2, 1.5)]


@pytest.fixture(scope="module")
def broken(clip, ask, breaking):
    """Return what becomes of them as they are."""
    return ask(clip, breaking, knees="")


def test_a_stack_that_breaks_the_recruiting_rule_is_named_with_what_mends_it(clip, broken):
    notes = broken.report.notes
    for side in SIDES:
        (note,) = (each for each in notes if f"Edit/{side}_ankle>" in each and "recruit" in each)
        assert f"recruit {clip.token('humanoid_root')}" in note
        assert f"<{clip.skeleton}/Edit/l_radiocarpal>" in note


def test_mended_the_feet_are_met_and_the_wrist_gets_nearer(clip, ask, breaking, broken):
    mended = ask(clip, breaking, knees="", mend_recruiting=True)
    assert not any("recruit" in each for each in mended.report.notes)
    for side in SIDES:
        assert mended.moved(clip.token(f"{side}_talocrural")) <= 1.0
    left = [solved.report.edits[0].constraints[-1].rms for solved in (broken, mended)]
    assert left[1] < left[0]

"""2005, section 11: stiffness and priorities of joints say who of a chain moves, and who first."""

import numpy as np
import pytest

from usdmotion.demos.per_articulation import AHEAD, ARM, ASIDE, FRAMES, OTHER_ARM, TRUNK
from usdmotion.demos.performances import reach

BODIES = ("usual", "stiff_arm", "locked_arm", "trunk_first", "trunk_from_below")
BALANCED = ("aside", "pelvis", "other_arm")


@pytest.fixture(scope="module")
def ahead(shown):
    return {body: shown("per_articulation", asked="ahead", body=body) for body in BODIES}


@pytest.fixture(scope="module")
def aside(shown):
    return {asked: shown("per_articulation", asked=asked, body="usual") for asked in BALANCED}


def turned(solved, joints):
    """Return how far some joints are turned on the plateau, summed [degrees]."""
    there = solved.on(FRAMES)
    return sum(
        float(
            np.degrees(
                (solved.before.turn(j).inv() * solved.after.turn(j)).magnitude()[there].max()
            )
        )
        for j in joints
    )


@pytest.mark.parametrize("body", BODIES)
def test_whoever_moves_the_wrist_is_at_its_place(ahead, body):
    missed = ahead[body].after.point("RightHand") - AHEAD
    assert ahead[body].millimetres(missed[ahead[body].on(FRAMES)]) <= 1.0


def test_as_ever_the_arm_does_it_alone(ahead):
    assert turned(ahead["usual"], TRUNK) == 0.0
    assert turned(ahead["usual"], ARM) > 5.0


def test_a_stiff_arm_leaves_something_to_the_trunk(ahead):
    assert turned(ahead["stiff_arm"], ARM) < turned(ahead["usual"], ARM)
    assert turned(ahead["stiff_arm"], TRUNK) > 1.0


def test_a_locked_arm_leaves_all_to_the_trunk(ahead):
    assert turned(ahead["locked_arm"], ARM) == 0.0
    assert turned(ahead["locked_arm"], TRUNK) > 5.0


def test_a_trunk_that_is_first_moves_for_what_the_arm_could_do(ahead):
    assert turned(ahead["trunk_first"], TRUNK) > 3.0
    assert turned(ahead["trunk_from_below"], TRUNK) > 3.0


def test_of_a_trunk_who_is_first_moves_most(ahead):
    from_above, from_below = (
        [turned(ahead[body], (joint,)) for joint in TRUNK]
        for body in ("trunk_first", "trunk_from_below")
    )
    assert np.argmax(from_above) == 2
    assert np.argmax(from_below) == 0


def balance_lost(solved):
    body = reach().body
    moved = solved.after.center_of_mass(body) - solved.before.center_of_mass(body)
    return solved.millimetres(moved[:, [0, 2]])


def test_an_arm_aside_takes_the_centre_of_mass_along(aside):
    assert balance_lost(aside["aside"]) > 8.0


def test_where_the_pelvis_may_keep_it_the_other_arm_has_nothing_to_do(aside):
    assert balance_lost(aside["pelvis"]) <= 5.0
    assert turned(aside["pelvis"], OTHER_ARM) == 0.0


def test_where_only_the_other_arm_can_it_does(aside):
    assert balance_lost(aside["other_arm"]) <= 5.0
    assert turned(aside["other_arm"], OTHER_ARM) > 5.0
    missed = aside["other_arm"].after.point("RightHand") - ASIDE
    assert aside["other_arm"].millimetres(missed[aside["other_arm"].on(FRAMES)]) <= 1.0


def test_no_joint_jolts(ahead, aside):
    for solved in (*ahead.values(), *aside.values()):
        assert solved.jolted() <= 5.0
        assert solved.apart(solved.away(FRAMES)) <= 0.1

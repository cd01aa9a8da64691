"""2005, section 5: one motion of two hands, and boxes of whatever size between them."""

import numpy as np
import pytest

from usdmotion.demos.performances import carry
from usdmotion.demos.two_hands import FRAMES, WIDTHS, palm

ARMS = tuple(f"{side}{name}" for side in ("Left", "Right") for name in ("Arm", "ForeArm", "Hand"))

BOXES = pytest.mark.parametrize("box", WIDTHS)


@pytest.fixture
def solved(shown, box):
    return shown("two_hands", asked=box)


def apart(take):
    carrying = carry()
    left, right = (take.point(f"{side}Hand", palm(carrying, side)) for side in ("Left", "Right"))
    return np.linalg.norm(left - right, axis=1)


@BOXES
def test_the_palms_are_as_far_apart_as_the_box_is_wide(solved, box):
    there = solved.on(FRAMES)
    assert np.abs(apart(solved.before)[there] - WIDTHS[box]).max() > 0.03
    assert np.abs(apart(solved.after)[there] - WIDTHS[box]).max() <= 0.001


@BOXES
def test_the_box_stays_about_where_the_hands_were(solved, box):
    middle = [
        0.5 * (take.point("LeftHand") + take.point("RightHand"))
        for take in (solved.before, solved.after)
    ]
    assert solved.millimetres(middle[1] - middle[0]) <= 100.0


@BOXES
def test_outside_its_times_it_is_the_input(solved, box):
    assert solved.apart(solved.away(FRAMES)) <= 0.01


@BOXES
def test_nothing_but_the_arms_moves_and_they_do_not_jump(solved, box):
    for index, joint in enumerate(solved.before.joints):
        if not joint.endswith(ARMS):
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])
    assert solved.jolted() <= 5.0

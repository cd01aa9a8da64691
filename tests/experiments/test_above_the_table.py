"""2005, figure 6: the hands of who talks stay above a table for a while, and nothing else moves."""

import numpy as np
import pytest

from usdmotion.demos.above_the_table import FINGERS, FRAMES, TOP, WRIST, fingers
from usdmotion.demos.performances import talk

HANDS = ("LeftHand", "RightHand")
ARMS = tuple(f"{side}{name}" for side in ("Left", "Right") for name in ("Arm", "ForeArm", "Hand"))


@pytest.fixture(scope="module")
def solved(shown):
    return shown("above_the_table")


def height(take, hand, point=(0, 0, 0)):
    return take.point(hand, point)[:, 1] - TOP


@pytest.mark.parametrize("hand", HANDS)
def test_no_wrist_is_ever_more_than_a_millimetre_inside(solved, hand):
    there = solved.on(FRAMES)
    assert height(solved.before, hand)[there].min() < WRIST - 0.1
    assert height(solved.after, hand)[there].min() > WRIST - 0.001


@pytest.mark.parametrize("hand", HANDS)
def test_no_finger_is_either(solved, hand):
    tips = fingers(talk(), hand.removesuffix("Hand"))
    assert height(solved.after, hand, tips)[solved.on(FRAMES)].min() > FINGERS - 0.001


@pytest.mark.parametrize("hand", HANDS)
def test_who_raises_his_hand_is_left_alone(solved, hand):
    free = solved.on(FRAMES) & (height(solved.before, hand) > WRIST + 0.1)
    assert free.sum() >= 10
    moved = solved.after.point(hand) - solved.before.point(hand)
    assert solved.millimetres(moved[free]) <= 0.1


def test_outside_its_times_it_is_the_input(solved):
    assert solved.apart(solved.away(FRAMES)) <= 0.01


def test_nothing_but_the_arms_moves(solved):
    for index, joint in enumerate(solved.before.joints):
        if not joint.endswith(ARMS):
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])


def test_the_hands_come_and_go_without_a_jolt(solved):
    assert solved.jolted() <= 5.0

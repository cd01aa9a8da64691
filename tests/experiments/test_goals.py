"""2003, figures 4 and 5: effectors follow the composite of their goals."""

import numpy as np
import pytest

from usdmotion.demos import goals
from usdmotion.demos.walker import SKELETON


def profile(times, keys):
    """Return the cubic activity of four keys, written out again from 2003, figure 4."""
    t0, t1, t2, t3 = keys
    rise = np.clip((times - t0) / (t1 - t0), 0, 1)
    fall = np.clip((t3 - times) / (t3 - t2), 0, 1)
    return (rise**2 * (3 - 2 * rise)) * (fall**2 * (3 - 2 * fall))


@pytest.fixture
def solved(demo, solve):
    return solve(demo("goals"), SKELETON)


def test_a_position_goal_draws_the_effector_to_a_point(solved):
    original = solved.before.point("RightHand")
    a = profile(solved.before.times, (25, 41, 49, 65))[:, None]
    wanted = a * goals.POINT + (1 - a) * original
    assert solved.millimetres(solved.after.point("RightHand") - wanted) <= 0.02


def test_overlapping_offset_goals_make_a_weighted_mean(solved):
    original = solved.before.point("LeftHand")
    a = profile(solved.before.times, (25, 41, 73, 97))[:, None]
    b = profile(solved.before.times, (65, 85, 109, 129))[:, None]
    total = np.where(a + b > 0, a + b, 1)
    mean = (a * (original + goals.RAISE) + b * (original + goals.OUTWARD)) / total
    most = np.maximum(a, b)
    wanted = most * mean + (1 - most) * original
    assert solved.millimetres(solved.after.point("LeftHand") - wanted) <= 0.02


def test_speed_is_continuous_but_where_two_activities_cross(solved):
    displacement = solved.after.point("LeftHand") - solved.before.point("LeftHand")
    times = solved.before.times[1:-1]
    kinks = np.linalg.norm(np.diff(displacement, 2, axis=0), axis=1)
    a = profile(times, (25, 41, 73, 97))
    b = profile(times, (65, 85, 109, 129))
    crossing = times[np.argmin(np.where((a > 0) & (b > 0), np.abs(a - b), 1))]
    smooth = np.abs(times - crossing) > 2
    assert kinks[~smooth].max() > 2 * kinks[smooth & (times > 65) & (times < 97)].max()
    # A cubic ease over 16 frames turns by at most 6 / 16² of its height in a frame.
    assert kinks[smooth].max() <= 6 / 16**2 * 0.4


def test_the_offset_keeps_more_of_the_motion_than_the_point(solved):
    def speed(take, name):
        return np.linalg.norm(np.diff(take.point(name), axis=0), axis=1)

    there = slice(41, 48)
    point = np.abs(speed(solved.after, "RightHand") - speed(solved.before, "RightHand"))[there]
    offset = np.abs(speed(solved.after, "LeftHand") - speed(solved.before, "LeftHand"))[there]
    assert offset.max() < 0.001 < point.min()

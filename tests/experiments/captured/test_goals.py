"""2003, figures 4 and 5: effectors follow the composite of their goals on any body."""

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

POINT = (0.5, -0.3, 0.3)
"""Where a place is from where the right shoulder is meanwhile: outward, up, ahead, in arms."""
FIRST, SECOND = (0.05, 0.10, 0.10), (-0.05, 0.05, 0.15)
"""Where the left wrist is to be from its trajectory, alike."""
OVERLAP = 10
"""How many frames the second offset is later than the first."""


def profile(times, keys):
    """Return the cubic activity of four keys, written out again from 2003, figure 4."""
    t0, t1, t2, t3 = keys
    rise = np.clip((times - t0) / (t1 - t0), 0, 1)
    fall = np.clip((t3 - times) / (t3 - t2), 0, 1)
    return ((rise**2 * (3 - 2 * rise)) * (fall**2 * (3 - 2 * fall)))[:, None]


@pytest.fixture(scope="module")
def keys(clip):
    """Return the key times of the point, of the first offset and of the second [s]."""
    middle = len(clip.take.times) // 2
    frames = clip.calm("r_shoulder"), middle - OVERLAP, middle + OVERLAP
    return tuple(clip.keys(frame) for frame in frames)


@pytest.fixture(scope="module")
def ways(clip, keys):
    """Return the point of the right wrist, and the two offsets of the left one [m]."""
    ahead = clip.ahead(clip.calm("r_shoulder"))
    left = np.cross(clip.up, ahead)

    def way(side, outward, up, on):
        return clip.arm * (side * outward * left + up * clip.up + on * ahead)

    shoulder = clip.take.point(clip.token("r_shoulder"))[clip.within(keys[0])].mean(axis=0)
    return shoulder + way(-1.0, *POINT), way(1.0, *FIRST), way(1.0, *SECOND)


@pytest.fixture(scope="module")
def solved(clip, ask, keys, ways):
    point, first, second = ways
    goals = {
        "r_radiocarpal": (Goal(path="Point", translation=point, times=keys[0]),),
        "l_radiocarpal": (
            Goal(path="First", mode="offset", translation=first, times=keys[1]),
            Goal(path="Second", mode="offset", translation=second, times=keys[2]),
        ),
    }
    wrists = [
        PositionConstraint(
            path=part,
            skeleton=clip.skeleton,
            joint=clip.token(part),
            recruits=clip.chain(part, "vl5"),
            goals=each,
        )
        for part, each in goals.items()
    ]
    return ask(clip, wrists)


def test_a_position_goal_draws_the_effector_to_a_point(clip, solved, keys, ways):
    wrist = clip.token("r_radiocarpal")
    a = profile(clip.seconds, keys[0])
    wanted = a * ways[0] + (1 - a) * solved.before.point(wrist)
    assert solved.millimetres(solved.after.point(wrist) - wanted) <= 1.0


def test_overlapping_offset_goals_make_a_weighted_mean(clip, solved, keys, ways):
    wrist = clip.token("l_radiocarpal")
    a, b = (profile(clip.seconds, each) for each in keys[1:])
    mean = (a * ways[1] + b * ways[2]) / np.where(a + b > 0, a + b, 1)
    wanted = solved.before.point(wrist) + np.maximum(a, b) * mean
    assert solved.millimetres(solved.after.point(wrist) - wanted) <= 1.0

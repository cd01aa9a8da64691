"""The ball of the foot is down when it is said to be, and the rest of the body stands."""

import numpy as np
import pytest

from usdmotion.demos import taps
from usdmotion.kernels import forward, world_points


@pytest.fixture(scope="module")
def tapping():
    walk = taps.tap()
    motion = walk.motion
    return walk, *forward(walk.skeleton.parents, motion.translations, motion.rotations)


def test_the_ball_is_at_one_place_while_it_is_down_and_nowhere_near_otherwise(tapping):
    walk, positions, _ = tapping
    ball = positions[:, walk.joint("RightToeBase")]
    down = np.zeros(len(ball), dtype=bool)
    for first, last in taps.downs():
        down[first : last + 1] = True
    apart = np.linalg.norm(ball - ball[0], axis=1)
    assert apart[down].max() < 1e-9
    assert apart[~down].min() > 0.02
    assert ball[:, 1].min() == pytest.approx(ball[0, 1])


def test_a_tap_is_quicker_than_what_detection_bridges(tapping):
    gaps = [
        start - end
        for (_, end), (start, _) in zip(taps.downs()[:-1], taps.downs()[1:], strict=True)
    ]
    seconds = np.diff(tapping[0].motion.times)[0]
    assert max(gaps) * seconds < 0.4


def test_the_heel_and_the_other_foot_stay(tapping):
    walk, positions, orientations = tapping
    for name, point in (
        ("RightFoot", walk.heel_point),
        ("LeftFoot", walk.heel_point),
        ("LeftToeBase", walk.toe_point),
    ):
        joint = walk.joint(name)
        places = world_points(positions[:, joint], orientations[:, joint], point)
        assert np.ptp(places, axis=0).max() < 1e-9

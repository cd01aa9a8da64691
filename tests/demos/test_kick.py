"""The kick of the demos: smooth, within the limits of knees, and of the height of its body."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.demos.kick import LENGTH, RATE, kick


@pytest.fixture(scope="module")
def walk():
    return kick()


def test_it_is_as_long_as_it_says(walk):
    assert walk.motion.times[-1] == LENGTH
    assert len(walk.motion.times) == LENGTH * RATE + 1


def test_it_ends_as_it_begins(walk):
    assert np.allclose(walk.motion.rotations[0], walk.motion.rotations[-1])
    assert np.allclose(walk.motion.translations[0], walk.motion.translations[-1])


def test_the_knees_only_bend(walk):
    for side in ("Left", "Right"):
        knee = walk.motion.rotations[:, walk.joint(f"{side}Leg")]
        bend = Rotation.from_quat(knee).as_rotvec(degrees=True)
        assert bend[:, 0].min() > 2.0
        assert bend[:, 0].max() < 150.0
        assert np.abs(bend[:, 1:]).max() < 1e-6


def test_no_joint_jumps(walk):
    for joint in range(len(walk.skeleton.joints)):
        turn = Rotation.from_quat(walk.motion.rotations[:, joint])
        speed = np.degrees((turn[:-1].inv() * turn[1:]).magnitude())
        assert speed.max() < 18.0
        assert np.abs(np.diff(speed)).max() < 12.0

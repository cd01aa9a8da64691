"""What people do in the demos is smooth, within the limits of joints, and on feet that stand."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.demos.performances import carry, reach, talk
from usdmotion.kernels import forward


@pytest.fixture(scope="module", params=[carry, reach, talk])
def acted(request):
    return request.param()


def test_it_ends_as_it_begins(acted):
    motion = acted.motion
    np.testing.assert_allclose(motion.rotations[0], motion.rotations[-1], atol=1e-12)
    np.testing.assert_allclose(motion.translations[0], motion.translations[-1], atol=1e-12)


def test_knees_and_elbows_only_bend(acted):
    for name, axis, sign in (
        ("LeftLeg", 0, 1),
        ("RightLeg", 0, 1),
        ("LeftForeArm", 1, -1),
        ("RightForeArm", 1, 1),
    ):
        turn = Rotation.from_quat(acted.motion.rotations[:, acted.joint(name)])
        vector = turn.as_rotvec(degrees=True)
        assert np.all((sign * vector[:, axis] > 5.0) & (sign * vector[:, axis] < 150.0))
        assert np.abs(np.delete(vector, axis, axis=1)).max() < 1e-6


def test_no_joint_jumps(acted):
    for joint in range(len(acted.skeleton.joints)):
        turn = Rotation.from_quat(acted.motion.rotations[:, joint])
        steps = (turn[:-1].inv() * turn[1:]).as_rotvec(degrees=True)
        assert np.linalg.norm(steps, axis=1).max() < 12.0
        assert np.linalg.norm(np.diff(steps, axis=0), axis=1).max() < 6.0


def test_soles_stay_flat_on_the_ground(acted):
    motion = acted.motion
    places, turns = forward(acted.skeleton.parents, motion.translations, motion.rotations)
    for side in ("Left", "Right"):
        for name, point in (("Foot", acted.heel_point), ("ToeBase", acted.toe_point)):
            joint = acted.joint(f"{side}{name}")
            sole = places[:, joint] + Rotation.from_quat(turns[:, joint]).apply(np.array(point))
            assert np.ptp(sole, axis=0).max() < 1e-6
            assert np.abs(sole[:, 1]).max() < 1e-3

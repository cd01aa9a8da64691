"""What people do in the demos is smooth, within the limits of joints, and on feet that stand."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.demos.acrobatics import crawl, handstand
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


def test_a_crawl_is_on_knees_and_hands():
    crawling = crawl()
    motion = crawling.motion
    places, _ = forward(crawling.skeleton.parents, motion.translations, motion.rotations)
    for name, height in (("Hand", 0.034), ("Leg", 0.05)):
        for side in ("Left", "Right"):
            heights = places[:, crawling.joint(f"{side}{name}"), 1]
            assert np.abs(heights - height).max() < 0.01
    knees = [places[:, crawling.joint(f"{side}Leg"), 2] for side in ("Left", "Right")]
    still = [np.abs(np.diff(knee)) < 1e-9 for knee in knees]
    assert np.mean(still[0] | still[1]) > 0.9
    assert places[-1, 0, 2] - places[0, 0, 2] > 0.8


def test_a_handstand_stands_on_hands_and_on_feet():
    acting = handstand()
    motion = acting.motion
    places, _ = forward(acting.skeleton.parents, motion.translations, motion.rotations)
    for stance in acting.stances:
        during = (motion.times >= stance.start) & (motion.times <= stance.end)
        held = places[during, acting.skeleton.index[stance.joint]]
        assert np.ptp(held, axis=0).max() < 1e-6
    assert places[60, acting.joint("Head"), 1] < places[60, acting.joint("Hips"), 1] - 0.3

"""2005, section 6: lengths change from frame to frame, and nothing else is to be seen of it."""

import numpy as np
import pytest
from pxr import Usd
from scipy.spatial.transform import Rotation

from usdmotion.demos import growing
from usdmotion.demos.gait import walk
from usdmotion.demos.growing import SKELETON, adult, child
from usdmotion.demos.walker import FIRST, RATE
from usdmotion.kernels import forward


@pytest.fixture(scope="module")
def walking():
    return walk(seconds=growing.LENGTH)


@pytest.fixture(scope="module")
def take(tmp_path_factory, taken, walking):
    path = tmp_path_factory.mktemp("growing") / "growing.usda"
    growing.build(path)
    return taken(Usd.Stage.Open(str(path)), SKELETON, FIRST + walking.motion.times * RATE)


def length(take, upper, lower):
    return np.linalg.norm(take.point(lower) - take.point(upper), axis=1)


@pytest.mark.parametrize(
    ("upper", "lower"),
    [("LeftUpLeg", "LeftLeg"), ("RightLeg", "RightFoot"), ("LeftArm", "LeftForeArm")],
)
def test_limbs_grow_from_a_child_s_to_an_adult_s(take, upper, lower):
    lengths = length(take, upper, lower)
    for index, who in ((0, child()), (-1, adult())):
        joint = next(
            j for j in range(len(who.parts)) if who.skeleton.joints[j].endswith(f"/{lower}")
        )
        rest = np.linalg.norm(who.skeleton.rest_translations[joint])
        assert lengths[index] == pytest.approx(rest, rel=1e-5)
    assert np.all(np.diff(lengths) >= -1e-6)
    assert np.diff(lengths).max() < 0.05 * np.ptp(lengths)


def test_nothing_jumps(take, walking):
    motion = walking.motion
    places, _ = forward(walking.skeleton.parents, motion.translations, motion.rotations)
    larger = length(take, "LeftUpLeg", "LeftLeg")[-1] / np.linalg.norm(
        walking.skeleton.rest_translations[walking.joint("LeftLeg")]
    )
    usual, grown = (
        np.linalg.norm(np.diff(each, 2, axis=0), axis=-1).max()
        for each in (places, take.world[:, :, 3, :3])
    )
    assert grown <= 1.1 * larger * usual


def test_no_joint_turns_otherwise_than_in_the_walk(take, walking):
    for joint, token in enumerate(take.joints):
        turn = Rotation.from_quat(walking.motion.rotations[:, joint])
        steps = (turn[:-1].inv() * turn[1:]).as_rotvec(degrees=True)
        jolt = np.linalg.norm(np.diff(steps, axis=0), axis=1).max()
        assert take.jolt(token) <= jolt + 1.0
        assert take.speed(token).max() <= np.linalg.norm(steps, axis=1).max() + 2.0


def planted(walking):
    """Return each ball that stands, and on which samples."""
    times = walking.motion.times
    stances = [
        (each.joint, (times >= each.start) & (times <= each.end))
        for each in walking.stances
        if each.effector == "toe"
    ]
    found = [(joint, during) for joint, during in stances if during.any()]
    assert len(found) >= 8
    return found


def test_feet_stand_still_where_they_stand_in_the_walk(take, walking):
    for joint, during in planted(walking):
        places = take.point(joint)[during]
        assert np.linalg.norm(places - places.mean(axis=0), axis=1).max() <= 0.002


def test_balls_are_as_high_above_the_ground_as_the_feet_are_thick(take, walking):
    small = child()
    ball = next(j for j, part in enumerate(small.parts) if part == "l_metatarsophalangeal")
    thick = small.sole_points[1]
    sizes = length(take, "LeftFoot", "LeftToeBase")
    thickness = -thick[1] * sizes / np.linalg.norm(small.skeleton.rest_translations[ball])
    for joint, during in planted(walking):
        floats = take.point(joint)[during, 1] - thickness[during]
        assert np.abs(floats).max() <= 0.005

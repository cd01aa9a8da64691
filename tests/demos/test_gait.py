import numpy as np
import pytest

from usdmotion.demos.body import sole
from usdmotion.demos.gait import walk
from usdmotion.demos.gait.curves import leg_angles, pelvis_angles
from usdmotion.demos.gait.walking import cycle_rate
from usdmotion.kernels import forward, rotate, to_vector

CYCLE = 1.0 / cycle_rate(1.7)


@pytest.fixture(scope="module")
def fine():
    """Three cycles, 100 samples each."""
    return walk(3.0 * CYCLE, 100.0 / CYCLE)


@pytest.fixture(scope="module")
def demo():
    return walk()


def test_six_seconds_at_24_frames_are_145_frames(demo):
    assert demo.motion.frame_count == 145
    assert demo.motion.times[-1] == 6.0


def test_two_calls_return_the_same_bits(demo):
    again = walk()
    assert again.motion.rotations.tobytes() == demo.motion.rotations.tobytes()
    assert again.motion.translations.tobytes() == demo.motion.translations.tobytes()
    assert again.stances == demo.stances


@pytest.mark.parametrize("frame_rate", [24.0, 29.97, 120.0])
@pytest.mark.parametrize("height", [1.0, 1.7])
def test_planted_heels_and_balls_stand_still(frame_rate, height):
    walker = walk(4.0, frame_rate, height=height)
    for stance in walker.stances:
        points = _planted(walker, stance)
        if len(points):
            assert np.max(np.ptp(points, axis=0)) < 1e-9
            assert np.max(np.abs(points[:, 1])) < 1e-9


def test_each_foot_stands_on_its_heel_then_flat_then_on_its_ball(demo):
    for side in ("Left", "Right"):
        whole = [s for s in demo.stances if s.side == side and s.start > 0.0 and s.end < 6.0]
        heels, balls = ([s for s in whole if s.effector == name] for name in ("heel", "toe"))
        for heel, ball in zip(heels, balls, strict=False):
            assert heel.start < ball.start < heel.end < ball.end
        assert len(heels) >= 4


def test_one_foot_or_two_always_stand(demo):
    for time in np.arange(0.1, 5.9, 0.01):
        sides = {s.side for s in demo.stances if s.start <= time <= s.end}
        assert sides


def test_soles_never_sink_into_the_ground(fine):
    points = sole(1.7)
    for side in ("Left", "Right"):
        for name, point in (
            ("Foot", points.heel),
            ("ToeBase", points.ball),
            ("ToeBase", points.toe_tip),
        ):
            assert np.min(_point(fine, side + name, point)[:, 1]) > -1e-4


def test_a_swinging_foot_clears_the_ground(fine):
    phase = fine.motion.times / CYCLE % 1.0
    swinging = (phase > 0.66) & (phase < 0.97)
    points = sole(1.7)
    for name, point in (
        ("LeftFoot", points.heel),
        ("LeftToeBase", points.ball),
        ("LeftToeBase", points.toe_tip),
    ):
        assert np.min(_point(fine, name, point)[swinging, 1]) > 0.005


def test_right_is_left_mirrored_half_a_cycle_later(fine):
    half = 50
    for token in fine.skeleton.joints:
        name = token.rsplit("/", 1)[-1]
        other = name.replace("Left", "*").replace("Right", "Left").replace("*", "Right")
        here = fine.motion.rotations[:-half, fine.joint(name)] * (1.0, -1.0, -1.0, 1.0)
        there = fine.motion.rotations[half:, fine.joint(other)]
        np.testing.assert_allclose(here, there, atol=1e-9)


def test_the_walk_repeats_itself_every_cycle(fine):
    np.testing.assert_allclose(fine.motion.rotations[:-100], fine.motion.rotations[100:], atol=1e-9)
    strides = fine.motion.translations[100:, 0] - fine.motion.translations[:-100, 0]
    np.testing.assert_allclose(strides, np.broadcast_to(strides[0], strides.shape), atol=1e-9)
    np.testing.assert_allclose(strides[0, :2], 0.0, atol=1e-9)


def test_it_walks_ahead_at_a_normal_speed(demo):
    way = demo.motion.translations[-1, 0] - demo.motion.translations[0, 0]
    assert 1.2 < way[2] / 6.0 < 1.4
    assert abs(way[0]) < 0.05


def test_the_pelvis_rises_twice_and_sways_once_a_cycle(fine):
    pelvis = fine.motion.translations[:100, 0]
    assert 0.030 < np.ptp(pelvis[:, 1]) < 0.050
    assert 0.035 < np.ptp(pelvis[:, 0]) < 0.050
    np.testing.assert_allclose(pelvis[:50, 1], pelvis[50:, 1], atol=1e-9)
    np.testing.assert_allclose(pelvis[:50, 0], -pelvis[50:, 0], atol=1e-9)


def test_leg_angles_stay_near_the_published_curves(fine):
    """RMS 0.9, 1.6 and 1.9 degrees, which is far within one standard deviation of the subjects."""
    asked = leg_angles(fine.motion.times / CYCLE)
    vectors = np.degrees(to_vector(fine.motion.rotations))
    for name, sign, curve, rms, largest in (
        ("LeftUpLeg", -1.0, asked.hip, 1.0, 4.0),
        ("LeftLeg", 1.0, asked.knee, 1.8, 8.0),
        ("LeftFoot", -1.0, asked.ankle, 2.1, 4.0),
    ):
        error = sign * vectors[:, fine.joint(name), 0] - curve
        assert np.sqrt(np.mean(error**2)) < rms
        assert np.max(np.abs(error)) < largest


def test_the_pelvis_turns_as_published(fine):
    asked = pelvis_angles(fine.motion.times / CYCLE)
    vectors = np.degrees(to_vector(fine.motion.rotations[:, 0]))
    wanted = np.stack([asked.tilt, -asked.rotation, asked.obliquity], axis=-1)
    np.testing.assert_allclose(vectors, wanted, atol=0.2)


def test_knees_are_hinges_that_never_bend_backwards(fine):
    vectors = np.degrees(to_vector(fine.motion.rotations))
    for name in ("LeftLeg", "RightLeg"):
        knee = vectors[:, fine.joint(name)]
        assert np.min(knee[:, 0]) > 3.0
        assert np.max(knee[:, 0]) < 65.0
        np.testing.assert_allclose(knee[:, 1:], 0.0, atol=1e-9)


def test_no_joint_goes_beyond_its_limits(demo):
    vectors = np.degrees(to_vector(demo.motion.rotations))
    assert np.all(vectors >= demo.body.limits_min - 1e-9)
    assert np.all(vectors <= demo.body.limits_max + 1e-9)


def test_no_joint_jumps():
    """The knees of the published curves reach 8,000 degrees per second squared themselves."""
    rate = 480.0
    walker = walk(2.0 * CYCLE, rate)
    vectors = np.degrees(to_vector(walker.motion.rotations))
    speeds = np.max(np.abs(np.diff(vectors, axis=0)), axis=(0, 2)) * rate
    changes = np.max(np.abs(np.diff(vectors, n=2, axis=0)), axis=(0, 2)) * rate**2
    toes = [walker.joint("LeftToeBase"), walker.joint("RightToeBase")]
    assert np.max(speeds) < 650.0
    assert np.max(np.delete(changes, toes)) < 12_500.0
    assert np.max(changes) < 20_000.0
    root = np.diff(walker.motion.translations[:, 0], n=2, axis=0) * rate**2
    assert np.max(np.abs(root)) < 6.0


def test_arms_swing_against_their_legs(fine):
    one_cycle = slice(0, 100)
    hand = _point(fine, "LeftHand", np.zeros(3)) - _point(fine, "Hips", np.zeros(3))
    foot = _point(fine, "LeftFoot", np.zeros(3)) - _point(fine, "Hips", np.zeros(3))
    assert np.corrcoef(hand[one_cycle, 2], foot[one_cycle, 2])[0, 1] < -0.8
    assert np.ptp(hand[:, 2]) > 0.3


def test_the_head_stays_level(fine):
    _, orientations = _world(fine)
    assert np.max(np.abs(to_vector(orientations[:, fine.joint("Head")]))) < 1e-9


def test_bodies_of_all_heights_walk_alike():
    """Froude's law: lengths by k, times by the root of k, angles the same."""
    factor = 0.64
    adult = walk(2.0, 24.0, height=1.7)
    child = walk(2.0 * factor**0.5, 24.0 / factor**0.5, height=1.7 * factor)
    np.testing.assert_allclose(child.motion.rotations, adult.motion.rotations, atol=1e-9)
    np.testing.assert_allclose(
        child.motion.translations, factor * adult.motion.translations, atol=1e-9
    )


def _world(walker):
    return forward(walker.skeleton.parents, walker.motion.translations, walker.motion.rotations)


def _point(walker, name, point):
    positions, orientations = _world(walker)
    joint = walker.joint(name)
    return positions[:, joint] + rotate(orientations[:, joint], point)


def _planted(walker, stance):
    times = walker.motion.times
    standing = (times >= stance.start - 1e-9) & (times <= stance.end + 1e-9)
    point = walker.heel_point if stance.effector == "heel" else walker.toe_point
    return _point(walker, stance.joint.rsplit("/", 1)[-1], point)[standing]

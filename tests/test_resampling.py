"""Laws of resampling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.arrays import Floats
from usdmotion.capture import Capture, Markers
from usdmotion.kernels import conjugate, multiply, to_vector
from usdmotion.motion import Motion
from usdmotion.resampling import capture_evenly, evenly, resample


def random_motion(seed: int, frame_count: int = 6, joint_count: int = 3) -> Motion:
    rng = np.random.default_rng(seed)
    rotations = rng.normal(size=(frame_count, joint_count, 4))
    rotations /= np.linalg.norm(rotations, axis=-1, keepdims=True)
    times = np.cumsum(rng.uniform(0.01, 1.0, frame_count))
    return Motion(times, rng.normal(size=(frame_count, joint_count, 3)), rotations)


def angles(a: Floats, b: Floats) -> Floats:
    turned: Floats = np.linalg.norm(to_vector(multiply(b, conjugate(a))), axis=-1)
    return turned


seeds = st.integers(0, 2**32 - 1)


@given(seeds)
def test_at_its_own_times_a_motion_stays_as_it_is(seed: int) -> None:
    motion = random_motion(seed)
    same = resample(motion, motion.times)
    assert np.array_equal(same.translations, motion.translations)
    assert np.array_equal(same.rotations, motion.rotations)


@given(seeds, st.floats(0.0, 1.0))
def test_between_samples_the_angle_grows_with_time(seed: int, share: float) -> None:
    motion = random_motion(seed)
    own = motion.times
    between = resample(motion, own[:-1] + share * np.diff(own))
    whole = angles(motion.rotations[:-1], motion.rotations[1:])
    assert np.allclose(angles(motion.rotations[:-1], between.rotations), share * whole, atol=1e-7)
    straight = (1 - share) * motion.translations[:-1] + share * motion.translations[1:]
    assert np.allclose(between.translations, straight)


@given(seeds)
def test_a_joint_never_turns_the_long_way_round(seed: int) -> None:
    motion = random_motion(seed)
    flipped = (
        motion.rotations * np.where(np.arange(motion.frame_count) % 2, -1.0, 1.0)[:, None, None]
    )
    times = np.linspace(motion.times[0], motion.times[-1], 200)
    plain = resample(motion, times)
    other = resample(Motion(motion.times, motion.translations, flipped), times)
    assert np.allclose(angles(plain.rotations, other.rotations), 0.0, atol=1e-7)
    travelled = angles(plain.rotations[:-1], plain.rotations[1:]).sum(axis=0)
    assert np.all(travelled <= np.pi * (motion.frame_count - 1) + 1e-6)


@given(seeds)
def test_rotations_stay_of_unit_length(seed: int) -> None:
    motion = random_motion(seed)
    dense = evenly(motion, 97.0)
    assert np.allclose(np.linalg.norm(dense.rotations, axis=-1), 1.0, atol=1e-12)


def test_the_ends_are_held() -> None:
    motion = random_motion(7)
    first, last = motion.times[0], motion.times[-1]
    held = resample(motion, np.array([first - 5.0, first - 1e-9, last + 1e-9, last + 5.0]))
    ends = [0, 0, -1, -1]
    assert np.array_equal(held.translations, motion.translations[ends])
    assert np.array_equal(held.rotations, motion.rotations[ends])


def test_a_single_pose_is_held_everywhere() -> None:
    pose = random_motion(8, frame_count=1)
    held = resample(pose, np.array([0.0, 1.0, 2.0]))
    assert np.array_equal(held.rotations, np.repeat(pose.rotations, 3, axis=0))


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0, 120.0, 24000 / 1001])
def test_evenly_keeps_the_last_sample_of_a_clip_of_the_same_rate(rate: float) -> None:
    random = random_motion(9, frame_count=301)
    clip = Motion(np.arange(301) / rate, random.translations, random.rotations)
    same = evenly(clip, rate)
    assert same.frame_count == 301
    assert np.allclose(same.times, clip.times, rtol=0.0, atol=1e-12)
    assert np.allclose(same.translations, clip.translations, atol=1e-9)


def test_evenly_ends_at_or_before_the_last_sample() -> None:
    random = random_motion(10, frame_count=100)
    clip = Motion(np.arange(100) / 120.0, random.translations, random.rotations)
    film = evenly(clip, 24.0)
    assert film.frame_count == 20
    assert np.allclose(film.translations, clip.translations[::5])


def captured(frame_count: int = 9) -> Capture:
    random = np.random.default_rng(3)
    seen = np.ones((frame_count, 2), dtype=bool)
    seen[3, 1] = False
    markers = Markers(("A", "B"), random.normal(size=(frame_count, 2, 3)), seen)
    times = np.arange(frame_count) / 60.0
    return Capture(name="c", up="Y", frame_rate=60.0, times=times, markers=markers)


def test_captured_markers_at_their_own_rate_stay_as_they_are() -> None:
    again = capture_evenly(captured(), 60.0)
    np.testing.assert_array_equal(again.markers.positions, captured().markers.positions)
    np.testing.assert_array_equal(again.markers.seen, captured().markers.seen)


def test_captured_markers_go_straight_and_are_seen_where_both_sides_are() -> None:
    twice = capture_evenly(captured(), 120.0)
    own = captured().markers
    assert twice.frame_rate == 120.0
    assert len(twice.times) == 17
    np.testing.assert_allclose(twice.markers.positions[::2], own.positions, atol=1e-12)
    middles = 0.5 * (own.positions[1:] + own.positions[:-1])
    np.testing.assert_allclose(twice.markers.positions[1::2], middles, atol=1e-12)
    np.testing.assert_array_equal(
        twice.markers.seen[:, 1].nonzero()[0], [0, 1, 2, 3, 4, *range(8, 17)]
    )

"""What jumps away and back is found where it is and nowhere else; true moves are left alone."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from usdmotion.cleaning.outliers import find_outliers, without
from usdmotion.demos.gait import walk
from usdmotion.demos.kick import kick
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion

RATES = [24.0, 30.0, 60.0, 120.0]


def spiked(motion: Motion, bad: np.ndarray, degrees: float, seed: int = 0) -> Motion:
    """Return a motion whose marked samples are turned away, each run about an axis of its own."""
    rotations = np.array(motion.rotations)
    random = np.random.default_rng(seed)
    for joint in range(bad.shape[1]):
        for frame in np.flatnonzero(bad[:, joint]):
            if frame == 0 or not bad[frame - 1, joint]:
                axis = random.normal(size=3)
                away = from_vector(np.radians(degrees) * axis / np.linalg.norm(axis))
            rotations[frame, joint] = multiply(rotations[frame, joint], away)
    return replace(motion, rotations=rotations)


def one_joint(angles: np.ndarray, rate: float) -> Motion:
    """Return the motion of a joint that turns about X by some angles [degrees]."""
    turns = Rotation.from_rotvec(np.radians(angles)[:, None] * (1.0, 0.0, 0.0)).as_quat()
    count = len(angles)
    return Motion(np.arange(count) / rate, np.zeros((count, 1, 3)), turns[:, None])


@pytest.mark.parametrize("rate", RATES)
def test_clean_motion_has_none(smooth, rate) -> None:
    for seed in range(5):
        found = find_outliers(smooth(rate, seed=seed))
        assert not found.either.any()


@pytest.mark.parametrize("rate", RATES)
def test_walking_and_kicking_have_none(rate) -> None:
    assert not find_outliers(walk(6.0, rate).motion).either.any()
    assert not find_outliers(kick().motion).either.any()


@pytest.mark.parametrize("sigma", [0.1, 1.0, 3.0])
def test_noise_is_for_the_filter_and_not_an_outlier(smooth, noisy, sigma) -> None:
    for seed in range(5):
        assert not find_outliers(noisy(smooth(seed=seed), sigma, seed)).either.any()


@pytest.mark.parametrize("rate", RATES)
@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10**6), degrees=st.floats(60.0, 150.0))
def test_single_spikes_are_found_exactly_where_they_are(smooth, rate, seed, degrees) -> None:
    motion = smooth(rate, seed=seed)
    bad = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    random = np.random.default_rng(seed)
    for joint in range(4):
        bad[8 * random.choice(motion.frame_count // 8 - 1, 4, replace=False) + 7, joint] = True
    found = find_outliers(spiked(motion, bad, degrees, seed))
    assert np.array_equal(found.rotations, bad)
    assert not found.translations.any()


@pytest.mark.parametrize("length", [2, 3, 5, 8, 12])
def test_runs_of_up_to_a_tenth_of_a_second_are_found(smooth, length) -> None:
    motion = smooth(120.0)
    bad = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    for joint, start in enumerate((40, 130, 220, 310)):
        bad[start : start + length, joint] = True
    assert np.array_equal(find_outliers(spiked(motion, bad, 90.0)).rotations, bad)


def test_what_stays_away_longer_is_motion(smooth) -> None:
    motion = smooth(120.0)
    away = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    away[200:214] = True
    assert not find_outliers(spiked(motion, away, 90.0)).either.any()
    away[200:] = True
    assert not find_outliers(spiked(motion, away, 90.0)).either.any()


@pytest.mark.parametrize(
    ("rate", "duration"), [(120, 0.2), (120, 0.07), (60, 0.12), (60, 0.3), (30, 0.25), (24, 0.3)]
)
def test_a_move_away_and_back_over_seven_samples_is_left_alone(rate, duration) -> None:
    times = np.arange(round(2.0 * rate)) / rate
    for moment in 1.0 + np.linspace(0.0, 1.0 / rate, 7):
        phase = np.clip((times - moment) / duration, -0.5, 0.5)
        angles = 30.0 * 0.5 * (1.0 + np.cos(2.0 * np.pi * phase))
        assert not find_outliers(one_joint(angles, rate)).either.any()


def test_a_jump_from_pose_to_pose_is_left_alone_in_one_step_or_two() -> None:
    for steps in ([90.0], [45.0, 90.0], [30.0, 60.0, 90.0]):
        angles = np.concatenate([np.zeros(30), steps, np.full(30, 90.0)])
        assert not find_outliers(one_joint(angles, 60.0)).either.any()


def test_a_t_pose_before_the_first_frame_is_replaced_by_that() -> None:
    angles = np.concatenate([[80.0], 5.0 * np.sin(np.arange(60) / 10.0)])
    motion = one_joint(angles, 60.0)
    found = find_outliers(motion)
    assert np.flatnonzero(found.rotations).tolist() == [0]
    assert np.allclose(without(motion, found).rotations[0], motion.rotations[1])


def test_a_joint_that_is_lost_at_its_last_place_is_found_both_ways_in_time() -> None:
    angles = 40.0 * np.sin(2.0 * np.pi * np.arange(240) / 120.0)
    angles[55:60] = angles[54]
    motion = one_joint(angles, 120.0)
    found = find_outliers(motion)
    assert np.flatnonzero(found.rotations).tolist() == [55, 56, 57, 58, 59]
    assert np.array_equal(find_outliers(backwards(motion)).rotations, found.rotations[::-1])


def test_a_joint_that_rests_is_not_lost() -> None:
    swing = 40.0 * (1.0 - np.cos(2.0 * np.pi * np.arange(60) / 120.0))
    angles = np.concatenate([swing, np.full(8, swing[-1]), swing[::-1]])
    assert not find_outliers(one_joint(angles, 120.0)).either.any()


def test_samples_that_are_lost_to_no_rotation_or_to_the_origin_are_found(smooth) -> None:
    motion = smooth(120.0)
    rotations, translations = np.array(motion.rotations), 1.0 + np.array(motion.translations)
    rotations[100:104, 1] = (0.0, 0.0, 0.0, 1.0)
    translations[200:203, 0] = 0.0
    found = find_outliers(Motion(motion.times, translations, rotations))
    assert np.argwhere(found.rotations).tolist() == [[frame, 1] for frame in range(100, 104)]
    assert np.argwhere(found.translations).tolist() == [[frame, 0] for frame in range(200, 203)]


def test_what_replaces_them_is_near_the_truth_and_nothing_else_changes(smooth, apart) -> None:
    motion = smooth(120.0)
    bad = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    bad[50:53, 0] = bad[100, 1] = bad[150:156, 2] = True
    broken = spiked(motion, bad, 100.0)
    mended = without(broken, find_outliers(broken))
    assert apart(mended, motion).max() < 3.0
    assert np.array_equal(mended.rotations[~bad], broken.rotations[~bad])
    assert np.array_equal(mended.translations, broken.translations)


def backwards(motion: Motion) -> Motion:
    return Motion(
        motion.times[-1] - motion.times[::-1], motion.translations[::-1], motion.rotations[::-1]
    )


@pytest.fixture
def broken(smooth, noisy) -> tuple[Motion, np.ndarray]:
    """Return a noisy motion with some runs turned away, and where these are."""
    motion = noisy(smooth(60.0), 0.5)
    bad = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    bad[30, 0] = bad[90:92, 1] = bad[150:155, 2] = bad[199, 3] = bad[0, 3] = True
    return spiked(motion, bad, 120.0), bad


def test_neither_frames_nor_signs_nor_the_direction_of_time_matter(broken) -> None:
    motion, bad = broken
    assert np.array_equal(find_outliers(motion).rotations, bad)
    random = np.random.default_rng(3)
    left, right = random.normal(size=(2, 4))
    signs = random.choice([-1.0, 1.0], (motion.frame_count, 4, 1))
    for rotations in (
        multiply(left / np.linalg.norm(left), motion.rotations),
        multiply(motion.rotations, right / np.linalg.norm(right)),
        motion.rotations * signs,
    ):
        assert np.array_equal(find_outliers(replace(motion, rotations=rotations)).rotations, bad)
    assert np.array_equal(find_outliers(backwards(motion)).rotations, bad[::-1])


def test_two_spikes_near_each_other_do_not_hide_each_other(smooth) -> None:
    motion = smooth(120.0)
    bad = np.zeros((motion.frame_count, 4), dtype=np.bool_)
    bad[[100, 103], 0] = True
    assert np.array_equal(find_outliers(spiked(motion, bad, 90.0)).rotations, bad)


def test_uneven_samples_are_no_outliers(smooth) -> None:
    motion = smooth(120.0)
    keep = np.sort(np.random.default_rng(4).choice(motion.frame_count, 250, replace=False))
    thinned = Motion(motion.times[keep], motion.translations[keep], motion.rotations[keep])
    assert not find_outliers(thinned).either.any()


@pytest.mark.parametrize("count", [1, 2, 5])
def test_a_few_samples_say_nothing(smooth, count) -> None:
    motion = smooth(24.0)
    short = Motion(motion.times[:count], motion.translations[:count], motion.rotations[:count])
    assert not find_outliers(short).either.any()

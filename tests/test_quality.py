"""How a motion moves: laws of jerk, of standing and sliding feet, and of the centre of mass."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.kernels import from_vector, rotate
from usdmotion.quality import along_ground, center_of_mass, jerk, runs, slide, speed, standing

UP = np.array([0.0, 1.0, 0.0])
TIMES = np.arange(48) / 24.0
LEG = 0.9


def uneven(seed: int = 0) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).uniform(0.01, 0.1, 40))


def cubic(times, coefficients):
    return sum(np.multiply.outer(times**power, each) for power, each in enumerate(coefficients))


@given(st.integers(0, 2**32 - 1))
def test_the_jerk_of_a_cubic_is_constant_however_uneven_its_samples(seed):
    coefficients = np.random.default_rng(seed).normal(size=(4, 3))
    when, found = jerk(uneven(seed), cubic(uneven(seed), coefficients))
    assert len(when) == len(found) == 37
    assert np.allclose(found, 6.0 * np.linalg.norm(coefficients[3]), rtol=1e-4, atol=1e-4)


def test_what_accelerates_evenly_is_not_jerked():
    points = cubic(uneven(), [(1.0, 2.0, 3.0), (0.1, 0.0, 4.0), (0.0, -9.81, 0.0)])
    assert np.allclose(jerk(uneven(), points)[1], 0.0, atol=1e-6)


def test_many_points_are_jerked_each_by_itself():
    points = np.random.default_rng(1).normal(size=(40, 5, 3))
    _, found = jerk(uneven(), points)
    assert found.shape == (37, 5)
    for point in range(5):
        assert np.array_equal(found[:, point], jerk(uneven(), points[:, point])[1])


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_fewer_than_four_frames_have_no_jerk(count):
    when, found = jerk(TIMES[:count], np.ones((count, 2, 3)))
    assert when.shape == (0,) and found.shape == (0, 2)


def test_one_frame_has_no_speed_and_even_movement_has_its_own():
    assert np.array_equal(speed(TIMES[:1], np.ones((1, 2, 3))), np.zeros((1, 2)))
    assert np.allclose(speed(TIMES, np.multiply.outer(TIMES, (0.0, 3.0, 4.0))), 5.0)


@given(st.lists(st.booleans(), max_size=30))
def test_runs_put_together_are_the_mask(mask):
    again = np.zeros(len(mask), dtype=bool)
    for first, end in runs(np.array(mask, dtype=bool)):
        assert first < end and not again[first:end].any()
        assert (first == 0 or not mask[first - 1]) and (end == len(mask) or not mask[end])
        again[first:end] = True
    assert again.tolist() == mask


def walk() -> tuple[np.ndarray, np.ndarray]:
    """Return two feet that step in turn, (F, 2, 3), and when each stands, (F, 2)."""
    feet = np.zeros((len(TIMES), 2, 3))
    stands = np.ones((len(TIMES), 2), dtype=bool)
    for foot, start in enumerate((8, 28)):
        s = np.clip((np.arange(len(TIMES)) - start) / 12.0, 0.0, 1.0)
        feet[:, foot] = np.stack([0.1 * foot + 0 * s, 0.1 + 0.12 * np.sin(np.pi * s), 0.6 * s], 1)
        stands[start : start + 13, foot] = False
    return feet, stands


def test_feet_stand_while_they_are_down_and_slow():
    feet, stands = walk()
    found = standing(TIMES, feet, feet, np.arange(2), UP, LEG)
    assert (found != stands).sum(axis=0).max() <= 2  # at the very first and last of a step
    assert not found[12:18, 0].any() and not found[32:38, 1].any()


def test_a_foot_that_is_held_up_does_not_stand_however_still():
    feet, _ = walk()
    feet[:, 1] = (0.1, 0.5, 0.0)
    found = standing(TIMES, feet, feet, np.arange(2), UP, LEG)
    assert found[:8, 0].all() and not found[:, 1].any()


def test_a_foot_on_the_next_step_of_a_stair_stands():
    feet = np.zeros((len(TIMES), 2, 3))
    feet[:, 1, 1] = 0.17
    assert standing(TIMES, feet, feet, np.arange(2), UP, LEG).all()


def test_what_rests_only_for_a_moment_does_not_stand():
    point = np.zeros((len(TIMES), 1, 3))
    point[:, 0, 2] = np.abs(TIMES - TIMES[20])
    low = np.zeros((len(TIMES), 1, 3))
    assert not standing(TIMES, point, low, np.zeros(1, dtype=int), UP, LEG).any()


def test_a_still_foot_does_not_slide_and_height_is_no_slide():
    point = np.tile((0.3, 0.0, 0.2), (len(TIMES), 1))
    point[:, 1] = np.sin(TIMES)
    assert np.allclose(slide(point, np.ones(len(TIMES), dtype=bool), UP), 0.0, atol=1e-12)


def test_a_foot_that_stands_in_two_places_slides_in_neither():
    feet, _ = walk()
    stands = np.ones(len(TIMES), dtype=bool)
    stands[8:21] = False
    assert np.allclose(slide(feet[:, 0], stands, UP), 0.0, atol=1e-12)
    assert slide(feet[:, 0], np.ones_like(stands), UP).max() > 0.2


def test_an_even_slide_is_half_its_length_from_its_middle():
    point = np.multiply.outer(np.linspace(0.0, 0.04, len(TIMES)), (1.0, 0.0, 0.0))
    found = slide(point, np.ones(len(TIMES), dtype=bool), UP)
    assert found.max() == pytest.approx(0.02)


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 10.0))
def test_neither_place_nor_axis_nor_size_changes_what_is_seen(seed, size):
    random = np.random.default_rng(seed)
    turn, shift = from_vector(random.normal(size=3)), random.normal(size=3)
    feet, _ = walk()
    there, up = rotate(turn, size * feet) + shift, rotate(turn, UP)
    stands = standing(TIMES, feet, feet, np.arange(2), UP, LEG)
    assert np.array_equal(standing(TIMES, there, there, np.arange(2), up, size * LEG), stands)
    assert np.allclose(
        slide(there[:, 0], stands[:, 0], up), size * slide(feet[:, 0], stands[:, 0], UP)
    )
    assert np.allclose(
        jerk(TIMES, there)[1], size * jerk(TIMES, feet)[1], rtol=1e-6, atol=1e-6 * size
    )


def test_what_is_along_the_ground_has_no_height():
    vectors = np.random.default_rng(0).normal(size=(5, 3))
    flat = along_ground(vectors, UP)
    assert np.array_equal(flat[:, 1], np.zeros(5))
    assert np.array_equal(flat[:, [0, 2]], vectors[:, [0, 2]])


def test_the_centre_of_mass_is_the_mean_of_the_masses_where_they_hang():
    positions = np.array([[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (9.0, 9.0, 9.0)]])
    quarter = from_vector(np.array([0.0, 0.0, np.pi / 2]))
    orientations = np.tile(quarter, (1, 3, 1))
    centers = np.array([(1.0, 0.0, 0.0), (0.0, 0.0, 2.0), (5.0, 5.0, 5.0)])
    found = center_of_mass(positions, orientations, np.array([3.0, 1.0, 0.0]), centers)
    assert np.allclose(found, [[0.25, 0.75, 0.5]])

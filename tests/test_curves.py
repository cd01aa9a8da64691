"""Curves: the activity profile."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.curves import Spline, ease, kochanek_bartels, time_curve

KEYS = (1.0, 2.0, 5.0, 7.0)
times = st.floats(-20.0, 20.0)


def at(time: float, keys: tuple[float, ...] = KEYS) -> float:
    return float(ease(np.array([time]), keys)[0])


def test_no_key_times_mean_fully_on_throughout() -> None:
    np.testing.assert_array_equal(ease(np.array([-1e6, 0.0, 1e6]), ()), 1.0)


def test_four_key_times_ease_in_and_out_with_the_cubic_step() -> None:
    assert [at(time) for time in (0.0, 1.0, 2.0, 3.5, 5.0, 7.0, 8.0)] == [0, 0, 1, 1, 1, 0, 0]
    assert at(1.5) == pytest.approx(0.5)
    assert at(1.25) == pytest.approx(3 * 0.25**2 - 2 * 0.25**3)
    assert at(6.0) == pytest.approx(0.5)


def test_two_key_times_are_a_closed_interval_without_easing() -> None:
    interval = (1.0, 2.0)
    assert [at(time, interval) for time in (0.99, 1.0, 1.5, 2.0, 2.01)] == [0, 1, 1, 1, 0]
    assert at(1.0 - 1e-7, interval) == at(2.0 + 1e-7, interval) == 1.0


def test_two_equal_key_times_are_one_sample() -> None:
    assert [at(time, (1.0, 1.0)) for time in (0.9, 1.0, 1.1)] == [0, 1, 0]


@given(times)
def test_it_never_leaves_zero_and_one(time: float) -> None:
    assert 0.0 <= at(time) <= 1.0


@given(times, times)
def test_it_rises_before_the_plateau_and_falls_after_it(one: float, other: float) -> None:
    early, late = sorted((one, other))
    if late <= KEYS[1]:
        assert at(early) <= at(late)
    if early >= KEYS[2]:
        assert at(early) >= at(late)


@given(times)
def test_it_mirrors_with_its_key_times(time: float) -> None:
    mirrored = tuple(-key for key in reversed(KEYS))
    assert at(time) == pytest.approx(at(-time, mirrored), abs=1e-12)


def test_it_is_smooth_at_its_keys() -> None:
    step = 1e-5
    for key in KEYS:
        assert abs(at(key + step) - at(key - step)) < 1e-8


KNOTS = np.array([0.0, 0.4, 1.5, 2.0, 3.1])
POINTS = np.random.default_rng(4).normal(size=(5, 3))
PLAIN = np.zeros((5, 3))
ENDS = (np.array([1.0, 0.0, 0.0]), np.array([0.0, 2.0, 0.0]))


def test_the_spline_passes_its_points_whatever_its_shape() -> None:
    shape = np.random.default_rng(5).uniform(-1, 1, size=(5, 3))
    assert np.allclose(kochanek_bartels(KNOTS, KNOTS, POINTS, shape, ENDS), POINTS, atol=1e-12)


def test_its_velocity_is_continuous_and_as_asked_for_at_the_ends() -> None:
    u = np.linspace(KNOTS[0], KNOTS[-1], 31001)
    curve = kochanek_bartels(u, KNOTS, POINTS, PLAIN, ENDS)
    velocity = np.diff(curve, axis=0) / np.diff(u)[:, None]
    assert np.abs(np.diff(velocity, axis=0)).max() < 0.02
    assert np.allclose(velocity[0], ENDS[0], atol=0.01)
    assert np.allclose(velocity[-1], ENDS[1], atol=0.01)


def test_tension_1_stops_at_a_point() -> None:
    shape = np.array(PLAIN)
    shape[2, 0] = 1.0
    around = KNOTS[2] + np.array([-1e-5, 0.0, 1e-5])
    velocity = np.diff(kochanek_bartels(around, KNOTS, POINTS, shape, ENDS), axis=0) / 1e-5
    assert np.abs(velocity).max() < 1e-3


def test_points_on_a_line_at_even_speed_make_a_line() -> None:
    line = KNOTS[:, None] * np.array([1.0, -2.0, 0.5])
    speed = np.array([1.0, -2.0, 0.5])
    u = np.linspace(0.0, 3.1, 100)
    assert np.allclose(kochanek_bartels(u, KNOTS, line, PLAIN, (speed, speed)), u[:, None] * speed)


def test_with_even_knots_it_is_the_spline_of_the_paper() -> None:
    """Kochanek and Bartels 1984, equations 8 and 9, at one inner point."""
    tension, continuity, bias = 0.3, -0.4, 0.6
    shape = np.array(PLAIN)
    shape[2] = tension, continuity, bias
    even = np.arange(5.0)
    back, forth = POINTS[2] - POINTS[1], POINTS[3] - POINTS[2]
    leaving = (1 - tension) * (
        (1 + continuity) * (1 + bias) / 2 * back + (1 - continuity) * (1 - bias) / 2 * forth
    )
    after = kochanek_bartels(np.array([2.0, 2.0 + 1e-7]), even, POINTS, shape, ENDS)
    assert np.allclose(np.diff(after, axis=0)[0] / 1e-7, leaving, atol=1e-5)


def test_the_time_curve_rests_between_key_and_release() -> None:
    keys, releases = np.array([1.0, 2.0, 5.0, 6.0]), np.array([1.0, 3.5, 5.0, 6.0])
    times = np.array([1.0, 1.5, 2.0, 3.0, 3.5, 4.0, 5.0, 6.0])
    u, knots = time_curve(times, keys, releases)
    assert np.allclose(knots, [0.0, 1.0, 2.5, 3.5])
    assert np.allclose(u, [0.0, 0.5, 1.0, 1.0, 1.0, 1.5, 2.5, 3.5])


knot_values = st.lists(st.floats(0.0, 10.0), min_size=1, max_size=8)


@given(knot_values, st.floats(-5.0, 15.0))
def test_a_spline_stays_between_the_values_beside_it(values: list[float], time: float) -> None:
    knots = np.arange(len(values)) * 1.5
    spline = Spline.through(knots, np.array(values))
    before = values[int(np.clip(np.floor(time / 1.5), 0, len(values) - 1))]
    after = values[int(np.clip(np.ceil(time / 1.5), 0, len(values) - 1))]
    found = float(spline.at(np.array(time)))
    assert min(before, after) - 1e-9 <= found <= max(before, after) + 1e-9


def test_a_spline_goes_through_its_knots_and_is_flat_outside() -> None:
    knots, values = np.array([0.0, 1.0, 3.0]), np.array([1.0, 4.0, 2.0])
    spline = Spline.through(knots, values)
    np.testing.assert_allclose(spline.at(knots), values)
    np.testing.assert_array_equal(spline.at(np.array([-9.0, 9.0])), [1.0, 2.0])


def test_a_spline_has_no_corner_at_a_knot() -> None:
    spline = Spline.through(np.array([0.0, 1.0, 3.0, 4.0]), np.array([1.0, 2.0, 4.0, 9.0]))
    near = spline.at(np.array([1.0 - 1e-6, 1.0, 1.0 + 1e-6]))
    assert np.diff(near)[0] == pytest.approx(np.diff(near)[1], rel=1e-3)

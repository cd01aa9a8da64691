"""Curves: the activity profile."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.curves import ease

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

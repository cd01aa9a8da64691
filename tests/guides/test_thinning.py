"""Samples that are left out are near a line between those that are kept."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from usdmotion.guides import thinned

VALUES = st.tuples(st.integers(1, 40), st.integers(1, 3)).flatmap(
    lambda shape: arrays(np.float64, (*shape, 3), elements=st.floats(-5.0, 5.0))
)
TOLERANCES = st.floats(0.01, 1.0)


def times_of(values):
    return np.cumsum(np.arange(len(values)) % 3 + 1.0)


@given(VALUES, TOLERANCES)
def test_what_is_shown_is_within_the_tolerance_of_every_sample(values, tolerance):
    times = times_of(values)
    kept = thinned(times, values, tolerance)
    flat = values.reshape(len(values), -1)
    shown = [np.interp(times, times[kept], column[kept]) for column in flat.T]
    off = np.stack(shown, axis=1).reshape(values.shape) - values
    assert np.linalg.norm(off, axis=2).max() <= tolerance * (1.0 + 1e-9)


@given(VALUES, TOLERANCES)
def test_the_ends_and_what_is_smallest_or_largest_are_kept_where_anything_is(values, tolerance):
    kept = thinned(times_of(values), values, tolerance)
    assert (np.diff(kept) > 0).all() and kept[0] == 0
    if len(kept) > 1:
        assert kept[-1] == len(values) - 1
        for column in values.reshape(len(values), -1).T:
            if np.ptp(column) > tolerance:
                assert {column.min(), column.max()} <= set(column[kept])


def test_of_what_is_still_one_sample_is_kept_and_of_a_line_two():
    times = np.arange(30.0)
    line = times[:, None] * (1.0, 2.0, 3.0)
    assert thinned(times, np.ones((30, 3)), 1e-3).tolist() == [0]
    assert thinned(times, line, 1e-3).tolist() == [0, 29]

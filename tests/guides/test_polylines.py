"""A simplified polyline looks the same, and has no point that it does not need."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from usdmotion.guides.polylines import simplified

POLYLINES = st.integers(2, 40).flatmap(
    lambda count: arrays(np.float64, (count, 3), elements=st.floats(-5.0, 5.0))
)


def gap(point, polyline):
    """Return how far a point is from a polyline."""
    nearest = np.linalg.norm(polyline - point, axis=1).min()
    for start, end in pairwise(polyline):
        along = end - start
        share = np.clip((point - start) @ along / max(along @ along, 1e-30), 0.0, 1.0)
        nearest = min(nearest, np.linalg.norm(start + share * along - point))
    return nearest


@given(POLYLINES, st.floats(0.01, 1.0))
def test_every_point_is_within_the_tolerance_of_what_is_left(points, tolerance):
    left = simplified(points, tolerance)
    assert max(gap(point, left) for point in points) <= tolerance * (1.0 + 1e-9)


@given(POLYLINES, st.floats(0.01, 1.0))
def test_what_is_left_are_points_of_it_with_both_ends(points, tolerance):
    left = simplified(points, tolerance)
    assert all((point == points).all(axis=1).any() for point in left)
    assert (left[0] == points[0]).all()
    assert len(left) == 1 or (left[-1] == points[-1]).all()


def test_a_straight_line_needs_two_points():
    line = np.linspace((0.0, 0.0, 0.0), (1.0, 2.0, 3.0), 50)
    assert len(simplified(line, 1e-6)) == 2


def test_what_stays_is_one_point():
    assert len(simplified(np.full((30, 3), 0.25), 0.01)) == 1

"""The area that a body stands on holds all that bears it, and is as wide at each of them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from usdmotion.guides import support_guide

UP = np.array([0.0, 1.0, 0.0])
MARGIN = 0.02
SUPPORTS = st.tuples(st.integers(1, 5), st.integers(1, 6)).flatmap(
    lambda shape: st.tuples(
        arrays(np.float64, (*shape, 3), elements=st.floats(-1.0, 1.0, width=16)),
        arrays(np.bool_, shape),
    )
)


def outside(corners, point):
    """Return how far a point is outside of a polygon, seen from above: negative is inside."""
    flat = corners[:, [2, 0]]  # counterclockwise about y
    along = np.roll(flat, -1, axis=0) - flat
    lengths = np.linalg.norm(along, axis=1)
    edges = lengths > 1e-9
    off = point[[2, 0]] - flat
    inward = (along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0])[edges] / lengths[edges]
    return -inward.min()


@given(SUPPORTS)
def test_what_bears_is_inside_with_a_margin(given_supports):
    supports, bearing = given_supports
    area = support_guide(supports, bearing, UP, MARGIN)
    assert (area.there == bearing.any(axis=1)).all()
    for frame in np.flatnonzero(area.there):
        for point in supports[frame, bearing[frame]]:
            assert outside(area.corners[frame], point) < -0.6 * MARGIN


@given(SUPPORTS)
def test_corners_are_beside_what_bears_and_at_its_height(given_supports):
    supports, bearing = given_supports
    area = support_guide(supports, bearing, UP, MARGIN)
    for frame in np.flatnonzero(area.there):
        points = supports[frame, bearing[frame]]
        for corner in area.corners[frame]:
            beside = points[np.abs(points[:, 1] - corner[1]) < 1e-9]
            assert np.isclose(np.linalg.norm(beside - corner, axis=1).min(), MARGIN)


def test_corners_follow_the_same_points_until_something_else_bears():
    still = np.random.default_rng(1).uniform(-1.0, 1.0, (6, 4, 3))
    still[:] = still[0]
    bearing = np.ones((6, 4), dtype=bool)
    bearing[3:, 0] = False
    area = support_guide(still, bearing, UP, MARGIN)
    assert area.runs.tolist() == [0, 0, 0, 1, 1, 1]
    assert (area.corners[:3] == area.corners[0]).all()
    assert (area.corners[3:] == area.corners[3]).all()


def test_one_that_nothing_bears_stands_nowhere():
    area = support_guide(np.zeros((2, 0, 3)), np.zeros((2, 0), dtype=bool), UP, MARGIN)
    assert not area.there.any()

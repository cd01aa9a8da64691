"""Distances from shapes keep the laws of every signed distance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.kernels import Shape, gaps

EXTENTS = {
    "a point": (Shape.BOX, (0.0, 0.0, 0.0)),
    "a segment": (Shape.BOX, (0.0, 0.4, 0.0)),
    "a box": (Shape.BOX, (0.3, 0.2, 0.5)),
    "a slab": (Shape.BOX, (np.inf, 0.2, np.inf)),
    "a cylinder": (Shape.CYLINDER, (0.3, 0.3, 0.5)),
    "an endless cylinder": (Shape.CYLINDER, (0.3, 0.3, np.inf)),
    "a half-space": (Shape.HALF_SPACE, (0.0, 0.0, 0.0)),
}
places = st.lists(
    st.tuples(*[st.floats(-2.0, 2.0, allow_subnormal=False)] * 3), min_size=2, max_size=8
).map(np.array)


def measured(name, points):
    shape, extent = EXTENTS[name]
    extents = np.broadcast_to(np.array(extent), points.shape).copy()
    return gaps(shape, extents, np.array(points, dtype=np.float64))


@pytest.mark.parametrize("name", EXTENTS)
@given(places)
def test_no_two_points_differ_by_more_than_they_are_apart(name, points):
    _, distances = measured(name, points)
    apart = np.linalg.norm(points[0] - points[1])
    assert abs(distances[0] - distances[1]) <= apart + 1e-12


@pytest.mark.parametrize("name", EXTENTS)
@given(places)
def test_the_way_back_along_the_direction_ends_on_the_surface(name, points):
    directions, distances = measured(name, points)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0)
    _, left = measured(name, points - directions * distances[:, None])
    np.testing.assert_allclose(left, 0.0, atol=1e-9)


@pytest.mark.parametrize("name", EXTENTS)
@given(places, st.floats(0.01, 1.0))
def test_the_distance_grows_by_every_step_along_the_direction(name, points, step):
    directions, distances = measured(name, points)
    _, farther = measured(name, points + directions * step)
    outside = distances > 1e-9
    np.testing.assert_allclose((farther - distances)[outside], step, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "point", "distance"),
    [
        ("a point", (3.0, 4.0, 0.0), 5.0),
        ("a segment", (0.3, 0.8, 0.0), 0.5),
        ("a box", (0.1, 0.1, 0.1), -0.1),
        ("a box", (0.6, 0.6, 0.1), 0.5),
        ("a cylinder", (0.0, 0.2, 0.1), -0.1),
        ("a cylinder", (0.6, 0.0, 0.9), 0.5),
        ("a half-space", (5.0, 6.0, -0.25), -0.25),
    ],
)
def test_it_is_negative_inside_and_euclidean_outside(name, point, distance):
    assert measured(name, np.array([point]))[1][0] == pytest.approx(distance)

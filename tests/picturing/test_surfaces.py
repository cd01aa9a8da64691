"""Surfaces are drawn with their outside out, and not finer than can be seen."""

import numpy as np

from usdmotion.picturing.surfaces import drawn, lies_under
from usdmotion.usd.seeing import SeenSurface

UP = np.array((0.0, 1.0, 0.0))
CORNERS = np.array(list(np.ndindex(2, 2, 2)), dtype=float)
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
BOX = np.array([each for a, b, c, d in SIDES for each in ((a, b, c), (a, c, d))])


def surface(points, triangles):
    return SeenSurface("/Some", np.array(points, dtype=float), triangles, (1.0, 1.0, 1.0), 1.0)


def outwards(shape):
    """Tell of each triangle whether its normal points away from the middle."""
    a, b, c = shape.points[shape.triangles].transpose(1, 0, 2)
    return ((a + b + c) / 3.0 - shape.points.mean(axis=0)) * np.cross(b - a, c - a) @ np.ones(3) > 0


def test_the_outside_of_a_closed_surface_is_out_however_it_is_turned():
    for triangles in (BOX, BOX[:, ::-1]):
        for mirror in (1.0, -1.0):
            shape = drawn(surface(CORNERS * (mirror, 1.0, 1.0), triangles), beyond=False)
            assert not shape.both_sides
            assert outwards(shape).all()


def test_an_open_surface_has_two_sides():
    assert drawn(surface(CORNERS, BOX[:-1]), beyond=False).both_sides


def grid(count):
    points = np.array([(x, 0.0, z) for x in range(count) for z in range(count)], dtype=float)
    index = np.arange(count * count).reshape(count, count)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    halves = (np.stack([a, b, c], -1), np.stack([a, c, d], -1))
    return points, np.concatenate([each.reshape(-1, 3) for each in halves])


def test_what_is_finer_than_can_be_seen_is_drawn_with_fewer_triangles():
    points, triangles = grid(300)
    shape = drawn(surface(points, triangles), beyond=True)
    assert len(shape.triangles) < 0.4 * len(triangles)
    assert shape.triangles.max() < len(shape.points)
    np.testing.assert_allclose(np.ptp(shape.points, axis=0), np.ptp(points, axis=0), rtol=0.01)
    corners = shape.points[shape.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    assert area > 0.0


def test_a_floor_lies_under_those_that_are_above_it():
    points, triangles = grid(5)
    floor = surface(points, triangles)
    inside, outside = np.array([(2.0, 1.0, 2.0)]), np.array([(9.0, 1.0, 2.0)])
    assert lies_under([floor], inside, UP)
    assert not lies_under([floor], outside, UP)
    assert not lies_under([floor], inside - 3.0 * UP, UP)
    assert not lies_under([], inside, UP)

"""Cutting: what is seen stays as it is, and large triangles become small ones."""

import numpy as np

from usdmotion.drawing.cutting import halved, in_front, pieces
from usdmotion.drawing.eyes import Perspective

EYE = Perspective(np.zeros(3), *np.eye(3), focal=1.0, window=(-9.0, -9.0, 9.0, 9.0), clip=1.0)
TRIANGLES = np.random.default_rng(1).uniform(-3.0, 3.0, (60, 3, 3))


def normals(triangles):
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def test_triangles_are_cut_where_the_eye_no_longer_sees():
    left = -1.0 - TRIANGLES[..., 2]
    for one, depths in zip(TRIANGLES, left, strict=True):
        parts = in_front(one[None], EYE)
        assert len(parts) == (0, 1, 2, 1)[(depths > 0.0).sum()]
        assert (parts[..., 2] <= -1.0 + 1e-9).all()
        # Their areas point as that of the whole does, and what is seen of it is all there.
        assert (normals(parts) @ normals(one[None])[0] >= 0.0).all()
        if 0 < (depths > 0.0).sum() < 3:
            turned = one * (1.0, 1.0, -1.0) + (0.0, 0.0, -2.0)
            other = in_front(turned[None], EYE)
            areas = [np.linalg.norm(normals(each), axis=1).sum() for each in (parts, other)]
            np.testing.assert_allclose(sum(areas), np.linalg.norm(normals(one[None])))


def test_a_way_that_goes_behind_the_eye_comes_back_as_another():
    depths = np.array((-3.0, -2.0, 2.0, 3.0, -2.0))
    way = np.column_stack([np.arange(5.0), np.zeros(5), depths])
    first, second = pieces(way, EYE)
    assert first[-1, 2] == second[0, 2] == -1.0
    assert (first[0] == way[0]).all() and (second[-1] == way[-1]).all()
    assert [len(each) for each in pieces(way[2:4], EYE)] == []


def test_large_triangles_are_halved_until_they_are_small():
    corners = np.array((((-2.0, 0.0, -3.0), (2.0, 0.0, -3.0), (0.0, 3.0, -4.0)),))
    small = halved(corners, EYE, EYE.window, 0.5)
    edges = np.linalg.norm(small[:, [1, 2, 0]] - small, axis=2)
    assert edges.max() <= 0.5
    np.testing.assert_allclose(normals(small).sum(axis=0), normals(corners)[0])

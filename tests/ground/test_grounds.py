"""Grounds of every sort say the same of the same surface."""

import numpy as np
import pytest

from usdmotion.errors import SceneError
from usdmotion.ground import FunctionGround, Ground, MeshGround, PlaneGround, SeveralGrounds

Y, Z = np.eye(3)[1], np.eye(3)[2]
ONCE = np.zeros(1)


def tilted(places):
    """Return the height of a plane of which every ground here is one."""
    return 0.3 * places[..., 0] - 0.1 * places[..., 1] + 0.2


def points(up, heights=0.0, count=200, wide=4.0):
    random = np.random.default_rng(3)
    flat = random.uniform(-wide, wide, (1, count, 2))
    return np.insert(flat, int(np.argmax(up)), heights, axis=2), flat


def sheet(up, height, *, wide=5.0, count=11):
    """Return a mesh over a square, of triangles that look either way."""
    a, b = np.meshgrid(*[np.linspace(-wide, wide, count)] * 2, indexing="ij")
    flat = np.stack([a, b], axis=-1).reshape(-1, 2)
    corners = np.insert(flat, int(np.argmax(up)), height(flat), axis=1)
    index = np.arange(count * count).reshape(count, count)
    low = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:]], axis=-1)
    high = np.stack([index[:-1, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1)
    triangles = np.concatenate([low.reshape(-1, 3), high.reshape(-1, 3)[:, ::-1]])
    return MeshGround(corners, triangles, up)


def plane(up):
    slopes = np.insert([-0.3, 0.1], int(np.argmax(up)), 1.0)
    return PlaneGround(0.2 * up, -slopes, up)


@pytest.mark.parametrize("up", [Y, Z], ids="yz")
@pytest.mark.parametrize(
    "ground",
    [plane, lambda up: sheet(up, tilted), lambda up: FunctionGround(lambda p, t: tilted(p), up)],
    ids=["plane", "mesh", "function"],
)
def test_every_ground_knows_its_height_and_its_slope(ground, up):
    made = ground(up)
    assert isinstance(made, Ground)
    where, flat = points(up, heights=5.0)
    heights, normals = made.under(where, ONCE)
    np.testing.assert_allclose(heights, tilted(flat), atol=1e-9)
    slopes = np.insert([-0.3, 0.1], int(np.argmax(up)), 1.0)
    expected = np.broadcast_to(slopes / np.linalg.norm(slopes), normals.shape)
    np.testing.assert_allclose(normals, expected, atol=1e-6)


def test_beside_a_mesh_there_is_no_ground():
    where, flat = points(Y, heights=5.0, wide=8.0)
    heights, normals = sheet(Y, tilted).under(where, ONCE)
    beside = (np.abs(flat) > 5.0).any(axis=-1)
    assert beside.any() and np.array_equal(np.isnan(heights), beside)
    np.testing.assert_array_equal(normals[beside], np.broadcast_to(Y, normals[beside].shape))


def test_what_is_overhead_is_no_ground():
    floor, table = sheet(Y, lambda p: 0.0 * p[:, 0]), sheet(Y, lambda p: 0.0 * p[:, 0] + 0.75)
    both = SeveralGrounds.of([floor, table])
    for height, stands_on in ((0.1, 0.0), (0.4, 0.75), (2.0, 0.75)):
        where, _ = points(Y, heights=height)
        assert np.all(both.under(where, ONCE)[0] == stands_on)


def test_the_highest_of_several_counts_and_one_alone_is_itself():
    low, high = PlaneGround(-Y, Y, Y), sheet(Y, tilted, wide=2.0)
    where, flat = points(Y, heights=5.0)
    heights, _ = SeveralGrounds.of([high, low]).under(where, ONCE)
    inside = (np.abs(flat) < 2.0).all(axis=-1)
    np.testing.assert_allclose(heights, np.where(inside, tilted(flat), -1.0), atol=1e-9)
    assert SeveralGrounds.of([high]) is high


def test_seams_and_upright_faces_let_nothing_through():
    corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    quads = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    cube = MeshGround(corners, np.array(triangles), Y)
    along = np.linspace(0.0, 1.0, 101)
    where = np.stack([along, np.full(101, 1.2), along], axis=1)[None]
    np.testing.assert_allclose(cube.under(where, ONCE)[0], 1.0)


def test_a_mesh_that_moves_is_where_it_is_at_the_time():
    base = sheet(Y, tilted)
    moved = np.stack([base.points[0], base.points[0] + Y])
    lift = MeshGround(moved, base.triangles, Y, times=np.array([0.0, 2.0]))
    times = np.array([-1.0, 0.0, 0.5, 2.0, 3.0])
    where, flat = points(Y, heights=5.0)
    heights, _ = lift.under(np.repeat(where, 5, axis=0), times)
    rises = np.array([0.0, 0.0, 0.25, 1.0, 1.0])
    np.testing.assert_allclose(heights, tilted(flat) + rises[:, None], atol=1e-9)


def test_a_plane_that_moves_too():
    lift = PlaneGround(np.stack([0.0 * Y, Y]), Y, Y, times=np.array([0.0, 2.0]))
    where, _ = points(Y)
    heights, _ = lift.under(np.repeat(where, 3, axis=0), np.array([0.0, 0.5, 2.0]))
    np.testing.assert_allclose(heights, np.repeat([[0.0], [0.25], [1.0]], 200, axis=1))


def test_an_upright_plane_and_a_function_of_a_wrong_shape_are_refused():
    with pytest.raises(SceneError, match="lay it down"):
        PlaneGround(np.zeros(3), np.eye(3)[0], Y)
    wrong = FunctionGround(lambda places, times: places, Y)
    with pytest.raises(SceneError, match="return one height for each"):
        wrong.under(points(Y)[0], ONCE)

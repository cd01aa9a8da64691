"""A point stays on its side of a shape."""

import numpy as np
import pytest

from usdmotion.constraints import Region, RegionConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import Shape, from_vector, gaps, rotate
from usdmotion.solving import STOPS

TURN = from_vector(np.array([0.4, -0.3, 0.2]))
BOX = {"extent": np.array([0.2, 0.1, 0.15])}
REGIONS = {
    "cube": BOX,
    "sphere": {"margin": 0.2},
    "capsule": {"extent": np.array([0.0, 0.0, 0.15]), "margin": 0.1},
    "cylinder": {"shape": Shape.CYLINDER, "extent": np.array([0.15, 0.15, 0.2])},
    "plane": {"shape": Shape.HALF_SPACE},
}


def near_hand(humanoid, kind, offset):
    """Return a region whose centre is beside where a hand is on the first frame."""
    hand = humanoid.point(humanoid.cast, "left_wrist")[0]
    return Region(translation=hand + offset, rotation=TURN, **REGIONS[kind])


def keep(humanoid, region, side, joint="left_wrist", **fields):
    return RegionConstraint(
        path="/Keep",
        skeleton=humanoid.path,
        joint=humanoid.token(joint),
        region=region,
        side=side,
        **fields,
    )


def depth(region, points):
    """Return how far points are outside of a region [m], negative inside."""
    local = rotate(region.rotation * (-1, -1, -1, 1), points - region.translation)
    extents = np.tile(region.extent, (len(points), 1))
    return gaps(int(region.shape), extents, local)[1] - region.margin


@pytest.mark.parametrize("kind", REGIONS)
@pytest.mark.parametrize("side", ["inside", "outside"])
def test_the_point_stays_on_its_side(humanoid, kind, side):
    region = near_hand(humanoid, kind, (0.02, -0.03, 0.04) if side == "outside" else (0.1, 0.2, 0))
    before = depth(region, humanoid.point(humanoid.cast, "left_wrist"))
    solved = humanoid.solve(keep(humanoid, region, side))
    sign = 1.0 if side == "outside" else -1.0
    assert (sign * before).min() < -0.02
    after = depth(region, humanoid.point(solved.after, "left_wrist"))
    assert (sign * after).min() > -1e-6
    assert solved.errors.max() < 1e-6


@pytest.mark.parametrize("kind", REGIONS)
def test_on_its_side_it_is_free(humanoid, kind):
    region = near_hand(humanoid, kind, rotate(TURN, np.array([0.0, 0.0, -3.0])))
    solved = humanoid.solve(keep(humanoid, region, "outside"))
    np.testing.assert_allclose(solved.after.rotations, solved.before.rotations, atol=1e-15)
    assert not solved.solution.iterations.any()


def test_in_a_corner_it_is_held_by_every_wall(humanoid):
    region = near_hand(humanoid, "cube", rotate(TURN, np.array([0.35, 0.3, 0.3])))
    solved = humanoid.solve(keep(humanoid, region, "inside"))
    point = humanoid.point(solved.after, "left_wrist")
    local = rotate(TURN * (-1, -1, -1, 1), point - region.translation)
    assert (np.abs(local) <= BOX["extent"] + 1e-6).all()
    assert (np.abs(np.abs(local) - BOX["extent"]) < 1e-3).sum(axis=1).max() == 3


def test_a_lower_rank_comes_as_near_as_the_wall_lets_it(humanoid):
    hand = humanoid.point(humanoid.cast, "left_wrist")
    ceiling = Region(
        shape=Shape.HALF_SPACE,
        translation=hand[0] + (0.0, 0.1, 0.0),
        rotation=from_vector(np.array([-np.pi / 2, 0.0, 0.0])),
    )
    solved = humanoid.solve(
        keep(humanoid, ceiling, "inside"), humanoid.lift("left_wrist", 0.3, priority=2)
    )
    found = humanoid.point(solved.after, "left_wrist")
    np.testing.assert_allclose(found[:, 1], hand[0, 1] + 0.1, atol=1e-6)
    np.testing.assert_allclose(found[:, [0, 2]], hand[:, [0, 2]], atol=1e-3)


def test_a_region_may_move(humanoid):
    hand = humanoid.point(humanoid.cast, "left_wrist")
    path = hand + np.array([0.03, 0.0, 0.0])
    region = Region(margin=0.2, translation=path)
    solved = humanoid.solve(keep(humanoid, region, "outside"))
    found = np.linalg.norm(humanoid.point(solved.after, "left_wrist") - path, axis=1)
    np.testing.assert_allclose(found, 0.2, atol=1e-3)


def test_no_region_and_an_unknown_side_are_refused(humanoid):
    with pytest.raises(SceneError, match="</Keep> has no region"):
        humanoid.solve(keep(humanoid, None, "inside"))
    with pytest.raises(SceneError, match="use inside or outside"):
        humanoid.solve(keep(humanoid, Region(margin=1.0), "above"))


def test_a_posture_that_pushes_against_a_wall_comes_to_rest_there(humanoid):
    hand = humanoid.point(humanoid.cast, "left_wrist")
    floor = Region(
        shape=Shape.HALF_SPACE,
        translation=np.array([0.0, hand[:, 1].max() + 0.05, 0.0]),
        rotation=from_vector(np.array([-np.pi / 2, 0.0, 0.0])),
    )
    solved = humanoid.solve(keep(humanoid, floor, "outside", recruits=humanoid.chain("left_wrist")))
    found = humanoid.point(solved.after, "left_wrist")
    np.testing.assert_allclose(found[:, 1], hand[:, 1].max() + 0.05, atol=1e-5)
    assert (solved.solution.stops == STOPS.index("settled")).all()


@pytest.mark.parametrize("priority", [1, 2, 3])
def test_what_ranks_above_may_cross_a_wall_and_what_ranks_below_may_not(humanoid, priority):
    hand = humanoid.point(humanoid.cast, "left_wrist")
    ball = Region(margin=0.15, translation=hand + np.array([0.0, 0.3, 0.0]))
    high = humanoid.lift("left_wrist", 0.3, priority=2)
    solved = humanoid.solve(keep(humanoid, ball, "outside", priority=priority), high)
    depths = depth_of_ball(ball, humanoid.point(solved.after, "left_wrist"))
    if priority == 1:
        assert depths.min() > -1e-6
        assert solved.errors[:, 1].min() == pytest.approx(0.15, abs=1e-3)
    elif priority == 2:
        assert (depths > -0.14).all() and (depths < -0.01).all()
    else:
        assert solved.errors[:, 1].max() < 1e-6


def depth_of_ball(ball, points):
    """Return how far points are outside of a ball that moves [m]."""
    return np.linalg.norm(points - ball.translation, axis=1) - ball.margin

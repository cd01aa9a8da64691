"""Motions stand on their footprints."""

import numpy as np
import pytest

from usdmotion.demos import gait
from usdmotion.ground import FunctionGround, MeshGround, PlaneGround
from usdmotion.humanoid import PartMap
from usdmotion.kernels import conjugate, forward, multiply, to_vector
from usdmotion.motion import Motion, Placement
from usdmotion.s4d import Footprint, Morphology, stand

UP = np.array([0.0, 1.0, 0.0])


class Walker:
    """The walk of the demos, and where its feet stand."""

    def __init__(self):
        self.walk = gait.walk(seconds=3.0)
        self.motion = self.walk.motion
        self.body = Morphology.of(self.walk.skeleton, PartMap(self.walk.parts))
        self.footprints = [
            Footprint(self.walk.parts[joint], each.start, each.end, self.place(each, joint))
            for each in self.walk.stances
            for joint in [self.walk.skeleton.index[each.joint]]
            if each.effector == "toe" and self.during(each).any()
        ]

    def during(self, stance):
        return (self.motion.times >= stance.start) & (self.motion.times <= stance.end)

    def place(self, stance, joint):
        return self.world(self.motion)[0][self.during(stance), joint].mean(axis=0)

    def world(self, motion):
        return forward(self.walk.skeleton.parents, motion.translations, motion.rotations)

    def joint(self, part):
        return self.walk.parts.index(part)

    def stand(self, footprints, ground=None, **options):
        still = Placement.identity(self.motion.frame_count)
        return stand(self.motion, still, self.body, footprints, ground, up=UP, **options)

    def knee_steps(self, motion, side):
        turns = motion.rotations[:, self.joint(f"{side}_knee")]
        steps = to_vector(multiply(conjugate(turns[:-1]), turns[1:]))
        return np.degrees(np.linalg.norm(steps, axis=1))


@pytest.fixture(scope="module")
def walker():
    return Walker()


def same(one: Motion, other: Motion) -> bool:
    return np.allclose(one.rotations, other.rotations, rtol=0.0, atol=1e-9) and np.allclose(
        one.translations, other.translations, rtol=0.0, atol=1e-9
    )


def test_a_motion_that_stands_on_its_footprints_already_stays_as_it_is(walker):
    assert same(walker.stand(walker.footprints).motion, walker.motion)
    assert same(walker.stand([]).motion, walker.motion)


def moved(footprints, way):
    return [Footprint(each.part, each.start, each.end, each.place + way) for each in footprints]


def test_footprints_that_are_all_moved_take_the_whole_motion_along(walker):
    way = np.array([0.4, -0.2, 0.3])
    there = walker.world(walker.stand(moved(walker.footprints, way)).motion)
    was = walker.world(walker.motion)
    np.testing.assert_allclose(there[0], was[0] + way, atol=1e-9)


@pytest.mark.parametrize("way", [(0.06, 0.0, 0.0), (0.0, 0.0, -0.08), (0.02, -0.03, 0.0)])
def test_a_footprint_that_is_moved_is_stood_on_with_the_foot_turned_as_it_was(walker, way):
    first, *rest = walker.footprints[2:]
    asked = [*walker.footprints[:2], *moved([first], np.array(way)), *rest]
    standing = walker.stand(asked)
    positions, rotations = walker.world(standing.motion)
    _, before = walker.world(walker.motion)
    for each in asked:
        ball = positions[each.during(walker.motion.times), walker.joint(each.part)]
        np.testing.assert_allclose(ball, np.broadcast_to(each.place, ball.shape), atol=1e-6)
    for side in "lr":
        ankle = walker.joint(f"{side}_talocrural")
        apart = to_vector(multiply(conjugate(before[:, ankle]), rotations[:, ankle]))
        assert np.abs(apart).max() < 1e-9


def test_knees_do_not_pop_and_the_root_is_as_high_as_told(walker):
    first, *rest = walker.footprints[2:]
    raised = moved([first], np.array([0.0, 0.08, 0.05]))
    standing = walker.stand([*walker.footprints[:2], *raised, *rest])
    for side in "lr":
        before = walker.knee_steps(walker.motion, side).max()
        assert walker.knee_steps(standing.motion, side).max() <= before + 2.0
    heights = standing.heights
    hips = walker.world(standing.motion)[0][:, [walker.joint(f"{s}_hip") for s in "lr"]]
    np.testing.assert_allclose(hips.mean(axis=1) @ UP, heights.root, atol=1e-9)
    lowest = np.min([heights.carried, heights.left, heights.right], axis=0)
    np.testing.assert_array_equal(heights.root, lowest)


def test_a_footprint_may_say_how_the_foot_is_turned(walker):
    ankle = walker.joint("l_talocrural")
    stance = next(
        each
        for each in walker.walk.stances
        if each.effector == "heel" and each.side == "Left" and each.start > 0.5
    )
    positions, rotations = walker.world(walker.motion)
    flat = walker.during(stance) & (walker.motion.times > stance.start + 0.1)
    around = np.array([0.0, np.sin(0.1), 0.0, np.cos(0.1)])
    turned = multiply(around, rotations[flat, ankle][0])
    start, end = walker.motion.times[flat][[0, -1]]
    place = positions[flat, ankle].mean(axis=0)
    foot = Footprint("l_talocrural", start, end, place, turned)
    _, there = walker.world(walker.stand([*walker.footprints, foot]).motion)
    assert np.abs(to_vector(multiply(conjugate(turned), there[flat, ankle]))).max() < 1e-6


def test_a_footprint_of_a_ball_may_say_how_the_toes_are_turned(walker):
    first, *rest = walker.footprints
    held, ball = first.during(walker.motion.times), walker.joint(first.part)
    _, before = walker.world(walker.motion)
    around = np.array([0.0, np.sin(0.1), 0.0, np.cos(0.1)])
    turned = multiply(around, before[held, ball][0])
    told = Footprint(first.part, first.start, first.end, first.place, turned)
    _, there = walker.world(walker.stand([told, *rest]).motion)
    assert np.abs(to_vector(multiply(conjugate(turned), there[held, ball]))).max() < 1e-6
    ankle = walker.joint(first.part.replace("metatarsophalangeal", "talocrural"))
    still = multiply(conjugate(before[:, ankle]), there[:, ankle])
    assert np.abs(to_vector(still)).max() < 1e-9


DEPTH, RISE = 0.5, 0.15
"""Of the steps of stairs [m]."""


def staircase(missing=()):
    """Return treads of stairs along z, one below the origin, without some of them."""
    corners, triangles = [], []
    for step in (each for each in range(-4, 12) if each not in missing):
        near, far, y = step * DEPTH, (step + 1) * DEPTH, max(step, 0) * RISE
        first = len(corners)
        corners += [(x, y, z) for x in (-3.0, 3.0) for z in (near, far)]
        triangles += [(first, first + 1, first + 2), (first + 1, first + 3, first + 2)]
    return MeshGround(np.array(corners), np.array(triangles), UP)


def over(walker, motion, footprints):
    """Return how high balls are while they stand [m], one a footprint."""
    places = walker.world(motion)[0][..., 1]
    there = [(each.during(walker.motion.times), walker.joint(each.part)) for each in footprints]
    return np.array([places[frames, joint].mean() for frames, joint in there])


def test_what_was_made_on_stairs_comes_down_to_level_ground(walker):
    """A walk goes up a slope, and back on the plane each of its footprints is on the plane."""
    slope = FunctionGround(lambda places, _: 0.4 * np.maximum(places[..., 1], 0.0), UP)
    climbing = walker.stand(walker.footprints, slope).motion
    heights = over(walker, climbing, walker.footprints)
    assert np.ptp(heights) > 0.5
    climbed = [
        Footprint(each.part, each.start, each.end, [each.place[0], height, each.place[2]])
        for each, height in zip(walker.footprints, heights, strict=True)
    ]
    still = Placement.identity(walker.motion.frame_count)
    level = PlaneGround(np.zeros(3), UP, UP)
    down = stand(climbing, still, walker.body, climbed, level, up=UP)
    usual = walker.body.standing_heights[1]
    np.testing.assert_allclose(over(walker, down.motion, climbed), usual, atol=1e-3)


def test_a_step_that_is_missing_leaves_one_footprint_without_ground(walker):
    treads = [int(each.place[2] // DEPTH) for each in walker.footprints]
    missing = sorted(set(treads))[-3]
    beyond = [
        each for each, tread in zip(walker.footprints, treads, strict=True) if tread > missing
    ]
    assert beyond and missing * RISE > 0.3
    standing = walker.stand(walker.footprints, staircase(missing=(missing,)))
    assert standing.groundless
    assert not set(map(id, standing.groundless)) & set(map(id, beyond))


def test_one_frame_of_a_leg_that_is_too_short_stands_too(walker):
    frame = slice(20, 21)
    first = Motion(
        walker.motion.times[frame],
        walker.motion.translations[frame],
        walker.motion.rotations[frame],
    )
    apart = [
        Footprint(f"{side}_metatarsophalangeal", 0.0, 9.0, np.array([x, y, 0.5]))
        for side, x, y in (("l", 0.1, 0.05), ("r", -0.1, -0.9))
    ]
    standing = stand(first, Placement.identity(1), walker.body, apart, up=UP)
    assert standing.heights.wished[0] > standing.heights.root[0]
    assert np.isfinite(standing.motion.rotations).all()

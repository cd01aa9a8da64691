"""2005, figure 9: soles are on a slope, on steps and on bumps, and the root follows them."""

import numpy as np
import pytest
from pxr import Usd
from scipy.interpolate import PchipInterpolator

from usdmotion.demos import gait, terrain
from usdmotion.demos.walker import RATE, SKELETON

UP = np.array((0.0, 1.0, 0.0))
NEARLY_STRAIGHT = 0.995
"""A leg is stretched so far at most, over its length, where the input does not do more."""


@pytest.fixture(scope="module")
def walk():
    return gait.walk()


@pytest.fixture(scope="module")
def solved(tmp_path_factory, solve):
    shot = tmp_path_factory.mktemp("terrain") / "terrain.usda"
    terrain.build(shot)
    return solve(shot, SKELETON)


def ground(points):
    """Return how high the terrain is under some points [m], as its builder has it."""
    x, z = points[:, 0], points[:, 2]
    start, end = terrain.SLOPE
    height = np.where((z >= start) & (z < end), (z - start) / (end - start) * terrain.TOP, 0.0)
    for first, last, step in terrain.STEPS:
        height = np.where((z >= first) & (z < last), step, height)
    return np.where(z >= terrain.BUMPS[0], terrain.bumps(x, z), height)


@pytest.fixture(scope="module")
def soles(solved, walk):
    """Return each stance of the walk, with where its sole is on each frame of it."""
    seconds, points = walk.motion.times, {"heel": walk.heel_point, "toe": walk.toe_point}
    found = []
    for stance in walk.stances:
        there = (seconds >= stance.start - 1e-6) & (seconds <= stance.end + 1e-6)
        if there.any():
            sole = solved.after.point(stance.joint, points[stance.effector])
            found.append((stance, sole[there]))
    assert len(found) >= 20
    return found


def test_soles_are_on_the_ground_in_every_stance(soles):
    for stance, sole in soles:
        # What is drawn between the points of the bumps is a few millimetres off their formula.
        assert np.abs(sole[:, 1] - ground(sole)).max() <= 5e-3, stance


def test_nothing_of_a_foot_sinks_in_while_it_swings(solved, walk):
    for side in ("Left", "Right"):
        for joint, point in (("Foot", walk.heel_point), ("ToeBase", walk.toe_point)):
            sole = solved.after.point(f"{side}{joint}", point)
            assert (sole[:, 1] - ground(sole)).min() >= -5e-3


def test_planted_feet_do_not_slide(soles):
    for stance, sole in soles:
        assert np.ptp(sole, axis=0).max() <= 2e-3, stance


def carried(solved, walk, side):
    """Return how much higher a foot stands, eased from one stance to the next [m], (F,)."""
    seconds, joint = walk.motion.times, f"{side}ToeBase"
    rise = (solved.after.point(joint) - solved.before.point(joint))[:, 1]
    keys = [(s.start, s.end) for s in walk.stances if s.side == side and s.effector == "toe"]
    stands = [np.flatnonzero((seconds >= a - 1e-6) & (seconds <= b + 1e-6)) for a, b in keys]
    ends = np.array([frame for each in stands if len(each) for frame in (each[0], each[-1])])
    frames = np.arange(len(seconds))
    return PchipInterpolator(ends, rise[ends])(np.clip(frames, ends[0], ends[-1]))


def hips(take):
    """Return where the middle of the hip joints is, (F, 3)."""
    return 0.5 * (take.point("LeftUpLeg") + take.point("RightUpLeg"))


def test_the_root_is_as_high_as_its_legs_reach_and_as_its_feet_carry_it(solved, walk):
    before, after = solved.before, solved.after
    rises = [carried(solved, walk, side) for side in ("Left", "Right")]
    wished = hips(before)[:, 1] + np.mean(rises, axis=0)
    reached = []
    for side in ("Left", "Right"):
        thigh, shank, whole = (
            np.linalg.norm(before.point(f"{side}{a}") - before.point(f"{side}{b}"), axis=1)
            for a, b in (("UpLeg", "Leg"), ("Leg", "Foot"), ("UpLeg", "Foot"))
        )
        way = after.point(f"{side}Foot") - after.point(f"{side}UpLeg")
        leg = np.maximum(NEARLY_STRAIGHT * (thigh + shank), whole)
        room = np.sqrt(leg**2 - way[:, 0] ** 2 - way[:, 2] ** 2)
        reached.append(hips(after)[:, 1] + room + way[:, 1])
    root, lowest = hips(after)[:, 1], np.min([wished, *reached], axis=0)
    assert (root - lowest).max() <= 5e-3
    # It gives way a little before it has to, and is where it would be everywhere else.
    assert np.median(lowest - root) <= 4e-3
    assert (lowest - root).max() <= 0.03


def test_the_body_goes_over_it_evenly(solved):
    knees = [solved.pops(f"{side}Leg") for side in ("Left", "Right")]
    assert max(knees) <= 2.0, knees
    falls = np.abs(np.diff(hips(solved.after)[:, 1], 2)).max() * RATE**2
    assert falls <= 9.81


def test_what_is_not_of_the_legs_keeps_its_posture(solved):
    moved = {name for name in solved.before.joints if solved.turned(name) > 0.01}
    assert moved and all("Leg" in name for name in moved)


def test_on_level_ground_the_walk_stays_as_it_is(tmp_path, solve, walk):
    shot = tmp_path / "level.usda"
    terrain.build(shot)
    stage = Usd.Stage.Open(str(shot))
    stage.GetPrimAtPath(f"{SKELETON}/Terrain").GetRelationship("usdmotion:ground").SetTargets(
        [f"{terrain.GROUND}/Floor"]
    )
    stage.GetRootLayer().Save()
    level = solve(shot, SKELETON)
    assert max(level.moved(name) for name in level.before.joints) <= 0.1
    assert max(level.turned(name) for name in level.before.joints) <= 0.05

"""2004, figure 3: a walker reaches for a point and keeps his feet where they were."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from pxr import Usd

from usdmotion.demos import gait, reaching
from usdmotion.demos.walker import SKELETON


def knee_speed(take, name):
    turn = take.turn(name)
    return np.degrees((turn[:-1].inv() * turn[1:]).magnitude().max())


def test_the_feet_stay_where_they_were(demo: Callable[[str], Path], solve):
    solved = solve(demo("reaching"), SKELETON)
    walk = gait.walk()
    for side in ("Left", "Right"):
        assert solved.moved(f"{side}Foot", walk.heel_point) <= 0.01
        assert solved.moved(f"{side}ToeBase", walk.toe_point) <= 0.01


def test_the_wrist_is_at_its_goal_on_the_plateau(demo, solve):
    solved = solve(demo("reaching"), SKELETON)
    _, start, end, _ = reaching.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    assert there.sum() == end - start + 1
    assert solved.millimetres((solved.after.point("LeftHand") - reaching.TARGET)[there]) <= 0.01


def test_the_rest_of_the_walk_is_the_walk(demo, solve):
    solved = solve(demo("reaching"), SKELETON)
    away = (solved.after.times < reaching.FRAMES[0]) | (solved.after.times > reaching.FRAMES[3])
    apart = solved.after.world[away, :, 3, :3] - solved.before.world[away, :, 3, :3]
    assert solved.millimetres(apart) <= 0.1


def test_joints_that_nobody_recruits_equal_the_input(demo, solve):
    stage = Usd.Stage.Open(str(demo("reaching")))
    stage.GetPrimAtPath(f"{SKELETON}/Reaching/Balance").SetActive(False)
    stage.Save()
    solved = solve(Path(stage.GetRootLayer().realPath), SKELETON)
    for name in ("Head", "Neck", "RightShoulder", "RightArm", "RightForeArm", "RightHand"):
        index = solved.before.index(name)
        assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])


def test_no_knee_pops(demo, solve):
    solved = solve(demo("reaching"), SKELETON)
    for knee in ("LeftLeg", "RightLeg"):
        assert knee_speed(solved.after, knee) <= knee_speed(solved.before, knee) + 2.0


def test_the_report_says_so_too(demo, solve):
    (edit,) = solve(demo("reaching"), SKELETON).report.edits
    assert edit.frames == 145
    assert all(each.met for each in edit.constraints)
    assert [each.priority for each in edit.constraints] == [1, 1, 1, 1, 2, 3]
    assert max(each.max for each in edit.constraints) < 1e-5


def balance_lost(take, walk):
    """Return how far the centre of mass gets from over its supports, at most, [m] (F,)."""
    masses = walk.body.masses / walk.body.masses.sum()
    center = sum(
        mass * take.point(token, point)
        for token, mass, point in zip(
            walk.skeleton.joints, masses, walk.body.mass_centers, strict=True
        )
    )
    supports = [
        take.point(f"{side}{joint}", point)
        for side in ("Left", "Right")
        for joint, point in (("Foot", walk.heel_point), ("ToeBase", walk.toe_point))
    ]
    return (center - np.mean(supports, axis=0))[:, [0, 2]]


def test_without_the_constraint_the_centre_of_mass_leaves_its_supports(demo, solve):
    shot, walk = demo("reaching"), gait.walk()
    kept = solve(shot, SKELETON)
    stage = Usd.Stage.Open(str(shot))
    stage.GetPrimAtPath(f"{SKELETON}/Reaching/Balance").SetActive(False)
    stage.Save()
    lost = solve(shot, SKELETON)
    with_it, without = (
        each.millimetres(balance_lost(each.after, walk) - balance_lost(each.before, walk))
        for each in (kept, lost)
    )
    assert with_it <= 1.0
    assert without >= 100.0

"""Balance: the centre of mass over its supports, or where it is wanted."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import CenterOfMassConstraint, Goal, PositionConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import world_points
from usdmotion.plugins import host
from usdmotion.solving import Problem
from usdmotion.testing import humanoid_scene
from usdmotion.testing.scenes import HUMANOID

CAST = humanoid_scene().cast
TOKENS = [token for _, token in CAST.joints if token]
FEET = tuple(token for token in TOKENS if token.endswith("ankle"))
HAND = next(token for token in TOKENS if token.endswith("left_wrist"))


def solved(*constraints):
    problem = Problem.of(humanoid_scene(constraints))
    solution = host().solver("prioritized_ik")().solve(problem)
    after = replace(problem.cast, translations=solution.translations, rotations=solution.rotations)
    return problem.cast, after


def center(cast):
    places = world_points(cast.positions, cast.orientations, cast.mass_centers)
    return np.average(places, axis=1, weights=cast.masses)


def mean_support(cast):
    return np.mean([cast.positions[:, cast.index[(HUMANOID, foot)]] for foot in FEET], axis=0)


def balance(**fields):
    return CenterOfMassConstraint(path="/Balance", skeleton=HUMANOID, **fields)


def lifted(token, height):
    goal = Goal(mode="offset", translation=np.array([0.0, height, 0.0]))
    return PositionConstraint(path="/Lift", skeleton=HUMANOID, joint=token, goals=(goal,))


def test_without_supports_it_keeps_its_own_trajectory():
    before, after = solved(lifted(HAND, 0.15), balance(priority=2))
    assert np.abs(center(after) - center(before)).max() < 1e-6
    assert np.abs(after.positions - before.positions).max() > 0.1


def test_over_its_supports_it_goes_where_they_go():
    before, after = solved(lifted(FEET[0], 0.1), balance(priority=2, supports=FEET))
    moved = mean_support(after) - mean_support(before)
    assert np.abs(moved).max() > 0.02
    assert np.abs(center(after) - center(before) - moved).max() < 1e-6


def test_a_displacement_is_added():
    ahead = np.array([0.0, 0.0, 0.05])
    feet = [
        PositionConstraint(path=f"/{index}", skeleton=HUMANOID, joint=foot)
        for index, foot in enumerate(FEET)
    ]
    before, after = solved(*feet, balance(priority=2, supports=FEET, displacement=ahead))
    assert np.abs(center(after) - center(before) - ahead).max() < 1e-6


def test_goals_are_followed():
    goal = Goal(mode="offset", translation=np.array([0.05, -0.04, 0.0]))
    before, after = solved(balance(goals=(goal,)))
    assert np.abs(center(after) - center(before) - goal.translation).max() < 1e-6


def test_axes_leave_the_others_free():
    feet = [lifted(foot, 0.05) for foot in FEET]
    before, after = solved(*feet, balance(priority=2, axes="xz", supports=()))
    apart = center(after) - center(before)
    assert np.abs(apart[:, [0, 2]]).max() < 1e-6
    assert np.abs(apart[:, 1]).max() > 0.01


def test_it_recruits_all_joints():
    demand = balance().demand(humanoid_scene().cast)
    assert demand.recruits.sum() == len(TOKENS)


def test_a_body_without_masses_is_refused():
    (one,) = humanoid_scene().characters
    bare = replace(one, body=replace(one.body, masses=np.zeros(len(one.skeleton.joints))))
    scene = replace(humanoid_scene(), characters=(bare,))
    with pytest.raises(SceneError, match="without masses; author usdmotion:masses"):
        list(balance().tasks(scene.cast))


def test_supports_and_their_points_must_be_as_many():
    asked = balance(supports=FEET, support_points=np.zeros((1, 3)))
    with pytest.raises(SceneError, match="2 supports and 1 points"):
        list(asked.tasks(humanoid_scene().cast))

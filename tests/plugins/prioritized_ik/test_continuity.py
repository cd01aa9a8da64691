"""Velocities that are preserved, and limits of how they change."""

from dataclasses import replace

import numpy as np
import pytest
from usdmotion_prioritized_ik.continuity import A_WHILE, shares_of_velocity

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.kernels import conjugate, limit_boxes, multiply, to_vector
from usdmotion.kernels.limits import limited_vectors
from usdmotion.measuring import measure
from usdmotion.plugins import host
from usdmotion.solving import Problem
from usdmotion.testing import HUMANOID, humanoid_scene
from usdmotion.testing.resuming import check_resuming

from .conftest import Chain

SOLVER = host().solver("prioritized_ik")
RATE = 24.0
ON, OFF = 8, 16
WRIST = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"
FEET = [f"pelvis/{side}_hip/{side}_knee/{side}_ankle" for side in ("left", "right")]


def hold(token, priority, *goals, **fields):
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{token.rsplit('/', 1)[1]}",
        skeleton=HUMANOID,
        joint=token,
        priority=priority,
        goals=goals,
        **fields,
    )


def switched(**options):
    """Solve feet that stay and a wrist that is wanted elsewhere at once, and let go at once."""
    activity = np.zeros(24)
    activity[ON:OFF] = 1.0
    away = Goal(mode="offset", translation=np.array([0.1, 0.2, 0.1]))
    constraints = [*(hold(foot, 1) for foot in FEET), hold(WRIST, 2, away, activity=activity)]
    scene = humanoid_scene(constraints)
    problem = Problem.of(scene)
    solution = SOLVER(**options).solve(problem)
    return problem, solution, measure(problem, solution, scene.constraints)


def displacements(problem, solution):
    """Return input⁻¹ output of every joint, shape (frame_count, node_count, 4)."""
    return multiply(conjugate(problem.cast.rotations), solution.rotations)


def changes(problem, solution):
    """Return how far each joint's displacement turns from frame to frame [degrees a second]."""
    away = displacements(problem, solution)
    steps = to_vector(multiply(conjugate(away[:-1]), away[1:]))
    return np.degrees(np.linalg.norm(steps, axis=-1)) * RATE


def root_changes(problem, solution):
    """Return the same for the place of the root [m a second]."""
    away = solution.translations - problem.cast.translations
    return np.linalg.norm(np.diff(away, axis=0), axis=-1).max(axis=1) * RATE


def test_a_limit_of_change_makes_a_ramp_of_a_step():
    free, limited = switched(), switched(change=90.0, root_change=0.2)
    assert changes(*free[:2]).max() > 200.0
    assert changes(*limited[:2]).max() <= 90.0 + 1e-6
    assert root_changes(*limited[:2]).max() <= 0.2 + 1e-9
    assert free[2][ON, 2] < 1e-6
    reaching = limited[2][ON:OFF, 2]
    assert reaching[0] > 0.1
    assert (np.diff(reaching) < 1e-9).all()


def test_only_a_limit_of_the_joint_itself_lets_it_change_faster():
    faster = 0
    for seed in range(10):
        chain = Chain.random(seed, frames=10)
        (asked,) = chain.asked(seed, 0.5)
        problem = chain.problem([replace(asked, times=(3 / RATE, 6 / RATE))])
        solution = SOLVER(change=60.0).solve(problem)
        low, high = limit_boxes(problem.cast.limits_min, problem.cast.limits_max)
        found = limited_vectors(solution.rotations, problem.cast.rest_rotations, low, high)
        inside = ((found > low + 1e-9) & (found < high - 1e-9)).all(axis=-1)[1:]
        inputs = problem.cast.beyond_limits(problem.cast.rotations)
        clean = inside & (inputs[1:] == 0.0) & (inputs[:-1] == 0.0)
        change = changes(problem, solution)
        assert change[clean].max() <= 60.0 + 1e-6
        faster += np.count_nonzero(change > 60.0 + 1e-6)
        assert problem.cast.beyond_limits(solution.rotations)[:, problem.recruited].max() < 1e-9
    assert faster > 0


def test_what_ranks_above_is_met_under_the_limit_as_well():
    _, _, errors = switched(change=90.0, root_change=0.2)
    assert errors[:, :2].max() < 1e-6


def test_ranks_above_the_limit_are_as_they_are_without_it():
    free, above = switched(), switched(change=30.0, change_rank=2)
    on = slice(ON, OFF)
    assert above[2][on].max() < 1e-6
    assert free[2][on].max() < 1e-6
    under = switched(change=30.0, change_rank=1)
    assert under[2][:, :2].max() < 1e-6


def test_a_limit_that_nothing_comes_near_changes_nothing():
    _, free, _ = switched()
    _, limited, _ = switched(change=1e5, root_change=1e3)
    # Joints that nobody recruits any more come home by the pull, and not by being left alone.
    np.testing.assert_allclose(limited.rotations, free.rotations, atol=2e-3)


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_what_was_displaced_comes_home_by_the_share_in_a_tenth_of_a_second(share):
    problem, solution, _ = switched(velocity=share)
    arm = problem.cast.index[(HUMANOID, WRIST.rsplit("/", 2)[0])]
    turn = to_vector(displacements(problem, solution)[OFF - 1 :, arm])
    assert np.linalg.norm(turn[0]) > 0.05
    for step in range(1, 4):
        left = share ** (step / RATE / A_WHILE)
        np.testing.assert_allclose(turn[step], left * turn[0], atol=5e-3)


def test_the_share_is_one_of_time_and_not_of_frames():
    once, twice = (shares_of_velocity(np.array(times), 0.4) for times in ((0, 0.1), (0, 0.05, 0.1)))
    np.testing.assert_allclose(once, (0.0, 0.4))
    np.testing.assert_allclose(np.prod(twice[1:]), 0.4)
    for share in (0.0, 1.0):
        np.testing.assert_array_equal(shares_of_velocity(np.array((0.0, 0.3)), share), (0.0, share))


def test_with_all_of_velocity_joints_go_on_as_the_input_does():
    problem, solution, _ = switched(velocity=1.0)
    before, after = problem.cast.rotations, solution.rotations
    for frame in range(OFF + 1, 24):
        moved = [multiply(each[frame], conjugate(each[frame - 1])) for each in (before, after)]
        assert (
            np.linalg.norm(to_vector(multiply(conjugate(moved[0]), moved[1])), axis=-1).max() < 0.02
        )
    turn = to_vector(displacements(problem, solution)[-1])
    assert np.linalg.norm(turn, axis=-1).max() > 0.05


def test_with_angles_alone_it_is_home_at_once():
    problem, solution, _ = switched(velocity=0.0)
    np.testing.assert_allclose(
        solution.rotations[OFF + 2 :], problem.cast.rotations[OFF + 2 :], atol=1e-3
    )


def test_clips_that_are_cut_are_solved_alike_under_limits_and_with_velocities():
    check_resuming(SOLVER(velocity=0.5, change=90.0, root_change=0.3))

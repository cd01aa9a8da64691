"""Limits stand above every priority, and stand in the way of nothing else."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from usdmotion.constraints import Goal
from usdmotion.kernels import from_vector, limit_boxes, multiply
from usdmotion.kernels.limits import limited_vectors
from usdmotion.motion import Body
from usdmotion.plugins import host

from .conftest import CHAIN, Chain, errors


@pytest.fixture(scope="module")
def solver():
    return host().solver("prioritized_ik")()


def vectors(problem, solution):
    cast = problem.cast
    boxes = limit_boxes(cast.limits_min, cast.limits_max)
    return limited_vectors(solution.rotations, cast.rest_rotations, *boxes)


@pytest.mark.parametrize("reach", [0.1, 0.5, 2.0])
def test_no_recruited_joint_is_ever_beyond_its_limits(solver, reach):
    touched = 0
    for seed in range(20):
        chain = Chain.random(seed)
        problem = chain.problem(chain.asked(seed, reach, count=3))
        solution = solver.solve(problem)
        beyond = problem.cast.beyond_limits(solution.rotations)[:, problem.recruited]
        assert beyond.max() < 1e-9
        low, high = limit_boxes(problem.cast.limits_min, problem.cast.limits_max)
        found = vectors(problem, solution)
        touched += np.count_nonzero((found - low < 1e-9) | (high - found < 1e-9))
    assert touched > 400


def nearest(problem, solution, frame):
    """Return the least error near a pose on one frame, found by bounded least squares."""
    cast = problem.cast
    nodes = np.flatnonzero(problem.recruited)
    low, high = (each[nodes].ravel() for each in limit_boxes(cast.limits_min, cast.limits_max))
    start, loose = vectors(problem, solution)[frame, nodes].ravel(), high - low > 1e-9

    def left(values):
        vector = start.copy()
        vector[loose] = values
        rotations = np.array(solution.rotations)
        turns = from_vector(vector.reshape(-1, 3))
        rotations[frame, nodes] = multiply(cast.rest_rotations[nodes], turns)
        return errors(problem, replace(solution, rotations=rotations))[frame]

    begin = np.clip(start[loose], low[loose] + 1e-12, high[loose] - 1e-12)
    found = least_squares(left, begin, bounds=(low[loose], high[loose]), max_nfev=30)
    return np.sqrt(2.0 * found.cost)


def test_a_goal_out_of_reach_is_missed_by_no_more_than_limits_ask_for(solver):
    missed, better = 0, 0
    for seed in range(25):
        chain = Chain.random(seed, frames=2)
        problem = chain.problem(chain.asked(seed, 0.8))
        solution = solver.solve(problem)
        error = errors(problem, solution)[1, 0]
        missed += error > 1e-3
        better += error - nearest(problem, solution, 1) > 1e-4
    assert missed > 10
    assert better <= 1  # where it creeps along a border, the iteration limit ends it


def test_what_a_lower_level_presses_against_a_limit_stays_free_for_higher_ones(solver):
    changes = []
    for seed in range(20):
        chain = Chain.random(seed, joints=12)
        constraints = chain.asked(seed, 0.05, count=4)
        before = solver.solve(chain.problem(constraints[:3]))
        after = solver.solve(chain.problem(constraints))
        few = errors(chain.problem(constraints[:3]), before)
        all_ = errors(chain.problem(constraints), after)[:, :3]
        changes.append(np.abs(all_ - few)[few < 1e-7])
    assert np.concatenate(changes).size > 150
    assert np.concatenate(changes).max() < 1e-6


def test_limits_that_nothing_touches_change_no_bit(solver):
    for seed in range(5):
        chain = Chain.random(seed)
        constraints = chain.asked(seed, 0.1, count=2)
        wide = np.full((len(chain.skeleton.joints), 3), 175.0)
        body = replace(chain.body, limits_min=-wide, limits_max=wide)
        free = solver.solve(chain.free.problem(constraints))
        limited = solver.solve(replace(chain, body=body).problem(constraints))
        assert free.rotations.tobytes() == limited.rotations.tobytes()
        assert free.iterations.tobytes() == limited.iterations.tobytes()


def test_an_input_beyond_is_brought_back_on_frames_that_ask_for_nothing_too(solver):
    chain = Chain.random(3)
    (constraint,) = chain.asked(3, 0.1)
    times = (2 / 24, 3 / 24)
    late = replace(constraint, goals=(), times=times, recruits=chain.skeleton.joints[2:])
    problem = chain.problem([late])
    assert problem.cast.beyond_limits(problem.cast.rotations)[0, problem.recruited].max() > 1.0
    solution = solver.solve(problem)
    beyond = problem.cast.beyond_limits(solution.rotations)
    assert beyond[:, problem.recruited].max() < 1e-9
    others = ~problem.recruited
    assert np.array_equal(solution.rotations[:, others], problem.cast.rotations[:, others])


def test_a_hinge_bends_about_its_axis_only(solver):
    chain = Chain.random(0, joints=4)
    low, high = np.zeros((4, 3)), np.zeros((4, 3))
    low[:, 2], high[:, 2] = -120.0, 120.0
    body = replace(Body.unknown(4), limits_min=low, limits_max=high)
    rest = np.broadcast_to(chain.skeleton.rest_rotations, chain.motion.rotations.shape)
    hinged = replace(chain, body=body, motion=replace(chain.motion, rotations=rest))
    (constraint,) = hinged.asked(0, 0.0)
    goal = Goal(mode="offset", translation=np.array((0.3, 0.2, 0.1)))
    problem = hinged.problem([replace(constraint, joint="j3", goals=(goal,), skeleton=CHAIN)])
    found = vectors(problem, solver.solve(problem))[:, problem.recruited]
    assert np.abs(found[..., :2]).max() < 1e-12
    assert np.abs(found[..., 2]).max() > 0.1

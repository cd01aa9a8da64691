"""What the benchmarks ask is as large as they say, and can be done."""

import numpy as np
import pytest
from reaching import four_levels, reaching, twelve_points, unlimited

from usdmotion import Problem
from usdmotion.demos.gait import Walk
from usdmotion.kernels import forward, residuals
from usdmotion.plugins import host


def sizes(problem: Problem) -> tuple[int, int, int]:
    """Return the degrees of freedom, the rows and the levels."""
    translating = problem.recruited & problem.cast.translates
    freedom = 3 * int(problem.recruited.sum() + translating.sum())
    return freedom, int(problem.table.axes.sum()), int(problem.table.level.max()) + 1


def test_problems_have_the_sizes_that_the_table_names(walking: Walk) -> None:
    assert sizes(reaching(walking)) == (69, 18, 3)
    assert sizes(four_levels(walking)) == (72, 18, 4)
    assert sizes(twelve_points(walking)) == (72, 36, 4)


@pytest.mark.parametrize("pose", [reaching, four_levels, twelve_points])
def test_what_is_asked_within_reach_is_met(pose, walking: Walk) -> None:
    problem = pose(walking)
    solution = host().solver("prioritized_ik")().solve(problem)
    places = forward(problem.cast.parents, solution.translations, solution.rotations)
    assert residuals(problem.table, *places).max() < 1e-5
    before = residuals(problem.table, problem.cast.positions, problem.cast.orientations)
    assert before.max() > 0.05


def test_joints_without_limits_are_free_and_weigh_the_same(walking: Walk) -> None:
    free = unlimited(walking).body
    assert np.isinf(free.limits_min).all() and np.isinf(free.limits_max).all()
    assert np.isfinite(walking.body.limits_min).any()
    assert np.array_equal(free.masses, walking.body.masses)


def test_a_stick_changes_nothing_but_the_number_of_joints(walking: Walk) -> None:
    with_stick, without = four_levels(walking).cast, reaching(walking).cast
    assert np.array_equal(with_stick.positions[:, :-1], without.positions)
    assert with_stick.masses.sum() == without.masses.sum()

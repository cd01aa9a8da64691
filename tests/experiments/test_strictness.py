"""2004, section 3: what ranks lower does not disturb what ranks higher."""

from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest

from usdmotion.cast import Character
from usdmotion.constraints import Constraint, Goal, OrientationConstraint, PositionConstraint
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, write_walk
from usdmotion.kernels import from_vector
from usdmotion.measuring import measure
from usdmotion.motion import Body, Motion, Placement
from usdmotion.plugins import host
from usdmotion.scene import Edit, Scene
from usdmotion.solving import Problem

LEVELS = 5
FEASIBLE = 1e-7
REACHES = (0.1, 0.3, 0.6)
"""How far from the input a level asks for something [m], in turn: less and less can be met."""
WALK = walk()
FREE = replace(WALK, body=Body.unknown(len(WALK.skeleton.joints)))
"""Without the limits of knees and elbows, which leave more than one place that is nearest."""


def part_of_walk(seed: int, walking: Walk = FREE) -> Walk:
    """Return three frames of a walk, from somewhere in it."""
    start = np.random.default_rng(seed).integers(0, 140)
    motion, frames = walking.motion, slice(start, start + 3)
    times = motion.times[frames] - motion.times[start]
    part = Motion(times, motion.translations[frames], motion.rotations[frames])
    return replace(walking, motion=part)


def stack(seed: int, reach: float) -> list[Constraint]:
    """Return a constraint a level, on random joints, as far from the input as `reach` [m] says."""
    random = np.random.default_rng(seed)
    constraints: list[Constraint] = []
    for level in range(1, LEVELS + 1):
        shared = {
            "path": f"Level{level}",
            "skeleton": SKELETON,
            "joint": WALK.skeleton.joints[random.integers(2, len(WALK.skeleton.joints))],
            "priority": level,
        }
        move, turn, point = random.normal(size=(3, 3))
        if random.random() < 0.75:
            goal = Goal(mode="offset", translation=move * reach)
            constraints.append(PositionConstraint(**shared, point=0.1 * point, goals=(goal,)))
        else:
            goal = Goal(mode="offset", rotation=from_vector(turn * 2.0 * reach))
            constraints.append(OrientationConstraint(**shared, goals=(goal,)))
    return constraints


def left_of(
    walking: Walk, constraints: list[Constraint], solver: str = "prioritized_ik"
) -> np.ndarray:
    """Return what is left of each constraint on each frame, in metres or radians."""
    frames = walking.motion.frame_count
    character = Character(
        SKELETON, walking.skeleton, walking.body, walking.motion, Placement.identity(frames), 0
    )
    edit = Edit(f"{SKELETON}/Edit", SKELETON, tuple(constraints))
    scene = Scene((character,), (edit,), np.arange(frames), np.array([0.0, 1.0, 0.0]))
    problem = Problem.of(scene)
    solution = host().solver(solver)().solve(problem)
    errors = measure(problem, solution, scene.constraints)
    turning = np.array([each.unit == "deg" for each in constraints])
    return np.where(turning, np.radians(errors), errors)


def disturbances(seeds: range, *reaches: float) -> tuple[np.ndarray, np.ndarray]:
    """Return how much levels within reach, and out of reach, change by each lower level added."""
    within, beyond = [np.zeros(1)], [np.zeros(1)]
    for seed, reach in zip(seeds, cycle(reaches), strict=False):
        walking, constraints = part_of_walk(seed), stack(seed, reach)
        before = left_of(walking, constraints[:1])
        for count in range(2, LEVELS + 1):
            after = left_of(walking, constraints[:count])
            change = np.abs(after[:, : count - 1] - before)
            within.append(change[before <= FEASIBLE])
            beyond.append(change[before > FEASIBLE])
            before = after
    return np.concatenate(within), np.concatenate(beyond)


@pytest.mark.slow
def test_a_lower_level_added_to_200_stacks_disturbs_no_higher_one():
    within, beyond = disturbances(range(200), *REACHES)
    assert len(within) > 3000
    assert len(beyond) > 900
    assert within.max() < 1e-6
    assert beyond.max() <= 1e-4


def test_a_lower_level_added_to_a_few_stacks_disturbs_no_higher_one():
    within, beyond = disturbances(range(1000, 1010), 0.3)
    assert within.max() < 1e-6
    assert beyond.max() <= 1e-4


@pytest.mark.slow
def test_with_limits_a_lower_level_makes_no_higher_one_worse():
    worse, apart, count = 0.0, 0, 0
    for seed, reach in zip(range(100), cycle(REACHES), strict=False):
        walking, constraints = part_of_walk(seed, WALK), stack(seed, reach)
        before = left_of(walking, constraints[:1])
        for levels in range(2, LEVELS + 1):
            after = left_of(walking, constraints[:levels])
            change = after[:, : levels - 1] - before
            worse = max(worse, change[before <= FEASIBLE].max(initial=0.0))
            assert change.max() <= 1e-4
            apart += np.count_nonzero(change < -1e-4)
            count += change.size
            before = after
    assert worse < 1e-6
    # A level may come to a nearer place on the way that one below it makes it take.
    assert apart <= 0.001 * count


def worst_by_groups(seeds: range, *reaches: float, walking: Walk = FREE) -> float:
    """Return how much worse the solver by groups makes a level by one that is added below it."""
    worst = 0.0
    for seed, reach in zip(seeds, cycle(reaches), strict=False):
        part, constraints = part_of_walk(seed, walking), stack(seed, reach)
        before = left_of(part, constraints[:1], "ccd")
        for count in range(2, LEVELS + 1):
            after = left_of(part, constraints[:count], "ccd")
            worst = max(worst, (after[:, : count - 1] - before).max())
            before = after
    return worst


@pytest.mark.parametrize("reach", [0.1, 0.6])
def test_by_groups_no_lower_level_costs_a_higher_one_a_tenth_of_a_millimetre(reach):
    assert worst_by_groups(range(4000, 4010), reach) <= 1e-4
    assert worst_by_groups(range(4000, 4004), reach, walking=WALK) <= 1e-4


@pytest.mark.slow
def test_by_groups_neither_over_60_stacks():
    assert worst_by_groups(range(60), *REACHES) <= 1e-4


def test_a_lower_level_that_changes_disturbs_no_higher_one():
    for seed in range(2000, 2010):
        walking, constraints = part_of_walk(seed), stack(seed, 0.2)
        lowest = stack(seed + 1, 0.4)[-1]
        before = left_of(walking, constraints)[:, :-1]
        after = left_of(walking, [*constraints[:-1], lowest])[:, :-1]
        assert np.abs(after - before).max() <= 1e-4
        assert np.abs(after - before)[before <= FEASIBLE].max(initial=0.0) < 1e-6


def test_on_the_stage_it_is_10_micrometres(tmp_path, solve):
    for seed in range(3000, 3004):
        walking, constraints = part_of_walk(seed), stack(seed, 0.1)
        takes = []
        for count in (LEVELS - 1, LEVELS):
            shot = tmp_path / f"stack{seed}_{count}.usda"
            write_walk(shot, walking, "Edit", constraints[:count])
            takes.append(solve(shot, SKELETON))
        few, all_ = takes
        for constraint, report in zip(
            constraints[:-1], few.report.edits[0].constraints, strict=True
        ):
            if report.unit == "m" and report.max <= FEASIBLE:
                where = (constraint.joint, constraint.point)
                assert few.millimetres(all_.after.point(*where) - few.after.point(*where)) <= 0.01

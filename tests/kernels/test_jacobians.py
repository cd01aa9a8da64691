"""The rows of every kind of task say how its error changes when a pose moves."""

import numpy as np
import pytest

from usdmotion.kernels import (
    Shape,
    forward,
    from_vector,
    kernel,
    multiply,
    number_columns,
    reference,
    residuals,
    rotate,
    task_error,
    task_rows,
)
from usdmotion.tasks import (
    AimTask,
    Axes,
    Demand,
    DistanceTask,
    PointTask,
    RotationTask,
    Term,
    TurnGoal,
    tabulate,
)
from usdmotion.testing import humanoid_scene

CAST = humanoid_scene(frame_count=1).cast
NODES = CAST.node_count
HAND = next(node for node, (_, token) in enumerate(CAST.joints) if token.endswith("left_wrist"))
FOOT = next(node for node, (_, token) in enumerate(CAST.joints) if token.endswith("right_ankle"))
ONE = np.ones(1)
TURN = np.array([0.1, 0.5, -0.3, 0.8]) / np.sqrt(0.99)
AT = np.array([0.05, -0.02, 0.03])
ENDS = (Term(HAND, AT), Term(FOOT, -AT, -0.7))
THERE = np.array([[0.3, 1.1, 0.6]])

TASKS = {
    "a point": PointTask((Term(HAND, AT),), THERE),
    "a difference of points": PointTask(ENDS, THERE),
    "a point along axes": PointTask((Term(HAND, AT),), THERE, Axes((True, False, True), -1, TURN)),
    "a point along axes of a joint": PointTask(ENDS, THERE, Axes((True, True, False), FOOT, TURN)),
    "an orientation": RotationTask(HAND, (), TURN[None], np.zeros(1), TURN),
    "an orientation but for an axis": RotationTask(
        HAND, (), TURN[None], np.zeros(1), free_axis=np.array([0.0, 0.6, 0.8])
    ),
    "an orientation in a joint": RotationTask(HAND, (TurnGoal(TURN, ONE, FOOT),), TURN[None], ONE),
    "a distance": DistanceTask(ENDS, THERE, 0.4),
    "a distance from a box": DistanceTask(
        ENDS, THERE, 0.4, shape=Shape.BOX, extent=np.array([0.1, 0.05, 0.2]), rotation=TURN
    ),
    "a distance from a cylinder": DistanceTask(
        ENDS, THERE, 0.4, shape=Shape.CYLINDER, extent=np.array([0.1, 0.1, 0.2]), rotation=TURN
    ),
    "a distance from a half-space": DistanceTask(
        ENDS, THERE, 0.4, shape=Shape.HALF_SPACE, rotation=TURN
    ),
    "an aim": AimTask(ENDS, THERE, np.array([0.6, 0.0, 0.8])),
}


@kernel
def numbered(recruited, translates, columns):
    return number_columns(recruited, translates, columns)


@kernel
def linear(table, parents, translates, columns, width, positions, orientations, rows, errors):
    tasks = reference(table)
    block = np.zeros_like(rows)
    error = task_error(tasks, 0, 0, positions, orientations)
    count = task_rows(
        tasks, 0, 0, parents, translates, columns, width, positions, orientations, error,
        rows, errors, block,
    )  # fmt: skip
    return count


def table_of(task):
    demand = Demand(
        tasks=(task,),
        priority=1,
        weight=ONE,
        activity=ONE,
        recruits=np.ones(NODES, dtype=np.bool_),
        moves=frozenset(),
        plateau=np.ones(1, dtype=np.bool_),
    )
    return tabulate([demand], 1, NODES)


def rows_of(table, translations, rotations):
    """Return rows, errors and the column of each node."""
    columns = np.zeros(NODES, dtype=np.int64)
    translates = np.array(CAST.translates)
    width = numbered(np.ones(NODES, dtype=np.bool_), translates, columns)
    positions, orientations = (each[0] for each in forward(CAST.parents, translations, rotations))
    rows, errors = np.zeros((3, width)), np.zeros(3)
    count = linear(
        table,
        np.array(CAST.parents),
        translates,
        columns,
        width,
        positions,
        orientations,
        rows,
        errors,
    )
    return rows[:count], errors[:count], columns


def moved(translations, rotations, node, axis, step):
    """Return a pose with a node turned about a world axis by so much."""
    _, orientations = forward(CAST.parents, translations, rotations)
    parent = CAST.parents[node]
    above = orientations[0, parent] if parent >= 0 else np.array([0.0, 0.0, 0.0, 1.0])
    inside = rotate(above * (-1, -1, -1, 1), step * np.eye(3)[axis])
    turned = np.array(rotations)
    turned[0, node] = multiply(from_vector(inside), rotations[0, node])
    return translations, turned


@pytest.mark.parametrize("name", TASKS)
def test_the_step_of_least_length_meets_a_task_to_second_order(name):
    """Newton's method squares what is left; rows that are off by anything leave a share of it."""
    table = table_of(TASKS[name])
    translations, rotations = np.array(CAST.translations), np.array(CAST.rotations)
    left = []
    for _ in range(12):
        positions, orientations = forward(CAST.parents, translations, rotations)
        left.append(residuals(table, positions, orientations)[0, 0])
        rows, errors, columns = rows_of(table, translations, rotations)
        assert np.linalg.norm(errors) == pytest.approx(left[-1], abs=1e-12)
        step = np.linalg.pinv(rows) @ errors
        step *= min(1.0, 0.2 / max(np.abs(step).max(), 1e-12))
        for node in reversed(range(NODES)):
            for axis in range(3):
                turn = step[columns[node] + axis]
                translations, rotations = moved(translations, rotations, node, axis, turn)
            if CAST.translates[node]:
                parent = orientations[0, CAST.parents[node]]
                way = rotate(parent * (-1, -1, -1, 1), step[columns[node] + 3 : columns[node] + 6])
                translations = np.array(translations)
                translations[0, node] += way
    assert left[0] > 1e-2
    assert left[-1] < 1e-10


@pytest.mark.parametrize("name", TASKS)
def test_rows_are_the_derivative_of_the_error(name):
    table = table_of(TASKS[name])
    translations, rotations = np.array(CAST.translations), np.array(CAST.rotations)
    rows, errors, columns = rows_of(table, translations, rotations)
    size = np.linalg.norm(errors)
    for node in (1, CAST.parents[HAND], HAND, CAST.parents[FOOT]):
        for axis in range(3):
            sizes = []
            for step in (1e-5, -1e-5):
                pose = moved(translations, rotations, node, axis, step)
                sizes.append(np.linalg.norm(rows_of(table, *pose)[1]))
            slope = (sizes[0] - sizes[1]) / 2e-5
            predicted = -errors @ rows[:, columns[node] + axis] / size
            assert slope == pytest.approx(predicted, abs=1e-7), (node, axis)

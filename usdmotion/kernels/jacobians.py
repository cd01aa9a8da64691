"""Rows of the tasks' Jacobians over the degrees of freedom that a problem recruits.

A ball joint is driven by a world-frame rotation vector, so the block of a point p under a joint at
o is −[p − o]×; the root also by a world translation, whose block is the identity.
"""

import math
from typing import Any

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels.compiling import shared
from usdmotion.kernels.parts import Reference
from usdmotion.kernels.quaternions import cross, quaternion_at, turned, vector_at, vector_in
from usdmotion.kernels.residuals import (
    AIM,
    DISTANCE,
    ROTATION,
    held_axis,
    seen_from_target,
    world_gap,
)
from usdmotion.kernels.table import TaskTable

NEAREST = 1e-3
"""Nearer than this an aim's line of sight turns no faster [m]."""


@shared
def number_columns(recruited: Bools, translates: Bools, columns: Ints) -> int:
    """(N,), (N,) into (N,): first column of each recruited node, −1 for the others; their count."""
    count = 0
    for node in range(recruited.shape[0]):
        columns[node] = -1
        if recruited[node]:
            columns[node] = count
            count += 6 if translates[node] else 3
    return count


@shared
def task_rows(
    tasks: Reference[TaskTable],
    frame: int,
    task: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    width: int,
    positions: Floats,
    orientations: Floats,
    error: Any,
    rows: Floats,
    errors: Floats,
    block: Floats,
) -> int:
    """Write the rows of one task and their errors, unweighted; return how many they are.

    Args:
        tasks: All of them.
        frame: Frame of the per-frame targets.
        task: Which one.
        parents: (N,).
        translates: (N,) nodes that also translate.
        columns: (N,) first column of each node, -1 where it is not recruited.
        width: How many columns are used.
        positions: (N, 3) of the pose.
        orientations: (N, 4) of the pose.
        error: What is to be made up for, as `task_error` gives it.
        rows: (3, C), to be written.
        errors: (3,), to be written.
        block: Scratch, (3, C).
    """
    table = tasks[0]
    whole = table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]
    free = vector_at(table.free_axis, task)
    turning = free[0] != 0.0 or free[1] != 0.0 or free[2] != 0.0
    direct = whole and not turning and table.kind[task] != DISTANCE
    _fill(
        tasks, frame, task, parents, translates, columns, width, positions, orientations,
        rows if direct else block,
    )  # fmt: skip
    if direct:
        errors[0], errors[1], errors[2] = error
        return 3
    if table.kind[task] == DISTANCE:
        away = world_gap(tasks, frame, task, positions, orientations)
        _project((away[0], away[1], away[2]), error, block, rows[0], width)
        errors[0] = error[0]
        return 1
    if turning:
        node = table.term_node[table.first_term[task]]
        held = turned(quaternion_at(orientations, node), free)
        return _two_rows(held, error, block, rows, width, errors)
    return _held_rows(
        tasks, frame, task, parents, columns, width, orientations, error, block, rows, errors,
    )  # fmt: skip


@shared
def _fill(
    tasks: Reference[TaskTable],
    frame: int,
    task: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    width: int,
    positions: Floats,
    orientations: Floats,
    rows: Floats,
) -> None:
    """Write how the sum of the terms moves, or how a node turns in the frame of what it faces."""
    table = tasks[0]
    for row in range(3):
        for column in range(width):
            rows[row, column] = 0.0
    if table.kind[task] == ROTATION:
        _turn_block(tasks, frame, task, parents, columns, rows)
        return
    for term in range(table.first_term[task], table.first_term[task + 1]):
        _add_point(
            tasks, frame, task, term, parents, translates, columns, positions, orientations, rows,
        )  # fmt: skip
    if table.kind[task] == AIM:
        seen = seen_from_target(tasks, frame, task, positions, orientations)
        _sight_block(tasks, task, parents, columns, width, seen, rows)


@shared
def _add_point(
    tasks: Reference[TaskTable],
    frame: int,
    task: int,
    term: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    positions: Floats,
    orientations: Floats,
    rows: Floats,
) -> None:
    """Add the Jacobian of one term's point to three rows."""
    table = tasks[0]
    node = table.term_node[term]
    factor = table.term_coefficient[frame, term]
    point = turned(quaternion_at(orientations, node), vector_in(table.term_point, frame, term))
    x = positions[node, 0] + point[0]
    y = positions[node, 1] + point[1]
    z = positions[node, 2] + point[2]
    while node >= 0:
        column = columns[node]
        if column >= 0 and table.recruits[task, node]:
            rx = factor * (x - positions[node, 0])
            ry = factor * (y - positions[node, 1])
            rz = factor * (z - positions[node, 2])
            rows[0, column + 1] += rz
            rows[0, column + 2] -= ry
            rows[1, column + 2] += rx
            rows[1, column] -= rz
            rows[2, column] += ry
            rows[2, column + 1] -= rx
            if translates[node]:
                for axis in range(3):
                    rows[axis, column + 3 + axis] += factor
        node = parents[node]


@shared
def _add_turn(
    tasks: Reference[TaskTable],
    task: int,
    parents: Ints,
    columns: Ints,
    node: int,
    factor: float,
    rows: Floats,
) -> None:
    table = tasks[0]
    while node >= 0:
        column = columns[node]
        if column >= 0 and table.recruits[task, node]:
            for axis in range(3):
                rows[axis, column + axis] += factor
        node = parents[node]


@shared
def _turn_block(
    tasks: Reference[TaskTable],
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    rows: Floats,
) -> None:
    """The node's turning minus that of the frames its goals are in."""
    table = tasks[0]
    node = table.term_node[table.first_term[task]]
    _add_turn(tasks, task, parents, columns, node, 1.0, rows)
    total = 0.0
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        total += table.goal_weight[frame, goal]
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        node = table.goal_node[goal]
        if node >= 0 and total > 0.0:
            share = table.blend[frame, task] * table.goal_weight[frame, goal] / total
            _add_turn(tasks, task, parents, columns, node, -share, rows)


@shared
def _sight_block(
    tasks: Reference[TaskTable],
    task: int,
    parents: Ints,
    columns: Ints,
    width: int,
    seen: Any,
    rows: Floats,
) -> None:
    """The first node's turning minus that of the line of sight, from the rows of its ends.

    Of u = v/‖v‖ the angular velocity is u × v̇ / ‖v‖, whichever way it points.
    """
    x, y, z = seen
    square = max(x * x + y * y + z * z, NEAREST * NEAREST)
    for column in range(width):
        a, b, c = rows[0, column], rows[1, column], rows[2, column]
        rows[0, column] = (z * b - y * c) / square
        rows[1, column] = (x * c - z * a) / square
        rows[2, column] = (y * a - x * b) / square
    table = tasks[0]
    _add_turn(tasks, task, parents, columns, table.term_node[table.first_term[task]], 1.0, rows)


@shared
def _two_rows(
    axis: Any, error: Any, block: Floats, rows: Floats, width: int, errors: Floats
) -> int:
    """Keep the two directions of a turn that move an axis; turning about it is free."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.6 else (0.0, 1.0, 0.0)
    first = _unit(cross(axis, other))
    second = _unit(cross(axis, first))
    errors[0] = _project(first, error, block, rows[0], width)
    errors[1] = _project(second, error, block, rows[1], width)
    return 2


@shared
def _held_rows(
    tasks: Reference[TaskTable],
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    width: int,
    orientations: Floats,
    error: Any,
    block: Floats,
    rows: Floats,
    errors: Floats,
) -> int:
    """Keep the held axes; where they turn with a node, so does what is measured along them."""
    table = tasks[0]
    count = 0
    for axis in range(3):
        if not table.axes[task, axis]:
            continue
        direction = held_axis(tasks, frame, task, axis, orientations)
        errors[count] = _project(direction, error, block, rows[count], width)
        lever = cross(direction, error)
        node = table.axes_node[task]
        while node >= 0:
            column = columns[node]
            if column >= 0 and table.recruits[task, node]:
                for part in range(3):
                    rows[count, column + part] -= lever[part]
            node = parents[node]
        count += 1
    return count


@shared
def _project(direction: Any, error: Any, block: Floats, row: Floats, width: int) -> float:
    """Write one row along a direction; return the error along it."""
    x, y, z = direction
    for column in range(width):
        row[column] = x * block[0, column] + y * block[1, column] + z * block[2, column]
    return float(x * error[0] + y * error[1] + z * error[2])


@shared
def _unit(v: Any) -> Any:
    scale = 1.0 / math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return (v[0] * scale, v[1] * scale, v[2] * scale)

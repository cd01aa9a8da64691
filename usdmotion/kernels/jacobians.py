"""Rows of the tasks' Jacobians over the degrees of freedom that a problem recruits.

A ball joint is driven by a world-frame rotation vector, so the block of a point p under a joint at
o is −[p − o]×; the root also by a world translation, whose block is the identity.
"""

from typing import Any

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels.compiling import inlined
from usdmotion.kernels.quaternions import cross, turned
from usdmotion.kernels.residuals import ROTATION, held_axis
from usdmotion.kernels.table import TaskTable


@inlined
def number_columns(recruited: Bools, translates: Bools, columns: Ints) -> int:
    """(N,), (N,) into (N,): first column of each recruited node, −1 for the others; their count."""
    count = 0
    for node in range(recruited.shape[0]):
        columns[node] = -1
        if recruited[node]:
            columns[node] = count
            count += 6 if translates[node] else 3
    return count


@inlined
def task_rows(
    table: TaskTable,
    frame: int,
    task: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    positions: Floats,
    orientations: Floats,
    error: Any,
    rows: Floats,
    errors: Floats,
    block: Floats,
) -> int:
    """Write the rows of one task and their errors, unweighted; return how many they are.

    Args:
        table: All tasks.
        frame: Frame of the per-frame targets.
        task: Which one.
        parents: (N,).
        translates: (N,) nodes that also translate.
        columns: (N,) first column of each node, -1 where it is not recruited.
        positions: (N, 3) of the pose.
        orientations: (N, 4) of the pose.
        error: What is to be made up for, as `task_error` gives it.
        rows: At least (3, column count), to be written.
        errors: At least (3,), to be written.
        block: Scratch, at least (3, column count).
    """
    whole = table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]
    free = table.free_axis[task]
    turning = free[0] != 0.0 or free[1] != 0.0 or free[2] != 0.0
    target = rows if whole and not turning else block
    for row in range(3):
        for column in range(target.shape[1]):
            target[row, column] = 0.0
    recruits = table.recruits[task]
    if table.kind[task] == ROTATION:
        _turn_block(table, frame, task, parents, columns, recruits, target)
    else:
        for term in range(table.first_term[task], table.first_term[task + 1]):
            node = table.term_node[term]
            point = turned(orientations[node], table.term_point[frame, term])
            _add_point(
                parents, translates, columns, recruits, positions, node,
                table.term_coefficient[frame, term], point, target,
            )  # fmt: skip
    if turning:
        return _two_rows(
            turned(orientations[table.term_node[table.first_term[task]]], free),
            error, block, rows, errors,
        )  # fmt: skip
    if whole:
        for axis in range(3):
            errors[axis] = error[axis]
        return 3
    return _held_rows(
        table, frame, task, parents, columns, orientations, error, block, rows, errors
    )


@inlined
def _add_point(
    parents: Ints,
    translates: Bools,
    columns: Ints,
    recruits: Bools,
    positions: Floats,
    node: int,
    factor: float,
    point: Any,
    rows: Floats,
) -> None:
    """Add factor times the Jacobian of a point (given from its node's origin) to three rows."""
    x = positions[node, 0] + point[0]
    y = positions[node, 1] + point[1]
    z = positions[node, 2] + point[2]
    while node >= 0:
        column = columns[node]
        if column >= 0 and recruits[node]:
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


@inlined
def _add_turn(
    parents: Ints, columns: Ints, recruits: Bools, node: int, factor: float, rows: Floats
) -> None:
    while node >= 0:
        column = columns[node]
        if column >= 0 and recruits[node]:
            for axis in range(3):
                rows[axis, column + axis] += factor
        node = parents[node]


@inlined
def _turn_block(
    table: TaskTable,
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    recruits: Bools,
    rows: Floats,
) -> None:
    """The node's turning minus that of the frames its goals are in."""
    _add_turn(parents, columns, recruits, table.term_node[table.first_term[task]], 1.0, rows)
    total = 0.0
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        total += table.goal_weight[frame, goal]
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        if table.goal_node[goal] >= 0 and total > 0.0:
            share = table.blend[frame, task] * table.goal_weight[frame, goal] / total
            _add_turn(parents, columns, recruits, table.goal_node[goal], -share, rows)


@inlined
def _two_rows(axis: Any, error: Any, block: Floats, rows: Floats, errors: Floats) -> int:
    """Keep the two directions of a turn that move an axis; turning about it is free."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.6 else (0.0, 1.0, 0.0)
    first = _unit(cross(axis, other))
    second = _unit(cross(axis, first))
    _project(first, error, block, rows, errors, 0)
    _project(second, error, block, rows, errors, 1)
    return 2


@inlined
def _held_rows(
    table: TaskTable,
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    orientations: Floats,
    error: Any,
    block: Floats,
    rows: Floats,
    errors: Floats,
) -> int:
    """Keep the held axes; where they turn with a node, so does what is measured along them."""
    count = 0
    for axis in range(3):
        if not table.axes[task, axis]:
            continue
        direction = held_axis(table, frame, task, axis, orientations)
        _project(direction, error, block, rows, errors, count)
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


@inlined
def _project(
    direction: Any, error: Any, block: Floats, rows: Floats, errors: Floats, row: int
) -> None:
    x, y, z = direction
    for column in range(rows.shape[1]):
        rows[row, column] = x * block[0, column] + y * block[1, column] + z * block[2, column]
    errors[row] = x * error[0] + y * error[1] + z * error[2]


@inlined
def _unit(v: Any) -> Any:
    scale = 1.0 / np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return (v[0] * scale, v[1] * scale, v[2] * scale)

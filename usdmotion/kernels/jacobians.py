"""Rows of the tasks' Jacobians over the degrees of freedom that a problem recruits.

A ball joint is driven by a world-frame rotation vector, so the block of a point p under a joint at
o is −[p − o]×; the root also by a world translation, whose block is the identity.
"""

import math
from typing import Any

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels.compiling import inlined
from usdmotion.kernels.quaternions import cross, quaternion_at, turned, vector_at, vector_in
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
    column_count: int,
    positions: Floats,
    orientations: Floats,
    error: Any,
    rows: Floats,
    row: int,
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
        column_count: How many columns are used.
        positions: (N, 3) of the pose.
        orientations: (N, 4) of the pose.
        error: What is to be made up for, as `task_error` gives it.
        rows: (R, C), written from `row` on.
        row: Where its rows begin.
        errors: At least (3,), to be written.
        block: Scratch, (3, C).
    """
    whole = table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]
    free = vector_at(table.free_axis, task)
    turning = free[0] != 0.0 or free[1] != 0.0 or free[2] != 0.0
    direct = whole and not turning
    target, first = (rows, row) if direct else (block, 0)
    for index in range(3):
        for column in range(column_count):
            target[first + index, column] = 0.0
    if table.kind[task] == ROTATION:
        _turn_block(table, frame, task, parents, columns, target, first)
    else:
        for term in range(table.first_term[task], table.first_term[task + 1]):
            _add_point(
                table, frame, task, term, parents, translates, columns,
                positions, orientations, target, first,
            )  # fmt: skip
    if direct:
        for axis in range(3):
            errors[axis] = error[axis]
        return 3
    if turning:
        node = table.term_node[table.first_term[task]]
        axis = turned(quaternion_at(orientations, node), free)
        return _two_rows(axis, error, block, rows, row, column_count, errors)
    return _held_rows(
        table, frame, task, parents, columns, column_count, orientations,
        error, block, rows, row, errors,
    )  # fmt: skip


@inlined
def _add_point(
    table: TaskTable,
    frame: int,
    task: int,
    term: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    positions: Floats,
    orientations: Floats,
    rows: Floats,
    row: int,
) -> None:
    """Add the Jacobian of one term's point to three rows."""
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
            rows[row, column + 1] += rz
            rows[row, column + 2] -= ry
            rows[row + 1, column + 2] += rx
            rows[row + 1, column] -= rz
            rows[row + 2, column] += ry
            rows[row + 2, column + 1] -= rx
            if translates[node]:
                for axis in range(3):
                    rows[row + axis, column + 3 + axis] += factor
        node = parents[node]


@inlined
def _add_turn(
    table: TaskTable,
    task: int,
    parents: Ints,
    columns: Ints,
    node: int,
    factor: float,
    rows: Floats,
    row: int,
) -> None:
    while node >= 0:
        column = columns[node]
        if column >= 0 and table.recruits[task, node]:
            for axis in range(3):
                rows[row + axis, column + axis] += factor
        node = parents[node]


@inlined
def _turn_block(
    table: TaskTable,
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    rows: Floats,
    row: int,
) -> None:
    """The node's turning minus that of the frames its goals are in."""
    node = table.term_node[table.first_term[task]]
    _add_turn(table, task, parents, columns, node, 1.0, rows, row)
    total = 0.0
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        total += table.goal_weight[frame, goal]
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        node = table.goal_node[goal]
        if node >= 0 and total > 0.0:
            share = table.blend[frame, task] * table.goal_weight[frame, goal] / total
            _add_turn(table, task, parents, columns, node, -share, rows, row)


@inlined
def _two_rows(
    axis: Any, error: Any, block: Floats, rows: Floats, row: int, count: int, errors: Floats
) -> int:
    """Keep the two directions of a turn that move an axis; turning about it is free."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.6 else (0.0, 1.0, 0.0)
    first = _unit(cross(axis, other))
    second = _unit(cross(axis, first))
    errors[0] = _project(first, error, block, rows, row, count)
    errors[1] = _project(second, error, block, rows, row + 1, count)
    return 2


@inlined
def _held_rows(
    table: TaskTable,
    frame: int,
    task: int,
    parents: Ints,
    columns: Ints,
    column_count: int,
    orientations: Floats,
    error: Any,
    block: Floats,
    rows: Floats,
    row: int,
    errors: Floats,
) -> int:
    """Keep the held axes; where they turn with a node, so does what is measured along them."""
    count = 0
    for axis in range(3):
        if not table.axes[task, axis]:
            continue
        direction = held_axis(table, frame, task, axis, orientations)
        errors[count] = _project(direction, error, block, rows, row + count, column_count)
        lever = cross(direction, error)
        node = table.axes_node[task]
        while node >= 0:
            column = columns[node]
            if column >= 0 and table.recruits[task, node]:
                for part in range(3):
                    rows[row + count, column + part] -= lever[part]
            node = parents[node]
        count += 1
    return count


@inlined
def _project(
    direction: Any, error: Any, block: Floats, rows: Floats, row: int, count: int
) -> float:
    """Write one row along a direction; return the error along it."""
    x, y, z = direction
    for column in range(count):
        rows[row, column] = x * block[0, column] + y * block[1, column] + z * block[2, column]
    return float(x * error[0] + y * error[1] + z * error[2])


@inlined
def _unit(v: Any) -> Any:
    scale = 1.0 / math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return (v[0] * scale, v[1] * scale, v[2] * scale)

"""The loop of convergence: linearize every level, descend the stack, move the pose."""

import math

from usdmotion.kernels import Kind, inlined, shared, task_error, task_rows
from usdmotion_prioritized_ik.posture import move, preserve
from usdmotion_prioritized_ik.stack import descend, remove_spanned
from usdmotion_prioritized_ik.state import Work

ROTATION = int(Kind.ROTATION)
EXACT = 1e-9
"""An error below this is none [m or rad]."""
TURN_LENGTH = 0.2
"""A radian of a rotation task counts as so many metres, about the lever of a hand or a foot."""


@shared
def converge(
    work: Work, frame: int, levels: int, columns: int, most: int, posture: bool, share: float
) -> int:
    """Iterate on the first levels; return how often.

    With the posture, until neither errors nor posture vary (2003, section 4.1). Without it, until
    the errors are gone, or do not vary in the last digit.

    Args:
        work: The pose moves.
        frame: The frame that is being solved.
        levels: How many levels take part.
        columns: How many columns are used.
        most: Limit of iterations; with 0 the errors are only measured.
        posture: Whether what the levels leave free returns to the input's joint angles.
        share: Largest share of each step that is made.
    """
    settings = work.settings
    for task in range(work.asked.errors.shape[0]):
        work.asked.errors[task] = math.inf
    for spent in range(most + 1):
        change = linearize(work, frame, levels, columns)
        done = not posture and (change < EXACT or worst(work, levels) < EXACT)
        if done or spent == most:
            return spent
        moved = step(work, frame, levels, columns, posture, share)
        if posture and change < settings.error_change and moved < settings.posture_change:
            return spent + 1
    return most


@inlined
def worst(work: Work, levels: int) -> float:
    """Return the largest error of the first levels."""
    largest = 0.0
    for task in range(work.table.kind.shape[0]):
        if work.table.level[task] < levels and work.asked.on[task]:
            largest = max(largest, work.asked.errors[task])
    return largest


@inlined
def linearize(work: Work, frame: int, levels: int, columns: int) -> float:
    """Fill the stack with the rows of the first levels; return the largest change of an error."""
    table, asked, stack = work.table, work.asked, work.stack
    change = 0.0
    row, level = 0, 0
    stack.first_row[0] = 0
    for task in range(table.kind.shape[0]):
        if table.level[task] >= levels:
            break
        while level < table.level[task]:
            level += 1
            stack.first_row[level] = row
        if asked.on[task]:
            before = asked.errors[task]
            row += _linearize_task(work, frame, task, row, columns)
            change = max(change, abs(asked.errors[task] - before))
    while level < levels:
        level += 1
        stack.first_row[level] = row
    return change


@inlined
def _linearize_task(work: Work, frame: int, task: int, row: int, columns: int) -> int:
    """Write the weighted rows and errors of one task; a far goal is approached in steps."""
    table, pose, asked, stack = work.table, work.pose, work.asked, work.stack
    error = task_error(table, frame, task, pose.positions, pose.orientations)
    error = (
        error[0] - asked.kept[task, 0],
        error[1] - asked.kept[task, 1],
        error[2] - asked.kept[task, 2],
    )
    count = task_rows(
        table, frame, task, work.given.parents, work.given.translates, pose.columns, columns,
        pose.positions, pose.orientations, error, stack.rows, row, asked.row_errors, asked.block,
    )  # fmt: skip
    square = 0.0
    for index in range(count):
        square += asked.row_errors[index] ** 2
    length = math.sqrt(square)
    asked.errors[task] = length
    scale = math.sqrt(table.weight[frame, task])
    if table.kind[task] == ROTATION:
        scale *= TURN_LENGTH
    near = min(1.0, work.settings.reach_limit / max(length, 1e-12))
    for index in range(count):
        stack.errors[row + index] = scale * near * asked.row_errors[index]
        if scale != 1.0:
            for column in range(columns):
                stack.rows[row + index, column] *= scale
    return count


@inlined
def step(work: Work, frame: int, levels: int, columns: int, posture: bool, most: float) -> float:
    """Move the pose by the step of the first levels; return the largest turn asked for [rad].

    Args:
        work: Its stack is linearized, and consumed.
        frame: The frame that is being solved.
        levels: How many levels take part.
        columns: How many columns are used.
        posture: Whether what they leave free returns to the input's joint angles.
        most: Largest share of the step that is made.
    """
    settings, stack = work.settings, work.stack
    used = descend(stack, levels, columns, settings.damping, settings.curvature, settings.rank)
    if posture:
        preserve(work, frame)
        remove_spanned(stack, used, work.pose.preserving, columns)
        for column in range(columns):
            stack.step[column] += work.pose.preserving[column]
    square = 0.0
    for node in range(work.given.parents.shape[0]):
        column = work.pose.columns[node]
        if column >= 0:
            x, y, z = stack.step[column], stack.step[column + 1], stack.step[column + 2]
            square = max(square, x * x + y * y + z * z)
    largest = math.sqrt(square)
    move(work, min(most, settings.turn_limit / max(largest, 1e-12)))
    return largest

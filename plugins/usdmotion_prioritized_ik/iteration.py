"""The loop of convergence: linearize every level, descend the stack, move the pose."""

import math

from usdmotion.kernels import Kind, shared, task_error, task_rows
from usdmotion_prioritized_ik.posture import move, preserve
from usdmotion_prioritized_ik.stack import descend, remove_spanned
from usdmotion_prioritized_ik.state import Work

ROTATION = int(Kind.ROTATION)
EXACT = 1e-9
"""An error below this is none [m or rad]."""
TURN_LENGTH = 0.2
"""A radian of a rotation task counts as so many metres, about the lever of a hand or a foot."""


def converge(work: Work, frame: int, levels: int, most: int, posture: bool, share: float) -> int:
    """Iterate on the first levels; return how often.

    With the posture, until neither errors nor posture vary (2003, section 4.1). Without it, until
    the errors are gone, or do not vary in the last digit.

    Args:
        work: The pose moves.
        frame: The frame that is being solved.
        levels: How many levels take part.
        most: Limit of iterations; with 0 the errors are only measured.
        posture: Whether what the levels leave free returns to the input's joint angles.
        share: Largest share of each step that is made.
    """
    settings, errors = work.settings[0], work.asked[0].errors
    for task in range(errors.shape[0]):
        errors[task] = math.inf
    for spent in range(most + 1):
        change = linearize(work, frame, levels)
        done = not posture and (change < EXACT or worst(work, levels) < EXACT)
        if done or spent == most:
            return spent
        moved = step(work, frame, levels, posture, share)
        if posture and change < settings.error_change and moved < settings.posture_change:
            return spent + 1
    return most


@shared
def worst(work: Work, levels: int) -> float:
    """Return the largest error of the first levels."""
    asked = work.asked[0]
    largest = 0.0
    for task in range(work.given[0].first_task[levels]):
        if asked.on[task]:
            largest = max(largest, asked.errors[task])
    return largest


@shared
def linearize(work: Work, frame: int, levels: int) -> float:
    """Fill the stack with the rows of the first levels; return the largest change of an error."""
    given, asked, stack = work.given[0], work.asked[0], work.stack[0]
    change = 0.0
    for level in range(levels):
        row = stack.first_row[level]
        for task in range(given.first_task[level], given.first_task[level + 1]):
            if asked.on[task]:
                before = asked.errors[task]
                row += _linearize_task(work, frame, task, row)
                change = max(change, abs(asked.errors[task] - before))
        stack.first_row[level + 1] = row
    return change


@shared
def _linearize_task(work: Work, frame: int, task: int, row: int) -> int:
    """Write the weighted rows and errors of one task; a far goal is approached in steps."""
    given, table, pose = work.given[0], work.table[0], work.pose[0]
    asked, stack = work.asked[0], work.stack[0]
    width = stack.widths[table.level[task]]
    error = task_error(work.table, frame, task, pose.positions, pose.orientations)
    kept = asked.kept[task]
    error = (error[0] - kept[0], error[1] - kept[1], error[2] - kept[2])
    count = task_rows(
        work.table, frame, task, given.parents, given.translates, pose.columns, width,
        pose.positions, pose.orientations, error,
        stack.rows[row : row + 3], asked.row_errors, asked.block,
    )  # fmt: skip
    square = 0.0
    for index in range(count):
        square += asked.row_errors[index] ** 2
    length = math.sqrt(square)
    asked.errors[task] = length
    scale = math.sqrt(table.weight[frame, task])
    if table.kind[task] == ROTATION:
        scale *= TURN_LENGTH
    near = min(1.0, work.settings[0].reach_limit / max(length, 1e-12))
    for index in range(count):
        stack.errors[row + index] = scale * near * asked.row_errors[index]
        if scale != 1.0:
            for column in range(width):
                stack.rows[row + index, column] *= scale
    return count


@shared
def step(work: Work, frame: int, levels: int, posture: bool, most: float) -> float:
    """Move the pose by the step of the first levels; return the largest turn asked for [rad].

    Args:
        work: Its stack is linearized, and consumed.
        frame: The frame that is being solved.
        levels: How many levels take part.
        posture: Whether what they leave free returns to the input's joint angles.
        most: Largest share of the step that is made.
    """
    settings, stack, pose = work.settings[0], work.stack[0], work.pose[0]
    descend(work.stack, levels, settings.damping, settings.curvature, settings.rank)
    if posture:
        preserve(work, frame)
        remove_spanned(work.stack, levels, pose.preserving)
        for column in range(stack.widths[levels - 1]):
            stack.step[column] += pose.preserving[column]
    square = 0.0
    for node in range(pose.columns.shape[0]):
        column = pose.columns[node]
        if column >= 0:
            x, y, z = stack.step[column], stack.step[column + 1], stack.step[column + 2]
            square = max(square, x * x + y * y + z * z)
    largest = math.sqrt(square)
    move(work, min(most, settings.turn_limit / max(largest, 1e-12)))
    return largest

"""The loop of convergence: linearize every level, descend the stack, move the pose."""

import math

from usdmotion import Floats
from usdmotion.kernels import Kind, shared, summing, task_error, task_rows
from usdmotion_prioritized_ik.bounds import add_bound, open_bounds, room
from usdmotion_prioritized_ik.continuity import bound_changes
from usdmotion_prioritized_ik.limits import bound_turns
from usdmotion_prioritized_ik.posture import largest_turn, move, preserve
from usdmotion_prioritized_ik.rows import add, dot
from usdmotion_prioritized_ik.state import Work

ROTATION = int(Kind.ROTATION)
EXACT = 1e-9
"""An error below this is none [m or rad]."""
NEAR = 0.01
"""Errors below this leave the pull of the posture alone to decide how far to go [m or rad]."""
SHORTEST, LONGEST = 0.1, 4.0
"""How far to go along a step, at least and at most."""
FAR = 2.0
"""No step is as long as this [rad and m]."""
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
    taken = 0.0
    for spent in range(most + 1):
        open_bounds(work.bounds)
        change = linearize(work, frame, levels)
        done = change < EXACT or worst(work, levels) < EXACT
        if posture:
            done = preserve(work, frame) < EXACT and done
        if done or spent == most:
            return spent
        bound_turns(work)
        bound_changes(work, frame)
        work.descend(
            work.stack,
            work.bounds,
            work.holding,
            levels,
            posture,
            settings.damping,
            settings.curvature,
            settings.rank,
        )
        turn, taken = _advance(work, frame, levels, posture, share, taken)
        if posture and change < settings.error_change and turn < settings.posture_change:
            return spent + 1
    return most


@shared
def _advance(
    work: Work, frame: int, levels: int, posture: bool, share: float, taken: float
) -> tuple[float, float]:
    """Move the pose; return the largest turn asked for [rad], and by what share it was made.

    Near a solution only the posture still moves, as far as its steps have shown to be right: along
    bent constraints it can go to and fro without end, or creep.
    """
    stack, length = work.stack[0], 1.0
    width = stack.widths[levels - 1]
    if posture:
        length = _length(stack.step, stack.before, taken, width)
        if taken == 0.0 or worst(work, levels) > NEAR:
            length = 1.0
    turn, longer = largest_turn(work), max(length, 1.0)
    if longer > 1.0:
        longer = 1.0 + room(work.bounds, stack.step, stack.pull, longer - 1.0)
        add(stack.step, stack.pull, longer - 1.0, width)
    made = min(share, length, work.settings[0].turn_limit / max(longer * turn, 1e-12))
    move(work, frame, made)
    return turn, made * longer


@summing
def _length(step: Floats, before: Floats, taken: float, count: int) -> float:
    """(C,), (C,) to how far to go along a step, of which the share `taken` was made before.

    Irons and Tuck 1969: where the step would be none, if it went on to change as it has changed.
    """
    along, square = 0.0, 0.0
    for index in range(count):
        change = before[index] - step[index]
        along += before[index] * change
        square += change * change
        before[index] = step[index]
    if along <= 0.0:
        return LONGEST
    return min(max(taken * along / square, SHORTEST), LONGEST)


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
    """Fill the stack with the rows of the first levels; return the largest change of an error.

    A bound that is kept has no row: it is no error, and the levels below must not cross it.
    """
    given, pose, asked, stack = work.given[0], work.pose[0], work.asked[0], work.stack[0]
    change = 0.0
    for level in range(levels):
        row = stack.first_row[level]
        for task in range(given.first_task[level], given.first_task[level + 1]):
            if not asked.on[task]:
                continue
            error = task_error(work.table, frame, task, pose.positions, pose.orientations)
            kept = asked.kept[task]
            error = (error[0] - kept[0], error[1] - kept[1], error[2] - kept[2])
            rows, errors = stack.rows[row : row + 3], stack.errors[row : row + 3]
            count = task_rows(
                work.table, frame, task, given.parents, given.translates, pose.columns,
                stack.widths[level], pose.positions, pose.orientations, error,
                rows, errors, asked.block,
            )  # fmt: skip
            side = work.table[0].bound[task]
            if side != 0 and side * error[0] < EXACT:
                _bound(work, level, side, error[0], rows[0])
                count = 0
            length = math.sqrt(dot(errors, errors, count))
            change = max(change, abs(length - asked.errors[task]))
            asked.errors[task] = length
            _weigh(work, frame, task, rows[:count], errors)
            row += count
        stack.first_row[level + 1] = row
    return change


@shared
def _bound(work: Work, level: int, side: int, left: float, row: Floats) -> None:
    """Let the levels below one not go beyond a bound that it keeps, if a step can reach it."""
    width = work.stack[0].widths[level]
    length = math.sqrt(dot(row, row, width))
    if abs(left) >= FAR * length:
        return
    low, high = -math.inf, max(left, 0.0) / length
    if side > 0:
        low, high = min(left, 0.0) / length, math.inf
    bound = add_bound(work.bounds, level, 0, width, low, high)
    for column in range(width):
        work.bounds[0].rows[bound, column] = row[column] / length


@shared
def _weigh(work: Work, frame: int, task: int, rows: Floats, errors: Floats) -> None:
    """Scale the rows of a task and their errors; a far goal is approached in steps."""
    table = work.table[0]
    scale = math.sqrt(table.weight[frame, task])
    if table.kind[task] >= ROTATION:
        scale *= TURN_LENGTH
    near = min(1.0, work.settings[0].reach_limit / max(work.asked[0].errors[task], 1e-12))
    width = work.stack[0].widths[table.level[task]]
    for row in range(rows.shape[0]):
        errors[row] *= scale * near
        if scale != 1.0:
            for column in range(width):
                rows[row, column] *= scale

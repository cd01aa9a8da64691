"""The loop over the frames of a clip, and inside it the loop of convergence (2003, figure 6)."""

import math
from typing import NamedTuple

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels import (
    TaskTable,
    inlined,
    kernel,
    number_columns,
    place,
    task_error,
    task_rows,
)
from usdmotion.kernels.quaternions import (
    Quaternion,
    inverse,
    product,
    quaternion,
    rotation_vector,
    turned,
    unit,
)
from usdmotion_prioritized_ik.stack import Stack, descend, remove_spanned

SETTLED, LIMIT = 1, 2
EXACT = 1e-9
"""An error below this is none [m or rad]."""
MISSED = 1e-7
"""An error above this, after the finish, is out of reach [m or rad]."""
LEAK = 1e-6
"""What a lower level may cost a higher one [m or rad]."""
FEW = 6
"""Iterations that are enough for whatever is within reach."""
TURN_LENGTH = 0.2
"""A radian of a rotation task counts as so many metres, about the lever of a hand or a foot."""


class Input(NamedTuple):
    """The cast's input motion: F frames, N nodes."""

    parents: Ints
    translates: Bools
    freedom: Floats
    """(N,) 1 − stiffness: how willingly a node turns."""
    translations: Floats
    rotations: Floats


class Settings(NamedTuple):
    """The solver's options, as numbers."""

    iterations: int
    finish: int
    posture: float
    root: float
    damping: float
    curvature: float
    rank: float
    turn_limit: float
    reach_limit: float
    error_change: float
    posture_change: float


class Pose(NamedTuple):
    """The pose of one frame while it is being solved, and what is measured on it."""

    translations: Floats
    rotations: Floats
    positions: Floats
    orientations: Floats
    recruited: Bools
    """(N,) which nodes may move."""
    saved_translations: Floats
    saved_rotations: Floats
    columns: Ints
    """(N,) first column of each node that may move, -1 for the others."""
    on: Bools
    """(T,) which tasks take part."""
    kept: Floats
    """(T, 3) the error that an easing task leaves."""
    errors: Floats
    """(T,) weighted length of each task's error at the last iteration."""
    posture: Floats
    """(C,) what would bring the input posture back."""
    block: Floats
    """(3, C) scratch."""
    row_errors: Floats
    """(3,) scratch."""


class Carried(NamedTuple):
    """The displacement found on the frame before, for the first 1, 2, … L levels."""

    valid: Bools
    """(L,)"""
    translations: Floats
    """(L, N, 3) to be added to the input's."""
    rotations: Floats
    """(L, N, 4) to be applied before the input's."""


@kernel
def solve_clip(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    carried: Carried,
    stack: Stack,
    translations: Floats,
    rotations: Floats,
    iterations: Ints,
    stops: Ints,
) -> None:
    """(F, N, 3), (F, N, 4), (F,), (F,) are written, frame by frame.

    What is fully on is solved first, then what eases in or out joins in rank order. An easing task
    leaves the share 1 − a of the error that it has in the frame solved without it (DESIGN,
    section 6: x_free + a (goal − x_free)).
    """
    for frame in range(given.rotations.shape[0]):
        easing = _begin(table, pose, frame)
        spent, stop = 0, SETTLED
        for task in range(table.kind.shape[0] + 1):
            last = task == table.kind.shape[0]
            if not last and (pose.on[task] or table.activity[frame, task] == 0.0):
                continue
            if last or easing:
                more, stop = _solve(given, table, settings, pose, carried, stack, frame, last)
                spent += more
            if not last:
                _keep(table, pose, frame, task, 1.0 - table.activity[frame, task])
                pose.on[task] = True
        iterations[frame], stops[frame] = spent, stop
        for node in range(given.parents.shape[0]):
            for axis in range(3):
                translations[frame, node, axis] = pose.translations[node, axis]
            for axis in range(4):
                rotations[frame, node, axis] = pose.rotations[node, axis]


@inlined
def _begin(table: TaskTable, pose: Pose, frame: int) -> bool:
    """Turn on the tasks that are fully active; return whether others ease."""
    easing = False
    for task in range(table.kind.shape[0]):
        activity = table.activity[frame, task]
        pose.on[task] = activity >= 1.0
        for axis in range(3):
            pose.kept[task, axis] = 0.0
        easing |= 0.0 < activity < 1.0
    return easing


@inlined
def _keep(table: TaskTable, pose: Pose, frame: int, task: int, share: float) -> None:
    """From here on a task is to leave a share of the error that it has now."""
    error = task_error(table, frame, task, pose.positions, pose.orientations)
    for axis in range(3):
        pose.kept[task, axis] = share * error[axis]


@inlined
def _solve(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    carried: Carried,
    stack: Stack,
    frame: int,
    last: bool,
) -> tuple[int, int]:
    """Solve all levels at once; where one is out of reach, level by level from there on.

    Projection is exact only to first order, so that a level that is missed still gives way to the
    levels under it. What it attains without them is therefore found first, and kept as its goal
    while they are solved: then all levels above are within reach, and given up to nobody.
    """
    levels = carried.valid.shape[0]
    _recruit(given, table, pose, levels)
    _start(given, pose, carried, frame, levels - 1)
    spent, stop = _settle(given, table, settings, pose, stack, frame, levels)
    spent += _finish(given, table, settings, pose, stack, frame, levels, FEW)
    first = _first_missed(table, pose, levels)
    for level in range(levels - 1):
        carried.valid[level] &= level >= first
    for level in range(first, levels):
        if first < levels - 1:
            _recruit(given, table, pose, level + 1)
            if carried.valid[level] or level == first:
                _start(given, pose, carried, frame, level)
            more, stop = _settle(given, table, settings, pose, stack, frame, level + 1)
            spent += more
        spent += _last_level(given, table, settings, pose, stack, frame, level, level > first)
        if last and level < levels - 1:
            _carry(given, pose, carried, frame, level)
        for task in range(table.kind.shape[0]):
            if table.level[task] == level and pose.on[task]:
                _keep(table, pose, frame, task, 1.0)
        _save(pose)
    if last:
        _carry(given, pose, carried, frame, levels - 1)
    return spent, stop


@inlined
def _last_level(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    level: int,
    saved: bool,
) -> int:
    """Bring a level as near as the levels above allow; return the iterations.

    First all levels, then without the lowest, and so on up the ranks. Where two levels are met at
    one point only, that does not bring the upper ones back. Then the pose in which they were met
    is taken up again, and left only by steps that bring this level nearer and cost them nothing.
    """
    spent = 0
    for levels in range(level + 1, 0, -1):
        spent += _finish(given, table, settings, pose, stack, frame, levels, settings.finish)
    if not saved or _worst(table, pose, level) < LEAK:
        return spent
    _restore(given, pose)
    _linearize(given, table, settings, pose, stack, frame, level + 1)
    best = _left(table, pose, level)
    scale = 1.0
    for _ in range(settings.finish):
        if scale < 1e-3:
            break
        _linearize(given, table, settings, pose, stack, frame, level + 1)
        _iterate(given, settings, pose, stack, frame, level + 1, False, scale)
        for levels in range(level, 0, -1):
            spent += 1 + _finish(given, table, settings, pose, stack, frame, levels, FEW)
        _linearize(given, table, settings, pose, stack, frame, level + 1)
        left = _left(table, pose, level)
        if left < best and _worst(table, pose, level) < LEAK:
            best = left
            _save(pose)
        else:
            scale *= 0.3
            _restore(given, pose)
    return spent


@inlined
def _worst(table: TaskTable, pose: Pose, levels: int) -> float:
    worst = 0.0
    for task in range(table.kind.shape[0]):
        if table.level[task] < levels and pose.on[task]:
            worst = max(worst, pose.errors[task])
    return worst


@inlined
def _left(table: TaskTable, pose: Pose, level: int) -> float:
    square = 0.0
    for task in range(table.kind.shape[0]):
        if table.level[task] == level and pose.on[task]:
            square += pose.errors[task] ** 2
    return square


@inlined
def _save(pose: Pose) -> None:
    for node in range(pose.rotations.shape[0]):
        for axis in range(3):
            pose.saved_translations[node, axis] = pose.translations[node, axis]
        for axis in range(4):
            pose.saved_rotations[node, axis] = pose.rotations[node, axis]


@inlined
def _restore(given: Input, pose: Pose) -> None:
    for node in range(pose.rotations.shape[0]):
        for axis in range(3):
            pose.translations[node, axis] = pose.saved_translations[node, axis]
        for axis in range(4):
            pose.rotations[node, axis] = pose.saved_rotations[node, axis]
    place(given.parents, pose.translations, pose.rotations, pose.positions, pose.orientations)


@inlined
def _first_missed(table: TaskTable, pose: Pose, levels: int) -> int:
    for task in range(table.kind.shape[0]):
        if pose.on[task] and pose.errors[task] > MISSED:
            return table.level[task]
    return levels


@inlined
def _recruit(given: Input, table: TaskTable, pose: Pose, levels: int) -> None:
    """Number the columns of the nodes that the first levels may move."""
    for node in range(given.parents.shape[0]):
        pose.recruited[node] = False
        for task in range(table.kind.shape[0]):
            if table.level[task] < levels and pose.on[task] and table.recruits[task, node]:
                pose.recruited[node] = given.freedom[node] > 0.0
    number_columns(pose.recruited, given.translates, pose.columns)


@inlined
def _start(given: Input, pose: Pose, carried: Carried, frame: int, carry: int) -> None:
    """Write the posture to start from: the input's, with the displacement of the frame before.

    2004, equation 4 starts from that frame's posture itself, which lags more.
    """
    for node in range(given.parents.shape[0]):
        moves = carried.valid[carry] and pose.recruited[node]
        for axis in range(3):
            pose.translations[node, axis] = given.translations[frame, node, axis]
            if moves and given.translates[node]:
                pose.translations[node, axis] += carried.translations[carry, node, axis]
        turn = _four(given.rotations[frame, node])
        if moves:
            turn = unit(product(turn, _four(carried.rotations[carry, node])))
        for axis in range(4):
            pose.rotations[node, axis] = turn[axis]
    place(given.parents, pose.translations, pose.rotations, pose.positions, pose.orientations)


@inlined
def _carry(given: Input, pose: Pose, carried: Carried, frame: int, carry: int) -> None:
    """Keep the displacement of the pose from the input for the next frame."""
    carried.valid[carry] = True
    for node in range(given.parents.shape[0]):
        turn = product(
            inverse(_four(given.rotations[frame, node])), _four(pose.rotations[node])
        )  # fmt: skip
        for axis in range(4):
            carried.rotations[carry, node, axis] = turn[axis] if pose.recruited[node] else 0.0
        if not pose.recruited[node]:
            carried.rotations[carry, node, 3] = 1.0
        for axis in range(3):
            carried.translations[carry, node, axis] = (
                pose.translations[node, axis] - given.translations[frame, node, axis]
            )


@inlined
def _four(q: Floats) -> Quaternion:
    return (q[0], q[1], q[2], q[3])


@inlined
def _settle(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    levels: int,
) -> tuple[int, int]:
    """Iterate until neither the errors nor the posture vary (2003, section 4.1)."""
    _forget_errors(pose)
    for spent in range(1, settings.iterations + 1):
        change = _linearize(given, table, settings, pose, stack, frame, levels)
        moved = _iterate(given, settings, pose, stack, frame, levels, True, 1.0)
        if change < settings.error_change and moved < settings.posture_change:
            return spent, SETTLED
    return settings.iterations, LIMIT


@inlined
def _finish(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    levels: int,
    most: int,
) -> int:
    """Meet the first levels to the last digit, without the posture; return the iterations."""
    _forget_errors(pose)
    for spent in range(most + 1):
        change = _linearize(given, table, settings, pose, stack, frame, levels)
        if change < EXACT or spent == most or _met(table, pose, levels):
            return spent
        _iterate(given, settings, pose, stack, frame, levels, False, 1.0)
    return most


@inlined
def _forget_errors(pose: Pose) -> None:
    for task in range(pose.errors.shape[0]):
        pose.errors[task] = math.inf


@inlined
def _met(table: TaskTable, pose: Pose, levels: int) -> bool:
    for task in range(table.kind.shape[0]):
        if table.level[task] < levels and pose.on[task] and pose.errors[task] > EXACT:
            return False
    return True


@inlined
def _linearize(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    levels: int,
) -> float:
    """Fill the stack with the rows of the first levels; return the largest change of an error."""
    change = 0.0
    row, level = 0, 0
    stack.first_row[0] = 0
    for task in range(table.kind.shape[0]):
        if table.level[task] >= levels:
            break
        while level < table.level[task]:
            level += 1
            stack.first_row[level] = row
        if not pose.on[task]:
            continue
        error = task_error(table, frame, task, pose.positions, pose.orientations)
        kept = pose.kept[task]
        error = (error[0] - kept[0], error[1] - kept[1], error[2] - kept[2])
        count = task_rows(
            table, frame, task, given.parents, given.translates, pose.columns,
            pose.positions, pose.orientations, error,
            stack.rows[row:], pose.row_errors, pose.block,
        )  # fmt: skip
        length = 0.0
        for index in range(count):
            length += pose.row_errors[index] ** 2
        length = math.sqrt(length)
        change = max(change, abs(length - pose.errors[task]))
        pose.errors[task] = length
        scale = math.sqrt(table.weight[frame, task])
        if table.kind[task] == 1:
            scale *= TURN_LENGTH
        near = min(1.0, settings.reach_limit / max(length, 1e-12))
        for index in range(count):
            stack.errors[row + index] = scale * near * pose.row_errors[index]
            for column in range(stack.rows.shape[1]):
                stack.rows[row + index, column] *= scale
        row += count
    while level < levels:
        level += 1
        stack.first_row[level] = row
    return change


@inlined
def _iterate(
    given: Input,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    levels: int,
    posture: bool,
    scale: float,
) -> float:
    """Move the pose by one step of the stack; return the largest turn [rad]."""
    columns = _column_count(given, pose)
    used = descend(
        stack, levels, columns, settings.damping, settings.curvature, settings.rank
    )  # fmt: skip
    if posture:
        _towards_input(given, settings, pose, frame)
        remove_spanned(stack, used, pose.posture, columns)
        for column in range(columns):
            stack.step[column] += pose.posture[column]
    largest = 0.0
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column >= 0:
            v = stack.step[column : column + 3]
            largest = max(largest, math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))
    _move(given, pose, stack.step, min(scale, settings.turn_limit / max(largest, 1e-12)))
    return largest


@inlined
def _column_count(given: Input, pose: Pose) -> int:
    for node in range(given.parents.shape[0] - 1, -1, -1):
        if pose.columns[node] >= 0:
            return pose.columns[node] + (6 if given.translates[node] else 3)
    return 0


@inlined
def _towards_input(given: Input, settings: Settings, pose: Pose, frame: int) -> None:
    """The vector z of 2004, equation 1: each joint towards its angle in the input motion."""
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        parent = given.parents[node]
        turn = rotation_vector(product(given.rotations[frame, node], inverse(pose.rotations[node])))
        turn = turned(pose.orientations[parent], turn)
        for axis in range(3):
            pose.posture[column + axis] = settings.posture * turn[axis]
        if given.translates[node]:
            way = turned(
                pose.orientations[parent], given.translations[frame, node] - pose.translations[node]
            )
            for axis in range(3):
                pose.posture[column + 3 + axis] = settings.root * way[axis]


@inlined
def _move(given: Input, pose: Pose, step: Floats, scale: float) -> None:
    """Compose the pose with a step, and place it in the world."""
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        back = inverse(pose.orientations[given.parents[node]])
        turn = turned(
            back, (scale * step[column], scale * step[column + 1], scale * step[column + 2])
        )
        rotation = unit(product(quaternion(turn), pose.rotations[node]))
        for axis in range(4):
            pose.rotations[node, axis] = rotation[axis]
        if given.translates[node]:
            way = turned(
                back, (scale * step[column + 3], scale * step[column + 4], scale * step[column + 5])
            )
            for axis in range(3):
                pose.translations[node, axis] += way[axis]
    place(
        given.parents, pose.translations, pose.rotations, pose.positions, pose.orientations
    )  # fmt: skip

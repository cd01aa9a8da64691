"""The loop over the frames of a clip, and inside it the loop of convergence (2003, figure 6)."""

import math
from typing import NamedTuple

import numpy as np

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
    inverse,
    product,
    quaternion,
    rotation_vector,
    turned,
    unit,
)
from usdmotion_prioritized_ik.stack import Stack, descend, remove_spanned

SETTLED, LIMIT = 1, 2
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


@kernel
def solve_clip(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    translations: Floats,
    rotations: Floats,
    iterations: Ints,
    stops: Ints,
) -> None:
    """(F, N, 3), (F, N, 4), (F,), (F,) are written, frame by frame.

    A frame starts from the input posture with the displacement of the frame before on every joint
    that still moves: 2004, equation 4 starts from the posture itself, which lags more.
    """
    for frame in range(given.rotations.shape[0]):
        _solve_frame(
            given, table, settings, pose, stack, frame,
            translations, rotations, iterations, stops,
        )  # fmt: skip


@inlined
def _solve_frame(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    stack: Stack,
    frame: int,
    translations: Floats,
    rotations: Floats,
    iterations: Ints,
    stops: Ints,
) -> None:
    """Solve one frame: what is fully on first, then what eases in or out, in rank order.

    An easing task leaves the share 1 − a of the error that it has in the frame solved without it
    (DESIGN, section 6: x_free + a (goal − x_free)).
    """
    count = table.kind.shape[0]
    easing = 0
    for task in range(count):
        activity = table.activity[frame, task]
        pose.on[task] = activity >= 1.0
        for axis in range(3):
            pose.kept[task, axis] = 0.0
        if 0.0 < activity < 1.0 and table.weight[frame, task] > 0.0:
            easing += 1
    spent, stop = 0, SETTLED
    for task in range(count + 1):
        last = task == count
        if not last and (pose.on[task] or table.activity[frame, task] == 0.0):
            continue
        if last or easing > 0:
            _start(given, table, settings, pose, frame, translations, rotations)
            more, stop = _converge(given, table, settings, pose, stack, frame)
            spent += more
        if not last:
            _keep_share(table, pose, frame, task)
    iterations[frame], stops[frame] = spent, stop
    for node in range(given.parents.shape[0]):
        for axis in range(3):
            translations[frame, node, axis] = pose.translations[node, axis]
        for axis in range(4):
            rotations[frame, node, axis] = pose.rotations[node, axis]


@inlined
def _keep_share(table: TaskTable, pose: Pose, frame: int, task: int) -> None:
    """Turn an easing task on, with the error it is to leave; so are others of its constraint."""
    error = task_error(table, frame, task, pose.positions, pose.orientations)
    for axis in range(3):
        pose.kept[task, axis] = (1.0 - table.activity[frame, task]) * error[axis]
    pose.on[task] = True


@inlined
def _start(
    given: Input,
    table: TaskTable,
    settings: Settings,
    pose: Pose,
    frame: int,
    translations: Floats,
    rotations: Floats,
) -> None:
    """Write the posture that a frame starts from, and which nodes may move."""
    for node in range(given.parents.shape[0]):
        pose.recruited[node] = False
        for task in range(table.kind.shape[0]):
            if pose.on[task] and table.weight[frame, task] > 0.0 and table.recruits[task, node]:
                pose.recruited[node] = given.freedom[node] > 0.0
    number_columns(pose.recruited, given.translates, pose.columns)
    before = frame - 1
    for node in range(given.parents.shape[0]):
        for axis in range(3):
            pose.translations[node, axis] = given.translations[frame, node, axis]
        for axis in range(4):
            pose.rotations[node, axis] = given.rotations[frame, node, axis]
        if before < 0 or not pose.recruited[node]:
            continue
        back = inverse(given.rotations[before, node])
        turn = product(given.rotations[frame, node], product(back, rotations[before, node]))
        turn = unit(turn)
        for axis in range(4):
            pose.rotations[node, axis] = turn[axis]
        if given.translates[node]:
            for axis in range(3):
                pose.translations[node, axis] += (
                    translations[before, node, axis] - given.translations[before, node, axis]
                )
    place(
        given.parents, pose.translations, pose.rotations, pose.positions, pose.orientations
    )  # fmt: skip


@inlined
def _converge(
    given: Input, table: TaskTable, settings: Settings, pose: Pose, stack: Stack, frame: int
) -> tuple[int, int]:
    """Iterate until neither errors nor posture vary (2003, section 4.1), then finish.

    The finish leaves the posture alone and lets go of the lowest level, then of the next, so that
    what the linearization still pushed upwards is made good, the top level last.
    """
    levels = table.level[table.level.shape[0] - 1] + 1
    stop = LIMIT
    spent = 0
    _forget_errors(pose)
    while spent < settings.iterations:
        spent += 1
        change = _linearize(given, table, settings, pose, stack, frame, levels)
        moved = _iterate(given, settings, pose, stack, frame, levels, True)
        if change < settings.error_change and moved < settings.posture_change:
            stop = SETTLED
            break
    for top in range(levels, 0, -1):
        _forget_errors(pose)
        for _ in range(settings.finish):
            change = _linearize(given, table, settings, pose, stack, frame, top)
            if _met(table, pose, top):
                break
            spent += 1
            _iterate(given, settings, pose, stack, frame, top, False)
            if change < 1e-9:
                break
    return spent, stop


@inlined
def _forget_errors(pose: Pose) -> None:
    for task in range(pose.errors.shape[0]):
        pose.errors[task] = math.inf


@inlined
def _met(table: TaskTable, pose: Pose, levels: int) -> bool:
    for task in range(table.kind.shape[0]):
        if table.level[task] < levels and pose.on[task] and pose.errors[task] > 1e-9:
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
        weight = table.weight[frame, task]
        if not pose.on[task] or weight <= 0.0:
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
        scale = math.sqrt(weight)
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
    _move(given, pose, stack.step, min(1.0, settings.turn_limit / max(largest, 1e-12)))
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

"""What is left of each task in a pose, and the target orientation of the rotation tasks."""

import math
from typing import Any

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels.compiling import kernel, shared
from usdmotion.kernels.parts import Reference, reference
from usdmotion.kernels.quaternions import (
    Quaternion,
    Vector,
    cross,
    interpolated,
    inverse,
    product,
    quaternion_at,
    quaternion_in,
    rotation_vector,
    turned,
    unit,
    vector_at,
    vector_in,
)
from usdmotion.kernels.shapes import Gap, gap
from usdmotion.kernels.table import Kind, TaskTable

DISTANCE, ROTATION, AIM = int(Kind.DISTANCE), int(Kind.ROTATION), int(Kind.AIM)


@kernel
def residuals(table: TaskTable, positions: Floats, orientations: Floats) -> Floats:
    """(F, N, 3), (F, N, 4) to (F, T): metres for points, radians for rotations."""
    tasks = reference(table)
    frames, count = positions.shape[0], table.kind.shape[0]
    errors = np.zeros((frames, count))
    for frame in range(frames):
        for task in range(count):
            error = task_error(tasks, frame, task, positions[frame], orientations[frame])
            if not is_slack(tasks, task, error):
                errors[frame, task] = held_length(tasks, frame, task, error, orientations[frame])
    return errors


@shared
def task_error(
    tasks: Reference[TaskTable], frame: int, task: int, positions: Floats, orientations: Floats
) -> Vector:
    """Return what is asked less what is.

    For a point the world vector [m], for a rotation or an aim the world rotation vector [rad], for
    a distance what is to be added to it and twice 0 [m].
    """
    table = tasks[0]
    if table.kind[task] == ROTATION:
        return _turn_error(tasks, frame, task, orientations)
    if table.kind[task] == DISTANCE:
        found = world_gap(tasks, frame, task, positions, orientations)
        return (table.distance[frame, task] - found[3], 0.0, 0.0)
    x, y, z = seen_from_target(tasks, frame, task, positions, orientations)
    if table.kind[task] == AIM:
        node = table.term_node[table.first_term[task]]
        axis = turned(quaternion_at(orientations, node), vector_at(table.free_axis, task))
        return between(axis, (-x, -y, -z))
    return (-x, -y, -z)


@shared
def is_slack(tasks: Reference[TaskTable], task: int, error: Any) -> bool:
    """Tell whether a task is a bound that an error, as `task_error` gives it, keeps."""
    bound = tasks[0].bound[task]
    return bool(bound != 0 and bound * error[0] <= 0.0)


@shared
def seen_from_target(
    tasks: Reference[TaskTable], frame: int, task: int, positions: Floats, orientations: Floats
) -> Vector:
    """Return the sum of a task's terms less its target, in the world [m]."""
    table = tasks[0]
    x, y, z = vector_in(table.target, frame, task)
    x, y, z = -x, -y, -z
    for term in range(table.first_term[task], table.first_term[task + 1]):
        node = table.term_node[term]
        factor = table.term_coefficient[frame, term]
        point = turned(quaternion_at(orientations, node), vector_in(table.term_point, frame, term))
        x += factor * (positions[node, 0] + point[0])
        y += factor * (positions[node, 1] + point[1])
        z += factor * (positions[node, 2] + point[2])
    return (x, y, z)


@shared
def world_gap(
    tasks: Reference[TaskTable], frame: int, task: int, positions: Floats, orientations: Floats
) -> Gap:
    """Return the gap between the sum of a distance task's terms and its shape, in the world."""
    table = tasks[0]
    seen = seen_from_target(tasks, frame, task, positions, orientations)
    turn = quaternion_in(table.axes_rotation, frame, task)
    within = turned(inverse(turn), seen)
    found = gap(table.shape[task], vector_in(table.extent, frame, task), within)
    x, y, z = turned(turn, (found[0], found[1], found[2]))
    return (x, y, z, found[3])


@shared
def held_length(
    tasks: Reference[TaskTable], frame: int, task: int, error: Any, orientations: Floats
) -> float:
    """Return the length of an error along the directions that the task holds."""
    table = tasks[0]
    if table.kind[task] == DISTANCE:
        return abs(float(error[0]))
    square = 0.0
    for axis in range(3):
        if table.axes[task, axis]:
            direction = held_axis(tasks, frame, task, axis, orientations)
            along = direction[0] * error[0] + direction[1] * error[1] + direction[2] * error[2]
            square += along * along
    return math.sqrt(square)


@shared
def held_axis(
    tasks: Reference[TaskTable], frame: int, task: int, axis: int, orientations: Floats
) -> Vector:
    """Return the world direction of one of the axes along which a point is held."""
    table = tasks[0]
    x = 1.0 if axis == 0 else 0.0
    y = 1.0 if axis == 1 else 0.0
    z = 1.0 if axis == 2 else 0.0
    direction = turned(quaternion_in(table.axes_rotation, frame, task), (x, y, z))
    node = table.axes_node[task]
    if node >= 0:
        return turned(quaternion_at(orientations, node), direction)
    return direction


@shared
def _turn_error(tasks: Reference[TaskTable], frame: int, task: int, orientations: Floats) -> Vector:
    table = tasks[0]
    node = table.term_node[table.first_term[task]]
    asked = asked_orientation(tasks, frame, task, orientations)
    free = vector_at(table.free_axis, task)
    offset = quaternion_at(table.offset, task)
    frame_turn = quaternion_at(orientations, node)
    if free[0] == 0.0 and free[1] == 0.0 and free[2] == 0.0:
        present = product(frame_turn, offset)
        return rotation_vector(product(asked, inverse(present)))
    present_axis = turned(frame_turn, free)
    asked_axis = turned(asked, turned(inverse(offset), free))
    return between(present_axis, asked_axis)


@shared
def asked_orientation(
    tasks: Reference[TaskTable], frame: int, task: int, orientations: Floats
) -> Quaternion:
    """Return the composite goal of a rotation task: a mean of the goals, blended in."""
    table = tasks[0]
    first, last = table.first_goal[task], table.first_goal[task + 1]
    blend = table.blend[frame, task]
    start = quaternion_in(table.original, frame, task)
    if first == last or blend == 0.0:
        return start
    if last == first + 1:
        return interpolated(start, _goal(tasks, frame, first, orientations), blend)
    mean = _goal(tasks, frame, first, orientations)
    for _ in range(200):
        nearer = _drawn_to_goals(tasks, frame, task, orientations, mean)
        change = 0.0
        for axis in range(4):
            change = max(change, abs(nearer[axis] - mean[axis]))
        mean = nearer
        if change < 1e-15:
            break
    return interpolated(start, mean, blend)


@shared
def _drawn_to_goals(
    tasks: Reference[TaskTable], frame: int, task: int, orientations: Floats, mean: Quaternion
) -> Quaternion:
    """One power iteration on Σ w q qᵀ, whose first eigenvector is the chordal mean."""
    table = tasks[0]
    x, y, z, w = 0.0, 0.0, 0.0, 0.0
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        q = _goal(tasks, frame, goal, orientations)
        along = q[0] * mean[0] + q[1] * mean[1] + q[2] * mean[2] + q[3] * mean[3]
        along *= table.goal_weight[frame, goal]
        x += along * q[0]
        y += along * q[1]
        z += along * q[2]
        w += along * q[3]
    return unit((x, y, z, w))


@shared
def _goal(tasks: Reference[TaskTable], frame: int, goal: int, orientations: Floats) -> Quaternion:
    table = tasks[0]
    q = quaternion_in(table.goal_rotation, frame, goal)
    node = table.goal_node[goal]
    if node >= 0:
        return product(quaternion_at(orientations, node), q)
    return q


@shared
def between(a: Any, b: Any) -> Vector:
    """Return the shortest rotation vector that turns a's direction to b's."""
    axis = cross(a, b)
    sine = math.sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2])
    cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    if sine < 1e-12 * abs(cosine):
        if cosine > 0.0:
            return (0.0, 0.0, 0.0)
        return _half_turn(a)
    scale = math.atan2(sine, cosine) / sine
    return (axis[0] * scale, axis[1] * scale, axis[2] * scale)


@shared
def _half_turn(a: Any) -> Vector:
    """Return some half turn that reverses a direction."""
    other = (1.0, 0.0, 0.0) if abs(a[0]) < 0.5 * (abs(a[1]) + abs(a[2])) else (0.0, 1.0, 0.0)
    axis = cross(a, other)
    scale = math.pi / math.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)
    return (axis[0] * scale, axis[1] * scale, axis[2] * scale)

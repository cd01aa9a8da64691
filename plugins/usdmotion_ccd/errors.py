"""What is left of a task in the pose, and how a turn of a joint would change it."""

import math
from typing import Any

from usdmotion.kernels import Kind, is_slack, shared, task_error
from usdmotion.kernels.quaternions import (
    Vector,
    quaternion_at,
    turned,
    vector_at,
    vector_in,
)
from usdmotion.kernels.residuals import held_axis, seen_from_target, world_gap
from usdmotion_ccd.posing import carries
from usdmotion_ccd.state import Sight, Work

POINT, DISTANCE = int(Kind.POINT), int(Kind.DISTANCE)
ROTATION, AIM = int(Kind.ROTATION), int(Kind.AIM)
NEAREST = 1e-3
"""Nearer than this an aim's line of sight turns no faster [m]."""
Matrix = tuple[float, float, float, float, float, float, float, float, float]
"""Three rows, one after the other."""


@shared
def left(work: Work, frame: int, task: int) -> Vector:
    """Return what a task still asks for, a world vector [m] or a world rotation vector [rad]."""
    work.calls.measure(sight(work), frame, task)
    return vector_at(work.asked[0].left, task)


@shared
def sight(work: Work) -> Sight:
    """Return what tells how a task stands."""
    return Sight(work.table, work.tree, work.pose, work.asked)


def measure(seen: Sight, frame: int, task: int) -> None:
    """Write what a task still asks for."""
    asked = seen.asked[0]
    x, y, z = _left(seen, frame, task)
    asked.left[task, 0], asked.left[task, 1], asked.left[task, 2] = x, y, z


@shared
def _left(work: Sight, frame: int, task: int) -> Vector:
    table, pose, kept = work.table[0], work.pose[0], work.asked[0].kept
    x, y, z = task_error(work.table, frame, task, pose.positions, pose.orientations)
    raw = work.asked[0].raw
    raw[task, 0], raw[task, 1], raw[task, 2] = x, y, z
    error = (x - kept[task, 0], y - kept[task, 1], z - kept[task, 2])
    if is_slack(work.table, task, error):
        return (0.0, 0.0, 0.0)
    if table.kind[task] == DISTANCE:
        away = world_gap(work.table, frame, task, pose.positions, pose.orientations)
        return (away[0] * error[0], away[1] * error[0], away[2] * error[0])
    if table.kind[task] == POINT:
        return _along_held(work, frame, task, error)
    return error


@shared
def _along_held(work: Sight, frame: int, task: int, error: Any) -> Vector:
    table = work.table[0]
    if table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]:
        return (error[0], error[1], error[2])
    x, y, z = 0.0, 0.0, 0.0
    for axis in range(3):
        if table.axes[task, axis]:
            way = held_axis(work.table, frame, task, axis, work.pose[0].orientations)
            along = dot(way, error)
            x += along * way[0]
            y += along * way[1]
            z += along * way[2]
    return (x, y, z)


@shared
def dot(a: Any, b: Any) -> float:
    """Return the scalar product of two vectors."""
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


@shared
def length(a: Any) -> float:
    """Return the length of a vector."""
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@shared
def is_directly_held(work: Work, task: int) -> bool:
    """Tell whether all of a point's place is asked for, or its distance from something."""
    table = work.table[0]
    if table.kind[task] == DISTANCE:
        return True
    whole = table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]
    return bool(table.kind[task] == POINT and whole)


@shared
def lever(work: Sight, frame: int, task: int, node: int) -> Vector:
    """Return the part of a sum of points that a joint carries, as seen from it [m]."""
    table, pose = work.table[0], work.pose[0]
    x, y, z = 0.0, 0.0, 0.0
    for term in range(table.first_term[task], table.first_term[task + 1]):
        at = table.term_node[term]
        if carries(work.tree, node, at):
            factor = table.term_coefficient[frame, term]
            place = term_place(work, frame, term)
            x += factor * (place[0] - pose.positions[node, 0])
            y += factor * (place[1] - pose.positions[node, 1])
            z += factor * (place[2] - pose.positions[node, 2])
    return (x, y, z)


@shared
def term_place(work: Sight, frame: int, term: int) -> Vector:
    """Return where the point of a term is in the world."""
    table, pose = work.table[0], work.pose[0]
    at = table.term_node[term]
    point = turned(quaternion_at(pose.orientations, at), vector_in(table.term_point, frame, term))
    return (
        pose.positions[at, 0] + point[0],
        pose.positions[at, 1] + point[1],
        pose.positions[at, 2] + point[2],
    )


@shared
def carried_factor(work: Sight, frame: int, task: int, node: int) -> float:
    """Return how far a sum of points goes along with a root, but for what is held in place."""
    table, pinned = work.table[0], work.asked[0].pinned
    total = 0.0
    for term in range(table.first_term[task], table.first_term[task + 1]):
        at = table.term_node[term]
        if carries(work.tree, node, at) and not pinned[at]:
            total += table.term_coefficient[frame, term]
    return total


@shared
def turned_share(work: Sight, frame: int, task: int, node: int) -> float:
    """Return how much of a joint's turn is seen by a task that compares orientations."""
    table = work.table[0]
    share, total = 0.0, 0.0
    if carries(work.tree, node, table.term_node[table.first_term[task]]):
        share = 1.0
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        total += table.goal_weight[frame, goal]
    for goal in range(table.first_goal[task], table.first_goal[task + 1]):
        at = table.goal_node[goal]
        if at >= 0 and total > 0.0 and carries(work.tree, node, at):
            share -= table.blend[frame, task] * table.goal_weight[frame, goal] / total
    return share


@shared
def effect(work: Work, frame: int, task: int, node: int) -> Matrix:
    """Return how a task's error decreases with a turn of a joint, along what it holds."""
    work.calls.slope(sight(work), frame, task, node)
    rows = work.asked[0].slopes
    return (
        rows[task, 0], rows[task, 1], rows[task, 2],
        rows[task, 3], rows[task, 4], rows[task, 5],
        rows[task, 6], rows[task, 7], rows[task, 8],
    )  # fmt: skip


def slope(seen: Sight, frame: int, task: int, node: int) -> None:
    """Write how a task's error decreases with a turn of a joint, or a shift of a root."""
    rows = _effect(seen, frame, task, node)
    slopes = seen.asked[0].slopes
    slopes[task, 0], slopes[task, 1], slopes[task, 2] = rows[0], rows[1], rows[2]
    slopes[task, 3], slopes[task, 4], slopes[task, 5] = rows[3], rows[4], rows[5]
    slopes[task, 6], slopes[task, 7], slopes[task, 8] = rows[6], rows[7], rows[8]


@shared
def _effect(work: Sight, frame: int, task: int, node: int) -> Matrix:
    table = work.table[0]
    if table.kind[task] == ROTATION:
        share = turned_share(work, frame, task, node)
        rows = (share, 0.0, 0.0, 0.0, share, 0.0, 0.0, 0.0, share)
    else:
        x, y, z = lever(work, frame, task, node)
        rows = (0.0, z, -y, -z, 0.0, x, y, -x, 0.0)
        if table.kind[task] == AIM:
            rows = _sight(work, frame, task, node, (x, y, z))
    return along_held_rows(work, frame, task, rows)


@shared
def _sight(work: Sight, frame: int, task: int, node: int, arm: Any) -> Matrix:
    """The node's turn less that of its line of sight, which is seen × (turn × arm) / seen²."""
    pose, table = work.pose[0], work.table[0]
    seen = seen_from_target(work.table, frame, task, pose.positions, pose.orientations)
    square = max(dot(seen, seen), NEAREST * NEAREST)
    own = 0.0
    if carries(work.tree, node, table.term_node[table.first_term[task]]):
        own = 1.0
    own -= dot(seen, arm) / square
    x, y, z = arm[0] / square, arm[1] / square, arm[2] / square
    return (
        own + x * seen[0], x * seen[1], x * seen[2],
        y * seen[0], own + y * seen[1], y * seen[2],
        z * seen[0], z * seen[1], own + z * seen[2],
    )  # fmt: skip


@shared
def along_held_rows(work: Sight, frame: int, task: int, rows: Any) -> Matrix:
    """Keep of three rows what is along the directions that a task holds."""
    table, pose = work.table[0], work.pose[0]
    if table.kind[task] == DISTANCE:
        away = world_gap(work.table, frame, task, pose.positions, pose.orientations)
        return _along((away[0], away[1], away[2]), rows)
    if table.kind[task] != POINT:
        free = vector_at(table.free_axis, task)
        if free[0] == 0.0 and free[1] == 0.0 and free[2] == 0.0:
            return (rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8])
        node = table.term_node[table.first_term[task]]
        spare = _along(turned(quaternion_at(pose.orientations, node), free), rows)
        return _sum(rows, spare, -1.0)
    if table.axes[task, 0] and table.axes[task, 1] and table.axes[task, 2]:
        return (rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8])
    kept = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for axis in range(3):
        if table.axes[task, axis]:
            way = held_axis(work.table, frame, task, axis, pose.orientations)
            kept = _sum(kept, _along(way, rows), 1.0)
    return kept


@shared
def _along(way: Any, rows: Any) -> Matrix:
    """Keep of three rows what is along a direction."""
    x = way[0] * rows[0] + way[1] * rows[3] + way[2] * rows[6]
    y = way[0] * rows[1] + way[1] * rows[4] + way[2] * rows[7]
    z = way[0] * rows[2] + way[1] * rows[5] + way[2] * rows[8]
    return (
        way[0] * x, way[0] * y, way[0] * z,
        way[1] * x, way[1] * y, way[1] * z,
        way[2] * x, way[2] * y, way[2] * z,
    )  # fmt: skip


@shared
def _sum(a: Any, b: Any, factor: float) -> Matrix:
    return (
        a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2],
        a[3] + factor * b[3], a[4] + factor * b[4], a[5] + factor * b[5],
        a[6] + factor * b[6], a[7] + factor * b[7], a[8] + factor * b[8],
    )  # fmt: skip

"""Limits of joints: a box for each rotation vector, obeyed above every priority.

A pose never leaves its boxes: what a step would cross becomes a bound, and what is left of it to
second order is clamped after every move.
"""

import math
from typing import Any

import numpy as np

from usdmotion import Floats, Problem
from usdmotion.kernels import beyond_limits, limit_boxes, shared, within_limits
from usdmotion.kernels.quaternions import (
    Vector,
    cross,
    inverse,
    product,
    quaternion,
    quaternion_at,
    rotation_vector,
    turned,
    unit,
    vector_at,
)
from usdmotion_prioritized_ik.bounds import add_bound, bar
from usdmotion_prioritized_ik.state import Limits, Work

TURN = 2.0 * math.pi
NEAR_TURN = TURN - 0.1
"""Rotation vectors longer than this count as so long, where their derivative has no end."""
ALL = -1
"""No level stands above a limit."""


def limits_of(problem: Problem) -> Limits:
    """Return the limits of the joints that a problem may move."""
    cast = problem.cast
    moves = problem.recruited & (cast.stiffness < 1.0)
    limited = (cast.limits_min > -180.0) | (cast.limits_max < 180.0)
    nodes = np.flatnonzero(moves & limited.any(axis=1))
    boxes = limit_boxes(cast.limits_min[nodes], cast.limits_max[nodes])
    return Limits(nodes, np.array(cast.rest_rotations[nodes]), *boxes)


def clamp(rotations: Floats, limits: Limits) -> None:
    """(F, N, 4): bring a motion's joints within their limits, in place."""
    box = (limits.rests, limits.low, limits.high)
    own = rotations[:, limits.nodes]
    if beyond_limits(own, *box).any():
        rotations[:, limits.nodes] = within_limits(own, *box)


@shared
def keep_within(work: Work) -> None:
    """Clamp the joints of the pose that may move."""
    limits, pose = work.limits[0], work.pose[0]
    for index in range(limits.nodes.shape[0]):
        node = limits.nodes[index]
        if pose.columns[node] < 0:
            continue
        vector = _limited_vector(work, index, node)
        outside = _outside(work, index, vector)
        if outside[0] != 0.0 or outside[1] != 0.0 or outside[2] != 0.0:
            x, y, z = vector[0] - outside[0], vector[1] - outside[1], vector[2] - outside[2]
            inside = product(quaternion_at(limits.rests, index), quaternion((x, y, z)))
            rotation = unit(inside)
            for axis in range(4):
                pose.rotations[node, axis] = rotation[axis]


@shared
def bound_turns(work: Work) -> None:
    """Add a bound for every limit that one iteration can reach."""
    limits, pose = work.limits[0], work.pose[0]
    most = work.settings[0].turn_limit
    for index in range(limits.nodes.shape[0]):
        node = limits.nodes[index]
        column = pose.columns[node]
        if column < 0:
            continue
        vector = _limited_vector(work, index, node)
        parent = quaternion_at(pose.orientations, work.given[0].parents[node])
        frame = product(parent, quaternion_at(limits.rests, index))
        for axis in range(3):
            x, y, z = _gradient(vector, axis)
            length = math.sqrt(x * x + y * y + z * z)
            low = min(limits.low[index, axis] - vector[axis], 0.0) / length
            high = max(limits.high[index, axis] - vector[axis], 0.0) / length
            if low < -most and high > most:
                continue
            row = turned(frame, (x / length, y / length, z / length))
            if limits.low[index, axis] == limits.high[index, axis]:
                bar(work.bounds, column, row)
                continue
            bound = add_bound(work.bounds, ALL, column, column + 3, low, high)
            for part in range(3):
                work.bounds[0].rows[bound, column + part] = row[part]


@shared
def _limited_vector(work: Work, index: int, node: int) -> Vector:
    """Return the rotation vector from rest, of the two the one that is nearer to its box."""
    rest = quaternion_at(work.limits[0].rests, index)
    short = rotation_vector(product(inverse(rest), quaternion_at(work.pose[0].rotations, node)))
    x, y, z = _outside(work, index, short)
    distance = x * x + y * y + z * z
    angle = math.sqrt(short[0] * short[0] + short[1] * short[1] + short[2] * short[2])
    if distance == 0.0 or angle < 1e-6:
        return short
    factor = 1.0 - TURN / angle
    long = (factor * short[0], factor * short[1], factor * short[2])
    x, y, z = _outside(work, index, long)
    return long if x * x + y * y + z * z < distance else short


@shared
def _outside(work: Work, index: int, vector: Any) -> Vector:
    """Return the way to a rotation vector from the nearest one in its box."""
    low, high = vector_at(work.limits[0].low, index), vector_at(work.limits[0].high, index)
    return (
        min(vector[0] - low[0], 0.0) + max(vector[0] - high[0], 0.0),
        min(vector[1] - low[1], 0.0) + max(vector[1] - high[1], 0.0),
        min(vector[2] - low[2], 0.0) + max(vector[2] - high[2], 0.0),
    )


@shared
def _gradient(vector: Any, axis: int) -> Vector:
    """Return what one component of a rotation vector gains by a turn of its frame of reference.

    It is a row of the inverse of the left Jacobian of SO(3) (Chirikjian 2011, eq. 10.86).
    """
    along = (1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0)
    once = cross(vector, along)
    twice = cross(vector, once)
    square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
    if square < 1e-6:
        factor = 1.0 / 12.0
    else:
        half = 0.5 * min(math.sqrt(square), NEAR_TURN)
        factor = (1.0 - half / math.tan(half)) / square
    return (
        along[0] + 0.5 * once[0] + factor * twice[0],
        along[1] + 0.5 * once[1] + factor * twice[1],
        along[2] + 0.5 * once[2] + factor * twice[2],
    )

"""What ties a frame to the one before it: velocities to preserve, and a limit of their change.

A joint that goes on from the frame before as the input does keeps the displacement that it had.
That is its course. Its distance from the course is what it changes its velocity by.
"""

import math
from typing import Any

import numpy as np

from usdmotion import Floats
from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import (
    Quaternion,
    Vector,
    interpolated,
    inverse,
    product,
    quaternion,
    quaternion_at,
    quaternion_in,
    rotation_vector,
    turned,
    unit,
    vector_at,
    vector_in,
)
from usdmotion_prioritized_ik.bounds import add_bound
from usdmotion_prioritized_ik.state import Work

A_WHILE = 0.1
"""The share of velocities is of a displacement after so many seconds, at any frame rate."""
CORNER = 1.0 / math.sqrt(3.0)
"""Half the edge of the cube in a ball of radius 1."""


def shares_of_velocity(times: Floats, share: float) -> Floats:
    """(F,) seconds to (F,): what is left on a frame of a displacement of the frame before."""
    shares = np.zeros(len(times))
    shares[1:] = share ** (np.diff(times) / A_WHILE)
    return shares


@shared
def set_course(work: Work, frame: int) -> None:
    """Write where each node goes on to, which on a first frame is where the input has it."""
    motion, pose, carried = work.motion[0], work.pose[0], work.carried[0]
    last = carried.valid.shape[0] - 1
    for node in range(pose.columns.shape[0]):
        turn = quaternion_in(motion.rotations, frame, node)
        if carried.valid[last]:
            turn = unit(product(turn, quaternion_in(carried.rotations, last, node)))
        for axis in range(4):
            pose.course_rotations[node, axis] = turn[axis]
        for axis in range(3):
            place = motion.translations[frame, node, axis]
            if carried.valid[last] and work.given[0].translates[node]:
                place += carried.translations[last, node, axis]
            pose.course_translations[node, axis] = place


@shared
def preferred_rotation(work: Work, frame: int, node: int) -> Quaternion:
    """Return how a joint is turned where nothing is asked of it (2003, section 4.2).

    It has the angle of the input, the velocity of the input, or is between them, where a
    displacement fades by the share that is asked for.
    """
    share = work.given[0].shares[frame]
    angle = quaternion_in(work.motion[0].rotations, frame, node)
    if share == 0.0:
        return angle
    return interpolated(angle, quaternion_at(work.pose[0].course_rotations, node), share)


@shared
def preferred_translation(work: Work, frame: int, node: int) -> Vector:
    """Return where a root is where nothing is asked of it."""
    share = work.given[0].shares[frame]
    place = vector_in(work.motion[0].translations, frame, node)
    if share == 0.0:
        return place
    course = vector_at(work.pose[0].course_translations, node)
    return (
        place[0] + share * (course[0] - place[0]),
        place[1] + share * (course[1] - place[1]),
        place[2] + share * (course[2] - place[2]),
    )


@shared
def bound_changes(work: Work, frame: int) -> None:
    """Add the bounds that keep every node near its course."""
    settings, given, pose = work.settings[0], work.given[0], work.pose[0]
    if not _is_limited(work, frame):
        return
    step = given.times[frame] - given.times[frame - 1]
    for node in range(pose.columns.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        parent = quaternion_at(pose.orientations, given.parents[node])
        if settings.change > 0.0:
            course = quaternion_at(pose.course_rotations, node)
            away = turned(product(parent, course), _turn_away(work, node))
            _bound_within(work, column, away, math.radians(settings.change) * step)
        if settings.root_change > 0.0 and given.translates[node]:
            away = turned(parent, _way_away(work, node))
            _bound_within(work, column + 3, away, settings.root_change * step)


@shared
def keep_on_course(work: Work, frame: int) -> None:
    """Bring back what has gone beyond a limit of change that stands above all ranks."""
    settings, given, pose = work.settings[0], work.given[0], work.pose[0]
    if settings.change_rank > 0 or not _is_limited(work, frame):
        return
    step = given.times[frame] - given.times[frame - 1]
    for node in range(pose.columns.shape[0]):
        if pose.columns[node] < 0:
            continue
        turn = _turn_away(work, node)
        most = math.radians(settings.change) * step
        if settings.change > 0.0 and _length(turn) > most:
            inside = quaternion(_shortened(turn, most))
            rotation = unit(product(quaternion_at(pose.course_rotations, node), inside))
            for axis in range(4):
                pose.rotations[node, axis] = rotation[axis]
        way, most = _way_away(work, node), settings.root_change * step
        if given.translates[node] and most > 0.0 and _length(way) > most:
            way = _shortened(way, most)
            for axis in range(3):
                pose.translations[node, axis] = pose.course_translations[node, axis] + way[axis]


@shared
def _is_limited(work: Work, frame: int) -> bool:
    settings, carried = work.settings[0], work.carried[0]
    limited = settings.change > 0.0 or settings.root_change > 0.0
    return bool(limited and frame > 0 and carried.valid[carried.valid.shape[0] - 1])


@shared
def _turn_away(work: Work, node: int) -> Vector:
    """Return the turn of a joint from its course, in the frame of the course [rad]."""
    pose = work.pose[0]
    back = inverse(quaternion_at(pose.course_rotations, node))
    return rotation_vector(product(back, quaternion_at(pose.rotations, node)))


@shared
def _way_away(work: Work, node: int) -> Vector:
    """Return the way of a root from its course, in its parent's frame [m]."""
    pose = work.pose[0]
    return (
        pose.translations[node, 0] - pose.course_translations[node, 0],
        pose.translations[node, 1] - pose.course_translations[node, 1],
        pose.translations[node, 2] - pose.course_translations[node, 2],
    )


@shared
def _bound_within(work: Work, column: int, away: Any, most: float) -> None:
    """Keep three columns in a ball: in a cube about its middle, farther out below its surface."""
    length = _length(away)
    level = min(work.settings[0].change_rank, work.carried[0].valid.shape[0]) - 1
    left = max(most - length, 0.0)
    if length > 0.5 * most:
        bound = add_bound(work.bounds, level, column, column + 3, -most - length, left)
        for axis in range(3):
            work.bounds[0].rows[bound, column + axis] = away[axis] / length
        return
    for axis in range(3):
        edge = CORNER * left
        bound = add_bound(work.bounds, level, column, column + 3, -edge, edge)
        for other in range(3):
            work.bounds[0].rows[bound, column + other] = 1.0 if axis == other else 0.0


@shared
def _length(vector: Any) -> float:
    square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
    return math.sqrt(square)


@shared
def _shortened(vector: Any, length: float) -> Vector:
    scale = length / _length(vector)
    return (scale * vector[0], scale * vector[1], scale * vector[2])

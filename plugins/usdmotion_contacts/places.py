"""Space contacts: where an object rests, place after place."""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Bools, Floats, Ints, NoisePattern, Search
from usdmotion.kernels import kernel, shared
from usdmotion.kernels.quaternions import quaternion_at, turned, vector_at
from usdmotion_contacts.displacements import Displacements
from usdmotion_contacts.merging import (
    APART,
    Groups,
    Tolerances,
    groups_of,
    merger,
    part,
    tolerances,
)


class _Places(NamedTuple):
    """Where the groups are: sums over their poses, shapes (group_count, …)."""

    sums: Floats
    """Of the world positions of the object's points, shape (group_count, point_count, 3)."""
    poses: Floats
    """How many poses that are."""
    near: Floats
    """How far a point may be from where it is held [m], shape (point_count,)."""


def places(
    search: Search, moves: Displacements, resting: Bools, pattern: NoisePattern
) -> tuple[Groups, Ints]:
    """Return the places at which an object rests, and the one that owns each frame, or −1.

    One place is where all points that stand for the object stay within dist_max of their mean so
    far, beyond what noise alone moves them. A rest that drifts farther, however slowly, is not one
    place: the next begins there.
    """
    count = int(np.count_nonzero(resting))
    groups, points = groups_of(count), weighed_points(search)
    near = search.merge_distance + _seeming(points, pattern)
    stats = _Places(np.zeros((count, len(points), 3)), np.zeros(count), near)
    owners = np.full(len(search.times), -1, dtype=np.int64)
    if count:
        poses = (search.translations, search.rotations, points)
        limits = tolerances(search, moves)
        _find(search.times, poses, resting, moves.last, limits, groups, stats, owners)
    return groups, owners


def weighed_points(search: Search) -> Floats:
    """Return the points by which two poses of an object are compared, its origin first.

    Of an object without size nobody knows how much its turns matter: it is given arms as long as
    d_max, which is about the size of a foot or a hand.
    """
    points = np.concatenate([np.zeros((1, 3)), search.points])
    if not np.allclose(points, 0.0, atol=1e-9):
        return points
    return np.concatenate([points[:1], search.gap_distance * np.eye(3)])


def _seeming(points: Floats, pattern: NoisePattern) -> Floats:
    """Return how far points that rest may seem to move [m], (P, 3) to (P,)."""
    sigma, epsilon = (np.median(each.values) for each in (pattern.sigma, pattern.epsilon))
    return np.asarray(epsilon + sigma * np.linalg.norm(points, axis=1))


@shared
def _placed(poses: tuple[Floats, Floats, Floats], frame: int, point: int) -> tuple[float, ...]:
    """Return where a point is, from where the object was at first: so far places are exact."""
    translations, rotations, points = poses
    way = turned(quaternion_at(rotations, frame), vector_at(points, point))
    return (
        translations[frame, 0] - translations[0, 0] + way[0],
        translations[frame, 1] - translations[0, 1] + way[1],
        translations[frame, 2] - translations[0, 2] + way[2],
    )


@shared
def _add(poses: tuple[Floats, Floats, Floats], stats: _Places, group: int, frame: int) -> None:
    """Count the pose of a frame in."""
    for point in range(stats.sums.shape[1]):
        place = _placed(poses, frame, point)
        for axis in range(3):
            stats.sums[group, point, axis] += place[axis]
    stats.poses[group] += 1.0


@shared
def _fits(
    poses: tuple[Floats, Floats, Floats], stats: _Places, group: int, first: int, last: int
) -> bool:
    """Return whether two poses are at the place of a group."""
    share = 1.0 / stats.poses[group]
    for frame in (first, last):
        for point in range(stats.sums.shape[1]):
            place = _placed(poses, frame, point)
            square = 0.0
            for axis in range(3):
                square += (place[axis] - share * stats.sums[group, point, axis]) ** 2
            if square > stats.near[point] ** 2:
                return False
    return True


@shared
def _distance(stats: _Places, groups: Groups, a: int, b: int) -> float:
    """Return how far the object's origin is from place to place, if no point of it is too far."""
    origin = 0.0
    for point in range(stats.sums.shape[1]):
        square = 0.0
        for axis in range(3):
            one = stats.sums[a, point, axis] / stats.poses[a]
            other = stats.sums[b, point, axis] / stats.poses[b]
            square += (one - other) ** 2
        if square > stats.near[point] ** 2:
            return APART
        if point == 0:
            origin = math.sqrt(square)
    return origin


@shared
def _join(stats: _Places, groups: Groups, a: int, b: int) -> None:
    """Make the sums of the first those of both."""
    for point in range(stats.sums.shape[1]):
        for axis in range(3):
            stats.sums[a, point, axis] += stats.sums[b, point, axis]
    stats.poses[a] += stats.poses[b]


_merge = merger(_distance, _join)


@kernel
def _find(
    times: Floats,
    poses: tuple[Floats, Floats, Floats],
    resting: Bools,
    last: Ints,
    limits: Tolerances,
    groups: Groups,
    stats: _Places,
    owners: Ints,
) -> None:
    """(F,), ((F, 3), (F, 4), (P, 3)), (D,), (D,) into groups and (F,)."""
    count = 0
    for i in range(last.shape[0]):
        if not resting[i]:
            continue
        same = count > 0 and i <= groups.end[count - 1]
        if not (same and _fits(poses, stats, count - 1, i, last[i])):
            groups.start[count] = i
            groups.into[count] = count
            count += 1
        group = count - 1
        _add(poses, stats, group, i)
        _add(poses, stats, group, last[i])
        groups.end[group] = last[i]
        owners[i] = group
        owners[last[i]] = group
    _merge(groups, count, times, limits, stats)
    part(groups, count, owners, times, 0.0)

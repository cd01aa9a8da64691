"""Line and point contacts: what an object turns about while a part of it stays."""

from typing import NamedTuple

import numpy as np

from usdmotion import Bools, Floats, Ints, NoisePattern, Search
from usdmotion.kernels import kernel, shared
from usdmotion_contacts.displacements import SLACK, Displacements
from usdmotion_contacts.merging import (
    APART,
    Groups,
    Tolerances,
    groups_of,
    merger,
    part,
    tolerances,
)
from usdmotion_contacts.stacking import (
    COLUMNS,
    LINE,
    NONE,
    POINT,
    Fit,
    gap,
    is_solved,
    room,
    shift,
    solve,
    stacks,
    tilt,
    veer,
)


class _Turns(NamedTuple):
    """What is known of the groups."""

    stacks: Floats
    """The stack of each, shape (group_count, COLUMNS)."""
    kinds: Ints
    """`LINE` or `POINT`, shape (group_count,)."""
    points: Floats
    """The point of each in the object's frame [m], shape (group_count, 3)."""
    axes: Floats
    """Its axis there, in the sense in which the object turns, shape (group_count, 3)."""
    poses: tuple[Floats, Floats]
    """World translations and rotations of the object."""
    fit: Fit
    near: float
    """dist_max [m]."""
    parallel: float
    """Sine of α_max."""
    meeting: bool
    """Whether lines that meet may be a point."""


class Turned(NamedTuple):
    """Lines and points that were found."""

    groups: Groups
    owners: Ints
    """The group that owns each frame, or −1, shape (frame_count,)."""
    kinds: Ints
    """`LINE` or `POINT`, shape (group_count,)."""
    points: Floats
    """The point of each in the object's frame [m], shape (group_count, 3)."""
    axes: Floats
    """Its axis there, shape (group_count, 3)."""


def turns(search: Search, moves: Displacements, turning: Bools, pattern: NoisePattern) -> Turned:
    """Return the lines and points that an object turns about.

    Instantaneous axes follow each other as one contact for as long as one line, or else one point,
    solves all of their equations within ε_max. Any smooth motion has an axis at every moment, so
    what lasts for less than two steps is none: nothing says that it stays. What is left is
    merged, and there dist_max and α_max say what is equal.

    Args:
        search: The motion.
        moves: Its displacements.
        turning: Which of them leave a line where it was, shape (displacement_count,).
        pattern: What of them is noise.
    """
    found = np.flatnonzero(turning)
    count = len(found)
    groups = groups_of(count)
    limits = tolerances(search, moves)
    known = _Turns(
        stacks=np.zeros((count, COLUMNS)),
        kinds=np.zeros(count, dtype=np.int64),
        points=np.zeros((count, 3)),
        axes=np.zeros((count, 3)),
        poses=(search.translations, search.rotations),
        fit=room(search.points.mean(axis=0)),
        near=limits.near,
        parallel=limits.parallel,
        meeting="point" in search.kinds,
    )
    owners = np.full(len(search.times), -1, dtype=np.int64)
    if count:
        each = stacks(moves, pattern)[found]
        shortest = 2.0 * moves.step - SLACK
        _find(search.times, each, found, moves.last[found], limits, shortest, groups, known, owners)
    return Turned(groups, owners, known.kinds, known.points, known.axes)


@shared
def _grow(known: _Turns, group: int, stack: Floats, start: int, end: int) -> bool:
    """Add a displacement to a group if the equations of all are solved within ε_max."""
    fit = known.fit
    for column in range(COLUMNS):
        fit.stack[column] = known.stacks[group, column] + stack[column]
    solve(fit)
    kind = NONE
    if (
        tilt(fit.stack, fit.vectors) <= known.parallel
        and is_solved(fit.stack, fit.line)
        and shift(known.poses, fit.line, start, end) <= known.near
    ):
        kind = LINE
    elif (
        known.meeting
        and is_solved(fit.stack, fit.point)
        and shift(known.poses, fit.point, start, end) <= known.near
    ):
        kind = POINT
    if kind != NONE:
        _keep(known, group, kind)
    return kind != NONE


@shared
def _keep(known: _Turns, group: int, kind: int) -> None:
    """Make a fit that of a group."""
    fit = known.fit
    known.kinds[group] = kind
    for column in range(COLUMNS):
        known.stacks[group, column] = fit.stack[column]
    for i in range(3):
        known.points[group, i] = fit.line[i] if kind == LINE else fit.point[i]
        known.axes[group, i] = fit.vectors[i, 0]


@shared
def _joined(known: _Turns, groups: Groups, a: int, b: int) -> tuple[int, float]:
    """Return what two groups are together, and how far what they hold moves between them [m].

    A line if theirs differ by α_max and dist_max at most, in the object and in the world; else a
    point if theirs pass it within dist_max, and it stays.
    """
    fit, one, other = known.fit, known.stacks[a], known.stacks[b]
    for column in range(COLUMNS):
        fit.stack[column] = one[column] + other[column]
    solve(fit)
    before, after = groups.end[a], groups.start[b]
    far = shift(known.poses, fit.line, before, after)
    if (
        far <= known.near
        and tilt(one, fit.vectors) + tilt(other, fit.vectors) <= known.parallel
        and gap(one, fit.line) + gap(other, fit.line) <= known.near
        and veer(known.poses, fit.vectors, before, after) <= known.parallel
    ):
        return LINE, far
    far = shift(known.poses, fit.point, before, after)
    if (
        known.meeting
        and far <= known.near
        and gap(one, fit.point) + gap(other, fit.point) <= known.near
    ):
        return POINT, far
    return NONE, APART


@shared
def _distance(known: _Turns, groups: Groups, a: int, b: int) -> float:
    """Return how far what two groups hold moves between them."""
    return float(_joined(known, groups, a, b)[1])


@shared
def _join(known: _Turns, groups: Groups, a: int, b: int) -> None:
    """Make the first group both."""
    _keep(known, a, _joined(known, groups, a, b)[0])


_merge = merger(_distance, _join)


@kernel
def _find(
    times: Floats,
    each: Floats,
    first: Ints,
    last: Ints,
    limits: Tolerances,
    shortest: float,
    groups: Groups,
    known: _Turns,
    owners: Ints,
) -> None:
    """(F,), (D, COLUMNS), (D,), (D,) into groups and (F,)."""
    count = 0
    for i in range(first.shape[0]):
        connected = count > 0 and first[i] <= groups.end[count - 1]
        if not (connected and _grow(known, count - 1, each[i], groups.start[count - 1], last[i])):
            groups.start[count] = first[i]
            groups.into[count] = count
            count += 1
            _grow(known, count - 1, each[i], first[i], last[i])
        groups.end[count - 1] = last[i]
        owners[first[i]] = count - 1
        owners[last[i]] = count - 1
    for group in range(count):
        if times[groups.end[group]] - times[groups.start[group]] < shortest:
            groups.into[group] = -1
    _merge(groups, count, times, limits, known)
    part(groups, count, owners, times, shortest)

"""Contacts that are one, found in pieces (2006, section 7)."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple, cast

import numpy as np

from usdmotion import Floats, Ints, Search
from usdmotion.kernels import shared
from usdmotion_contacts.displacements import SLACK, Displacements
from usdmotion_contacts.tolerance import frame_tolerance

APART = math.inf
"""The distance between contacts that are no one place, line or point."""


Distance = Callable[[Any, "Groups", int, int], float]
Join = Callable[[Any, "Groups", int, int], None]


class Tolerances(NamedTuple):
    """What may lie between two contacts that are one."""

    interval: float
    """Usual time between two samples [s]."""
    frames: int
    """F_max."""
    farthest: float
    """d_max [m]."""
    near: float
    """dist_max [m]."""
    parallel: float
    """Sine of α_max."""


class Groups(NamedTuple):
    """Displacements that were found to be one contact, in the order of their times."""

    start: Ints
    """First frame of each, shape (group_count,)."""
    end: Ints
    """Last frame of each."""
    into: Ints
    """Which group each has become part of: itself, another one, or −1 if it is dropped."""


def tolerances(search: Search, moves: Displacements) -> Tolerances:
    """Return what a search allows, with times in frames."""
    interval = moves.interval or 1.0
    frames = math.floor(search.gap / interval + SLACK)
    sine = math.sin(math.radians(min(search.parallel_angle, 90.0)))
    return Tolerances(interval, frames, search.gap_distance, search.merge_distance, sine)


def groups_of(count: int) -> Groups:
    """Return room for so many groups."""
    return Groups(*(np.zeros(count, dtype=np.int64) for _ in Groups._fields))


def merger(distance: Distance, join: Join) -> Callable[..., None]:
    """Return what merges groups of one sort, for use inside a kernel.

    Args:
        distance: Of stats, all groups and two of them, how far these two are apart; `APART` if
            they do not meet.
        join: Of the same, makes what is known of the first that of both.
    """
    earlier = _finder(distance)

    @shared
    def merge(groups: Groups, count: int, times: Floats, limits: Tolerances, stats: Any) -> None:
        """Merge groups for as long as two of them are one: that leaves the fewest."""
        merged = True
        while merged:
            merged = False
            for b in range(count):
                if groups.into[b] != b:
                    continue
                a = earlier(groups, b, times, limits, stats)
                if a < 0:
                    continue
                join(stats, groups, a, b)
                groups.end[a] = max(groups.end[a], groups.end[b])
                groups.into[b] = a
                for between in range(a + 1, b):
                    if groups.into[between] == between:
                        groups.into[between] = -1
                merged = True

    return cast(Callable[..., None], merge)


def _finder(distance: Distance) -> Callable[..., int]:
    """Return what finds the group that another one goes on with."""

    @shared
    def earlier(groups: Groups, b: int, times: Floats, limits: Tolerances, stats: Any) -> int:
        """Return the latest group before b that is one with it, −1 if there is none.

        What was found between the two is no contact but an outlier if it lasts less than either.
        """
        between = 0.0
        for a in range(b - 1, -1, -1):
            if groups.into[a] != a:
                continue
            frames = (times[groups.start[b]] - times[groups.end[a]]) / limits.interval
            if frames > limits.frames + SLACK:
                return -1
            shorter = min(_length(groups, a, times), _length(groups, b, times))
            if between == 0.0 or between < shorter:
                far = distance(stats, groups, a, b)
                bridged = frame_tolerance(far, limits.frames, limits.farthest)
                if far < APART and frames <= bridged + SLACK:
                    return a
            between += _length(groups, a, times)
        return -1

    return cast(Callable[..., int], earlier)


def left_of(groups: Groups) -> Ints:
    """Return the indices of the groups that are contacts of their own."""
    return np.flatnonzero(groups.into == np.arange(len(groups.into)))


@shared
def _length(groups: Groups, group: int, times: Floats) -> float:
    """Return how long a group lasts [s]."""
    length: float = times[groups.end[group]] - times[groups.start[group]]
    return length


@shared
def root(groups: Groups, group: int) -> int:
    """Return what a group has become part of in the end, −1 if it is dropped."""
    while group >= 0 and groups.into[group] != group:
        group = groups.into[group]
    return group


@shared
def part(groups: Groups, count: int, owners: Ints, times: Floats, shortest: float) -> None:
    """Give each frame to one group, and drop those that are left with no interval or a short one.

    Args:
        groups: Merged groups; each is made to begin after the end of the one before it.
        count: How many there are; room for more is marked as dropped.
        owners: The group of each frame, which becomes the one that it is part of, or −1.
        times: Of each frame [s].
        shortest: Least length of a group [s].
    """
    for frame in range(owners.shape[0]):
        owners[frame] = root(groups, owners[frame])
    end = -1
    for group in range(count):
        if groups.into[group] != group:
            continue
        start = max(groups.start[group], end + 1)
        while start < groups.end[group] and owners[start] != group:
            start += 1
        groups.start[group] = start
        if start >= groups.end[group] or _length(groups, group, times) < shortest:
            groups.into[group] = -1
        else:
            end = groups.end[group]
    for group in range(count, groups.into.shape[0]):
        groups.into[group] = -1

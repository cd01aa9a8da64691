"""How far a step may go: bounds on rows of it, and directions in which it may not go at all."""

import math
from typing import Any, NamedTuple

import numpy as np

from usdmotion import Floats, Ints
from usdmotion.kernels import Reference, shared

CROSSED = 1e-10
"""A bound is crossed by more than this [m or rad]."""
SHORT = 1e-6
"""A direction of which less than this is left cannot be moved along."""


class Bounds(NamedTuple):
    """The bounds near a pose, B at most, over C columns: low ≤ row · step ≤ high."""

    rows: Floats
    """(B, C) unit rows."""
    first: Ints
    """(B,) a row is zero before this column …"""
    last: Ints
    """(B,) … and from this one on."""
    low: Floats
    """(B,) at most 0, as a pose obeys its bounds."""
    high: Floats
    """(B,) at least 0."""
    level: Ints
    """(B,) the levels below this one obey it: -1 where all do."""
    size: Ints
    """(1,) how many there are."""
    barred: Floats
    """(B, 3) orthonormal directions of no movement at all: three columns each."""
    barred_column: Ints
    """(B,) the first of those columns."""
    barred_size: Ints
    """(1,) how many there are."""


def make_bounds(bound_count: int, column_count: int) -> Bounds:
    """Return room for so many bounds over so many columns."""

    def integers(count: int) -> Ints:
        return np.zeros(count, dtype=np.int64)

    return Bounds(
        rows=np.zeros((bound_count, column_count)),
        first=integers(bound_count),
        last=integers(bound_count),
        low=np.zeros(bound_count),
        high=np.zeros(bound_count),
        level=integers(bound_count),
        size=integers(1),
        barred=np.zeros((bound_count, 3)),
        barred_column=integers(bound_count),
        barred_size=integers(1),
    )


@shared
def open_bounds(bounded: Reference[Bounds]) -> None:
    """Forget the bounds of another pose."""
    bounds = bounded[0]
    bounds.size[0], bounds.barred_size[0] = 0, 0


@shared
def add_bound(
    bounded: Reference[Bounds], level: int, first: int, last: int, low: float, high: float
) -> int:
    """Add a bound, whose row is to be written; return where.

    Args:
        bounded: All of them.
        level: Levels below this one obey it.
        first: First column of its row.
        last: The column after its last.
        low: What the row times the step may be at least.
        high: What it may be at most.
    """
    bounds = bounded[0]
    index = bounds.size[0]
    bounds.size[0] = index + 1
    bounds.first[index], bounds.last[index] = first, last
    bounds.low[index], bounds.high[index] = low, high
    bounds.level[index] = level
    return int(index)


@shared
def bar(bounded: Reference[Bounds], column: int, direction: Any) -> None:
    """Allow no movement along a unit direction of three columns."""
    bounds = bounded[0]
    index = bounds.barred_size[0]
    x, y, z = direction
    for other in range(index):
        if bounds.barred_column[other] == column:
            barred = bounds.barred[other]
            along = x * barred[0] + y * barred[1] + z * barred[2]
            x, y, z = x - along * barred[0], y - along * barred[1], z - along * barred[2]
    length = math.sqrt(x * x + y * y + z * z)
    if length > SHORT:
        barred = bounds.barred[index]
        barred[0], barred[1], barred[2] = x / length, y / length, z / length
        bounds.barred_column[index] = column
        bounds.barred_size[0] = index + 1


@shared
def along_bound(bounded: Reference[Bounds], index: int, vector: Floats) -> float:
    """Return the row of a bound times a vector."""
    bounds = bounded[0]
    total = 0.0
    for column in range(bounds.first[index], bounds.last[index]):
        total += bounds.rows[index, column] * vector[column]
    return total


@shared
def room(bounded: Reference[Bounds], step: Floats, more: Floats, most: float) -> float:
    """Return how often something can be added to a step before it crosses a bound, or `most`."""
    bounds = bounded[0]
    for index in range(bounds.size[0]):
        done, along = along_bound(bounded, index, step), along_bound(bounded, index, more)
        if along > CROSSED:
            most = min(most, max(bounds.high[index] - done, 0.0) / along)
        elif along < -CROSSED:
            most = min(most, min(bounds.low[index] - done, 0.0) / along)
    return most

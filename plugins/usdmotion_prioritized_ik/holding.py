"""The bounds that hold a level back, an active set.

A level's step is found without bounds first. The bound that it would cross most then becomes an
equality, the step is found again, and so on until it crosses none; a bound from which the level
would go away by itself is let go (the order of Goldfarb & Idnani 1983). What holds a level back
does not hold those above it, which have moved already (Kanoun, Lamiraux & Wieber 2011): a joint
that a low level pushes against its limit stays free for the high ones.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Bools, Floats, Ints
from usdmotion.kernels import Reference, shared
from usdmotion_prioritized_ik.bounds import CROSSED, SHORT, Bounds, along_bound
from usdmotion_prioritized_ik.rows import dot, remove


class Holding(NamedTuple):
    """What holds the level that moves at present: some of B bounds, over C columns."""

    taken: Bools
    """(B,) which ones hold it, or cannot."""
    held: Ints
    """(B,) those that hold it, in the order in which they were crossed."""
    size: Ints
    """(1,) how many they are."""
    side: Floats
    """(B,) for each of those: 1 where it is held at high, -1 at low."""
    ways: Floats
    """(B, C) for each of those: its row, without what would disturb the levels above."""
    basis: Floats
    """(B, C) orthonormal directions of those rows, one after the other."""
    factor: Floats
    """(B, B) the rows in terms of these directions, one direction a line."""
    moved: Floats
    """(B,) how far the level goes along each direction, so that it comes up to the bounds."""
    push: Floats
    """(B,) how much it gains by going on along each."""


def make_holding(bound_count: int, column_count: int) -> Holding:
    """Return room for so many bounds over so many columns."""
    return Holding(
        taken=np.zeros(bound_count, dtype=np.bool_),
        held=np.zeros(bound_count, dtype=np.int64),
        size=np.zeros(1, dtype=np.int64),
        side=np.zeros(bound_count),
        ways=np.zeros((bound_count, column_count)),
        basis=np.zeros((bound_count, column_count)),
        factor=np.zeros((bound_count, bound_count)),
        moved=np.zeros(bound_count),
        push=np.zeros(bound_count),
    )


@shared
def most_crossed(
    bounded: Reference[Bounds], taken: Bools, level: int, step: Floats, trial: Floats
) -> int:
    """Return the bound that step + trial would cross most, -1 where they cross none."""
    bounds = bounded[0]
    most, found = CROSSED, -1
    for index in range(bounds.size[0]):
        if taken[index] or bounds.level[index] >= level:
            continue
        along = along_bound(bounded, index, step) + along_bound(bounded, index, trial)
        beyond = max(along - bounds.high[index], bounds.low[index] - along)
        if beyond > most:
            most, found = beyond, index
    return found


@shared
def let_go(holder: Reference[Holding]) -> bool:
    """Let go the bound from which the level most wants to go away; return whether there is one.

    The multipliers μ of what holds it have to be positive: push = Σ μ · side · way.
    """
    holding = holder[0]
    count = holding.size[0]
    found, least, largest = count, 0.0, 0.0
    for place in range(count - 1, -1, -1):
        largest = max(largest, abs(holding.push[place]))
        for later in range(place + 1, count):
            holding.push[place] -= holding.factor[place, later] * holding.push[later]
        holding.push[place] /= holding.factor[place, place]
        multiplier = holding.side[place] * holding.push[place]
        if multiplier < least:
            found, least = place, multiplier
    if least >= -1e-9 * largest:
        return False
    holding.taken[holding.held[found]] = False
    for place in range(found + 1, count):
        holding.held[place - 1] = holding.held[place]
        holding.side[place - 1] = holding.side[place]
        for column in range(holding.ways.shape[1]):
            holding.ways[place - 1, column] = holding.ways[place, column]
    holding.size[0] = count - 1
    return True


@shared
def find_directions(bounded: Reference[Bounds], holder: Reference[Holding], step: Floats) -> None:
    """Find in which directions bounds hold a level, and how far along each the bounds are.

    A bound along which the level cannot move, for others or the levels above, does not hold it.
    """
    bounds, holding = bounded[0], holder[0]
    width, count = step.shape[0], 0
    for place in range(holding.size[0]):
        index, side = holding.held[place], holding.side[place]
        direction = holding.basis[count]
        for column in range(width):
            direction[column] = holding.ways[place, column]
        limit = bounds.high[index] if side > 0.0 else bounds.low[index]
        left = limit - along_bound(bounded, index, step)
        for other in range(count):
            holding.factor[other, count] = remove(direction, holding.basis[other], width)
            left -= holding.factor[other, count] * holding.moved[other]
        length = math.sqrt(dot(direction, direction, width))
        if length <= SHORT:
            continue
        holding.factor[count, count] = length
        holding.moved[count] = left / length
        holding.held[count], holding.side[count] = index, side
        for column in range(width):
            direction[column] /= length
            holding.ways[count, column] = holding.ways[place, column]
        count += 1
    holding.size[0] = count

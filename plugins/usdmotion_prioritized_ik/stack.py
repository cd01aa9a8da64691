"""One step of a stack of levels: each moves only where no level above it is disturbed.

2004, section 3.2, with two changes. The projector is never formed: an orthonormal basis of the
rows used so far takes its place. And only the inverse that moves is damped; the one that projects
decides by rank, so that nothing of a lower level leaks into a higher one.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Floats, Ints
from usdmotion.kernels import Reference, shared, summing


class Stack(NamedTuple):
    """The linearized levels of one iteration, R rows over C columns at most."""

    rows: Floats
    """(R, C) weighted Jacobian rows, level by level; consumed by `descend`."""
    errors: Floats
    """(R,) weighted errors; consumed by `descend`."""
    first_row: Ints
    """(L + 1,) the rows of level l are first_row[l] to first_row[l + 1]."""
    widths: Ints
    """(L,) the columns that the first levels move: the rows of level l end at widths[l]."""
    basis: Floats
    """(R, C) orthonormal rows that span the projected rows of level l, from first_row[l] on."""
    ranks: Ints
    """(L,) how many they are."""
    factor: Floats
    """(R, R) scratch: the projected rows of a level in terms of its basis, one basis row a line."""
    normal: Floats
    """(R, R) scratch: damped normal equations of a level, their diagonal inverted."""
    inner: Floats
    """(R,) scratch: what a level moves along its basis rows."""
    norms: Floats
    """(R,) scratch: squared lengths of projected rows."""
    step: Floats
    """(C,) the step."""
    before: Floats
    """(C,) the whole step of the iteration before, posture included."""


def make_stack(row_count: int, column_count: int, level_count: int) -> Stack:
    """Return a stack with room for so many rows, columns and levels."""
    square = (row_count, row_count)
    wide = (row_count, column_count)
    return Stack(
        rows=np.zeros(wide),
        errors=np.zeros(row_count),
        first_row=np.zeros(level_count + 1, dtype=np.int64),
        widths=np.zeros(level_count, dtype=np.int64),
        basis=np.zeros(wide),
        ranks=np.zeros(level_count, dtype=np.int64),
        factor=np.zeros(square),
        normal=np.zeros(square),
        inner=np.zeros(row_count),
        norms=np.zeros(row_count),
        step=np.zeros(column_count),
        before=np.zeros(column_count),
    )


@shared
def descend(
    stacked: Reference[Stack], levels: int, damping: float, curvature: float, rank: float
) -> None:
    """Write the step of the first levels.

    Args:
        stacked: Its rows and errors are consumed.
        levels: How many levels take part.
        damping: Smallest damping λ₀ [m].
        curvature: What the squared damping grows by, per metre of error [m].
        rank: Shortest projected row that counts as independent [m].
    """
    stack = stacked[0]
    for column in range(stack.step.shape[0]):
        stack.step[column] = 0.0
    for level in range(levels):
        error = _subtract_done(stacked, level)
        _orthogonalize(stacked, level, rank)
        _solve(stacked, level, damping * damping + curvature * error)
        first = stack.first_row[level]
        for index in range(stack.ranks[level]):
            add(stack.step, stack.basis[first + index], stack.inner[index], stack.widths[level])


@shared
def remove_spanned(stacked: Reference[Stack], levels: int, vector: Floats) -> None:
    """Take from a vector all that would disturb the first levels: v ← N v."""
    stack = stacked[0]
    for level in range(levels):
        first = stack.first_row[level]
        for index in range(first, first + stack.ranks[level]):
            remove(vector, stack.basis[index], stack.widths[level])


@shared
def _subtract_done(stacked: Reference[Stack], level: int) -> float:
    """e_i − J_i Δ_{i−1} and J_i N_{i−1}, in place; return the length of the error."""
    stack = stacked[0]
    width = stack.widths[level]
    square = 0.0
    for row in range(stack.first_row[level], stack.first_row[level + 1]):
        if level > 0:
            stack.errors[row] -= dot(stack.rows[row], stack.step, width)
            remove_spanned(stacked, level, stack.rows[row])
        square += stack.errors[row] * stack.errors[row]
        stack.norms[row] = dot(stack.rows[row], stack.rows[row], width)
    return math.sqrt(square)


@shared
def _orthogonalize(stacked: Reference[Stack], level: int, rank: float) -> None:
    """Find a basis of the level's rows, longest first; dependent ones are dropped."""
    stack = stacked[0]
    first, last, width = stack.first_row[level], stack.first_row[level + 1], stack.widths[level]
    stack.ranks[level] = 0
    for fresh in range(last - first):
        longest = first
        for row in range(first + 1, last):
            if stack.norms[row] > stack.norms[longest]:
                longest = row
        length = math.sqrt(dot(stack.rows[longest], stack.rows[longest], width))
        if length <= rank:
            break
        stack.ranks[level] += 1
        for column in range(width):
            stack.basis[first + fresh, column] = stack.rows[longest, column] / length
        for row in range(first, last):
            along = 0.0
            if row == longest:
                along = length
                stack.norms[row] = -1.0
            elif stack.norms[row] >= 0.0:
                along = remove(stack.rows[row], stack.basis[first + fresh], width)
                stack.norms[row] = max(stack.norms[row] - along * along, 0.0)
            stack.factor[fresh, row - first] = along


@shared
def _solve(stacked: Reference[Stack], level: int, squared_damping: float) -> None:
    """Solve min ‖Lᵀ w − e‖² + λ²‖w‖² by Cholesky; L is the factor."""
    stack = stacked[0]
    factor, normal, inner = stack.factor, stack.normal, stack.inner
    first, count = stack.first_row[level], stack.first_row[level + 1] - stack.first_row[level]
    rank = stack.ranks[level]
    for i in range(rank):
        for j in range(i):
            entry = dot(factor[i], factor[j], count) - dot(normal[i], normal[j], j)
            normal[i, j] = entry * normal[j, j]
        square = dot(factor[i], factor[i], count) - dot(normal[i], normal[i], i)
        normal[i, i] = 1.0 / math.sqrt(square + squared_damping)
        along = dot(factor[i], stack.errors[first:], count)
        inner[i] = (along - dot(normal[i], inner, i)) * normal[i, i]
    for i in range(rank - 1, -1, -1):
        for k in range(i + 1, rank):
            inner[i] -= normal[k, i] * inner[k]
        inner[i] *= normal[i, i]


@summing
def dot(a: Floats, b: Floats, count: int) -> float:
    """(C,), (C,) to the product of the first so many."""
    total = 0.0
    for index in range(count):
        total += a[index] * b[index]
    return total


@summing
def remove(vector: Floats, direction: Floats, count: int) -> float:
    """(C,), (C,): take from a vector what lies along a unit direction; return how much it was."""
    along = dot(vector, direction, count)
    for index in range(count):
        vector[index] -= along * direction[index]
    return along


@summing
def add(vector: Floats, other: Floats, factor: float, count: int) -> None:
    """(C,), (C,): add a multiple of a vector to another."""
    for index in range(count):
        vector[index] += factor * other[index]

"""The linearized levels of one iteration, and the solution of each by itself.

2004, section 3.2, with two changes. The projector is never formed: an orthonormal basis of the
rows used so far takes its place. And only the inverse that moves is damped; the one that projects
decides by rank, so that nothing of a lower level leaks into a higher one.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Floats, Ints
from usdmotion.kernels import Reference, shared
from usdmotion_prioritized_ik.bounds import Bounds
from usdmotion_prioritized_ik.rows import add, dot, remove


class Stack(NamedTuple):
    """The levels of one iteration: R rows over C columns at most, L levels, B bounds."""

    rows: Floats
    """(R, C) weighted Jacobian rows, level by level; consumed by the descent."""
    errors: Floats
    """(R,) weighted errors; consumed by the descent."""
    first_row: Ints
    """(L + 1,) the rows of level l are first_row[l] to first_row[l + 1]."""
    widths: Ints
    """(L,) the columns that the first levels move: the rows of level l end at widths[l]."""
    basis: Floats
    """(R + B, C) orthonormal rows: the projected rows of every level, and what holds it back."""
    spans: Ints
    """(L + 1,) those of level l are spans[l] to spans[l + 1]."""
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
    pull: Floats
    """(C,) what the posture adds to it: at first all that it would like, 2004's z."""
    trial: Floats
    """(C,) scratch: what one level would add to it."""
    plain: Floats
    """(R, C) scratch: the projected rows of a level that bounds hold back."""
    asked: Floats
    """(R,) scratch: its errors."""
    before: Floats
    """(C,) the whole step of the iteration before, posture included."""


def make_stack(row_count: int, column_count: int, level_count: int, bound_count: int) -> Stack:
    """Return a stack with room for so many rows, columns, levels and bounds."""
    square = (row_count, row_count)
    wide = (row_count, column_count)
    return Stack(
        rows=np.zeros(wide),
        errors=np.zeros(row_count),
        first_row=np.zeros(level_count + 1, dtype=np.int64),
        widths=np.zeros(level_count, dtype=np.int64),
        basis=np.zeros((row_count + bound_count, column_count)),
        spans=np.zeros(level_count + 1, dtype=np.int64),
        factor=np.zeros(square),
        normal=np.zeros(square),
        inner=np.zeros(row_count),
        norms=np.zeros(row_count),
        step=np.zeros(column_count),
        pull=np.zeros(column_count),
        trial=np.zeros(column_count),
        plain=np.zeros(wide),
        asked=np.zeros(row_count),
        before=np.zeros(column_count),
    )


@shared
def subtract_done(stacked: Reference[Stack], bounded: Reference[Bounds], level: int) -> float:
    """e_i − J_i Δ_{i−1} and J_i N_{i−1}, in place; return the length of the error."""
    stack = stacked[0]
    width = stack.widths[level]
    square = 0.0
    for row in range(stack.first_row[level], stack.first_row[level + 1]):
        if level > 0:
            stack.errors[row] -= dot(stack.rows[row], stack.step, width)
        remove_spanned(stacked, bounded, level, stack.rows[row])
        square += stack.errors[row] * stack.errors[row]
    return math.sqrt(square)


@shared
def remove_spanned(
    stacked: Reference[Stack], bounded: Reference[Bounds], levels: int, vector: Floats
) -> None:
    """Take from a vector all that would disturb the first levels: v ← N v."""
    stack, bounds = stacked[0], bounded[0]
    for index in range(bounds.barred_size[0]):
        column, barred = bounds.barred_column[index], bounds.barred[index]
        along = 0.0
        for axis in range(3):
            along += vector[column + axis] * barred[axis]
        for axis in range(3):
            vector[column + axis] -= along * barred[axis]
    for level in range(levels):
        for index in range(stack.spans[level], stack.spans[level + 1]):
            remove(vector, stack.basis[index], stack.widths[level])


@shared
def orthogonalize(stacked: Reference[Stack], level: int, start: int, rank: float) -> int:
    """Find a basis of the level's rows, longest first; dependent ones are dropped.

    Returns:
        Where it ends; it begins at `start`.
    """
    stack = stacked[0]
    first, last, width = stack.first_row[level], stack.first_row[level + 1], stack.widths[level]
    for row in range(first, last):
        stack.norms[row] = dot(stack.rows[row], stack.rows[row], width)
    for found in range(last - first):
        longest = first
        for row in range(first + 1, last):
            if stack.norms[row] > stack.norms[longest]:
                longest = row
        length = math.sqrt(dot(stack.rows[longest], stack.rows[longest], width))
        if length <= rank:
            return int(start + found)
        direction = stack.basis[start + found]
        for column in range(width):
            direction[column] = stack.rows[longest, column] / length
        for row in range(first, last):
            along = 0.0
            if row == longest:
                along = length
                stack.norms[row] = -1.0
            elif stack.norms[row] >= 0.0:
                along = remove(stack.rows[row], direction, width)
                stack.norms[row] = max(stack.norms[row] - along * along, 0.0)
            stack.factor[found, row - first] = along
    return int(start + last - first)


@shared
def solve(stacked: Reference[Stack], level: int, start: int, squared_damping: float) -> None:
    """Solve min ‖Lᵀ w − e‖² + λ²‖w‖² by Cholesky; L is the factor."""
    stack = stacked[0]
    factor, normal, inner = stack.factor, stack.normal, stack.inner
    first, count = stack.first_row[level], stack.first_row[level + 1] - stack.first_row[level]
    rank = stack.spans[level + 1] - start
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


@shared
def unfold(stacked: Reference[Stack], level: int, start: int, vector: Floats) -> None:
    """Add to a vector what a level moves along the rows of its basis from `start` on."""
    stack = stacked[0]
    for index in range(start, stack.spans[level + 1]):
        add(vector, stack.basis[index], stack.inner[index - start], stack.widths[level])


@shared
def clear(vector: Floats) -> None:
    """(C,): make it zero."""
    for column in range(vector.shape[0]):
        vector[column] = 0.0

"""One step of a stack of levels: each moves only where no level above it is disturbed.

2004, section 3.2, with two changes. The projector is never formed: an orthonormal basis of the
rows used so far takes its place. And only the inverse that moves is damped; the one that projects
decides by rank, so that nothing of a lower level leaks into a higher one.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion.arrays import Floats, Ints
from usdmotion.kernels import inlined


class Stack(NamedTuple):
    """The linearized levels of one iteration, R rows over C columns at most."""

    rows: Floats
    """(R, C) weighted Jacobian rows, level by level; consumed by `descend`."""
    errors: Floats
    """(R,) weighted errors."""
    first_row: Ints
    """(L + 1,) the rows of level l are first_row[l] to first_row[l + 1]."""
    basis: Floats
    """(R, C) orthonormal rows that span all levels so far."""
    factor: Floats
    """(R, R) scratch: the projected rows of a level in terms of its new basis rows."""
    normal: Floats
    """(R, R) scratch: damped normal equations of a level."""
    inner: Floats
    """(R,) scratch: what a level moves along its basis rows."""
    norms: Floats
    """(R,) scratch: squared lengths of projected rows."""
    step: Floats
    """(C,) the step."""


def make_stack(row_count: int, column_count: int, level_count: int) -> Stack:
    """Return a stack with room for so many rows, columns and levels."""
    square = (row_count, row_count)
    wide = (row_count, column_count)
    return Stack(
        rows=np.zeros(wide),
        errors=np.zeros(row_count),
        first_row=np.zeros(level_count + 1, dtype=np.int64),
        basis=np.zeros(wide),
        factor=np.zeros(square),
        normal=np.zeros(square),
        inner=np.zeros(row_count),
        norms=np.zeros(row_count),
        step=np.zeros(column_count),
    )


@inlined
def descend(
    stack: Stack, level_count: int, columns: int, damping: float, curvature: float, rank: float
) -> int:
    """Write the step of the first levels; return how many basis rows they span.

    Args:
        stack: Its rows and errors are consumed.
        level_count: How many levels take part.
        columns: How many columns are used.
        damping: Smallest damping λ₀ [m].
        curvature: What the squared damping grows by, per metre of error [m].
        rank: Shortest projected row that counts as independent [m].
    """
    for column in range(columns):
        stack.step[column] = 0.0
    used = 0
    for level in range(level_count):
        first, last = stack.first_row[level], stack.first_row[level + 1]
        if first == last:
            continue
        square = _subtract_done(stack, first, last, used, columns)
        fresh = _orthogonalize(stack, first, last, used, columns, rank)
        _solve(stack, first, last, fresh, damping * damping + curvature * math.sqrt(square))
        for index in range(fresh):
            _add(stack.step, stack.basis[used + index], stack.inner[index], columns)
        used += fresh
    return used


@inlined
def remove_spanned(stack: Stack, used: int, vector: Floats, columns: int) -> None:
    """Take from a vector all that would disturb the levels: v ← N v."""
    for index in range(used):
        along = _dot(stack.basis[index], vector, columns)
        _add(vector, stack.basis[index], -along, columns)


@inlined
def _subtract_done(stack: Stack, first: int, last: int, used: int, columns: int) -> float:
    """e_i − J_i Δ_{i−1} and J_i N_{i−1}, in place; return the squared error."""
    square = 0.0
    for row in range(first, last):
        line = stack.rows[row]
        if used > 0:
            stack.errors[row] -= _dot(line, stack.step, columns)
            remove_spanned(stack, used, line, columns)
        square += stack.errors[row] * stack.errors[row]
        stack.norms[row] = _dot(line, line, columns)
    return square


@inlined
def _orthogonalize(
    stack: Stack, first: int, last: int, used: int, columns: int, rank: float
) -> int:
    """Extend the basis by the level's rows, longest first; dependent ones are dropped."""
    fresh = 0
    for row in range(last - first):
        for index in range(last - first):
            stack.factor[row, index] = 0.0
    for _ in range(last - first):
        longest = first
        for row in range(first + 1, last):
            if stack.norms[row] > stack.norms[longest]:
                longest = row
        line = stack.rows[longest]
        length = math.sqrt(_dot(line, line, columns))
        if length <= rank:
            break
        direction = stack.basis[used + fresh]
        for column in range(columns):
            direction[column] = line[column] / length
        stack.factor[longest - first, fresh] = length
        stack.norms[longest] = -1.0
        for row in range(first, last):
            if stack.norms[row] < 0.0:
                continue
            along = _dot(stack.rows[row], direction, columns)
            _add(stack.rows[row], direction, -along, columns)
            stack.factor[row - first, fresh] = along
            stack.norms[row] = max(stack.norms[row] - along * along, 0.0)
        fresh += 1
    return fresh


@inlined
def _solve(stack: Stack, first: int, last: int, fresh: int, squared_damping: float) -> None:
    """Solve min ‖L w − e‖² + λ²‖w‖² by Cholesky; L are the projected rows in the new basis."""
    factor, normal, inner = stack.factor, stack.normal, stack.inner
    for i in range(fresh):
        total = 0.0
        for row in range(last - first):
            total += factor[row, i] * stack.errors[first + row]
        inner[i] = total
        for j in range(i + 1):
            entry = squared_damping if i == j else 0.0
            for row in range(last - first):
                entry += factor[row, i] * factor[row, j]
            for k in range(j):
                entry -= normal[i, k] * normal[j, k]
            normal[i, j] = math.sqrt(entry) if i == j else entry / normal[j, j]
        for k in range(i):
            inner[i] -= normal[i, k] * inner[k]
        inner[i] /= normal[i, i]
    for i in range(fresh - 1, -1, -1):
        for k in range(i + 1, fresh):
            inner[i] -= normal[k, i] * inner[k]
        inner[i] /= normal[i, i]


@inlined
def _dot(a: Floats, b: Floats, count: int) -> float:
    total = 0.0
    for index in range(count):
        total += a[index] * b[index]
    return total


@inlined
def _add(a: Floats, b: Floats, factor: float, count: int) -> None:
    for index in range(count):
        a[index] += factor * b[index]

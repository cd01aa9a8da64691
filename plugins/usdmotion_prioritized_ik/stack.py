"""One step of a stack of levels: each moves only where no level above it is disturbed.

2004, section 3.2, with two changes. The projector is never formed: an orthonormal basis of the
rows used so far takes its place. And only the inverse that moves is damped; the one that projects
decides by rank, so that nothing of a lower level leaks into a higher one.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Floats, Ints
from usdmotion.kernels import inlined, shared, summing


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
            add_row(stack.step, stack.basis, used + index, stack.inner[index], columns)
        used += fresh
    return used


@shared
def remove_spanned(stack: Stack, used: int, vector: Floats, columns: int) -> None:
    """Take from a vector all that would disturb the levels: v ← N v."""
    for index in range(used):
        along = row_product(stack.basis, index, vector, columns)
        add_row(vector, stack.basis, index, -along, columns)


@inlined
def _subtract_done(stack: Stack, first: int, last: int, used: int, columns: int) -> float:
    """e_i − J_i Δ_{i−1} and J_i N_{i−1}, in place; return the squared error."""
    square = 0.0
    for row in range(first, last):
        if used > 0:
            stack.errors[row] -= row_product(stack.rows, row, stack.step, columns)
        for index in range(used):
            along = rows_product(stack.rows, row, stack.basis, index, columns)
            add_between(stack.rows, row, stack.basis, index, -along, columns)
        square += stack.errors[row] * stack.errors[row]
        stack.norms[row] = rows_product(stack.rows, row, stack.rows, row, columns)
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
        length = math.sqrt(rows_product(stack.rows, longest, stack.rows, longest, columns))
        if length <= rank:
            break
        new = used + fresh
        for column in range(columns):
            stack.basis[new, column] = stack.rows[longest, column] / length
        stack.factor[longest - first, fresh] = length
        stack.norms[longest] = -1.0
        for row in range(first, last):
            if stack.norms[row] < 0.0:
                continue
            along = rows_product(stack.rows, row, stack.basis, new, columns)
            add_between(stack.rows, row, stack.basis, new, -along, columns)
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


@summing
def row_product(matrix: Floats, row: int, vector: Floats, count: int) -> float:
    """(R, C), (C,) to the product of a row and a vector."""
    total = 0.0
    for index in range(count):
        total += matrix[row, index] * vector[index]
    return total


@summing
def rows_product(a: Floats, row_a: int, b: Floats, row_b: int, count: int) -> float:
    """(R, C), (S, C) to the product of a row of each."""
    total = 0.0
    for index in range(count):
        total += a[row_a, index] * b[row_b, index]
    return total


@shared
def add_row(vector: Floats, matrix: Floats, row: int, factor: float, count: int) -> None:
    """(C,), (R, C): add a multiple of a row to a vector."""
    for index in range(count):
        vector[index] += factor * matrix[row, index]


@shared
def add_between(a: Floats, row_a: int, b: Floats, row_b: int, factor: float, count: int) -> None:
    """(R, C), (S, C): add a multiple of a row of the second to a row of the first."""
    for index in range(count):
        a[row_a, index] += factor * b[row_b, index]

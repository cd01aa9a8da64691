"""Eigenvectors of one symmetric 3 × 3 matrix, inside kernels."""

import math

from usdmotion import Floats
from usdmotion.kernels import shared

SWEEPS = 12
"""Rounds over the three pairs of axes; five make a matrix diagonal to the last bit."""


@shared
def eigen(matrix: Floats, values: Floats, vectors: Floats) -> None:
    """(3, 3), which is lost, into (3,) ascending and (3, 3) by columns, by Jacobi's rotations."""
    for i in range(3):
        for j in range(3):
            vectors[i, j] = 1.0 if i == j else 0.0
    for _ in range(SWEEPS):
        rest = abs(matrix[0, 1]) + abs(matrix[0, 2]) + abs(matrix[1, 2])
        size = abs(matrix[0, 0]) + abs(matrix[1, 1]) + abs(matrix[2, 2])
        if rest <= 1e-18 * size:
            break
        _rotate(matrix, vectors, 0, 1)
        _rotate(matrix, vectors, 0, 2)
        _rotate(matrix, vectors, 1, 2)
    for i in range(3):
        values[i] = matrix[i, i]
    for i, j in ((0, 1), (1, 2), (0, 1)):
        if values[j] < values[i]:
            values[i], values[j] = values[j], values[i]
            for k in range(3):
                vectors[k, i], vectors[k, j] = vectors[k, j], vectors[k, i]


@shared
def _rotate(matrix: Floats, vectors: Floats, p: int, q: int) -> None:
    """Turn two axes so that the element between them is zero."""
    off = matrix[p, q]
    if off == 0.0:
        return
    slope = (matrix[q, q] - matrix[p, p]) / (2.0 * off)
    tangent = 1.0 / (abs(slope) + math.sqrt(slope * slope + 1.0))
    if slope < 0.0:
        tangent = -tangent
    cosine = 1.0 / math.sqrt(tangent * tangent + 1.0)
    sine = tangent * cosine
    for k in range(3):
        a, b = matrix[k, p], matrix[k, q]
        matrix[k, p], matrix[k, q] = cosine * a - sine * b, sine * a + cosine * b
    for k in range(3):
        a, b = matrix[p, k], matrix[q, k]
        matrix[p, k], matrix[q, k] = cosine * a - sine * b, sine * a + cosine * b
    for k in range(3):
        a, b = vectors[k, p], vectors[k, q]
        vectors[k, p], vectors[k, q] = cosine * a - sine * b, sine * a + cosine * b

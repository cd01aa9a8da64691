"""Displacements that leave the same line or point where it is, solved together.

Each says (R − I) p + t = 0 of the points that it leaves (2006, eq. 5). Stacked, these equations
have the normal matrix N = Σ σ3² (I − a aᵀ), a being the axes: what is null in it is the line that
all of them share, and where nothing is, one point is left. Stacks add, so two contacts are fitted
as one without a look at their frames.
"""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Floats, NoisePattern
from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import quaternion_at, turned
from usdmotion_contacts.displacements import Displacements
from usdmotion_contacts.eigen import eigen

NONE, LINE, POINT = 0, 1, 2
"""What a stack leaves where it is."""
RIGHT, ACROSS, ALONG, WEIGHT, SIGMA, EPSILON, SENSE = 6, 9, 10, 11, 12, 13, 14
"""Columns of a stack: after N by rows of its upper half Aᵀt, Σ |t across the axis|², Σ slide²,
Σ σ3², Σ σ_max², Σ ε_max², Σ a sin(θ/2)."""
COLUMNS = 17
SINGULAR = 1e-12
"""Eigenvalues of N below this, relative to the largest, are 0: that way nothing is known."""
TINY = 1e-300
"""Instead of 0, where that would divide."""
_PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


class Fit(NamedTuple):
    """Room for the answer to one stack."""

    center: Floats
    """A line's point is the nearest of it to this one, shape (3,)."""
    stack: Floats
    """A sum of stacks, shape (COLUMNS,)."""
    values: Floats
    """Eigenvalues of N, ascending, shape (3,)."""
    vectors: Floats
    """Its eigenvectors, by columns, shape (3, 3)."""
    work: Floats
    """Shape (3, 3)."""
    line: Floats
    """The point if it is a line, shape (3,)."""
    point: Floats
    """The point if it is a point."""


def room(center: Floats) -> Fit:
    """Return room for fits, (3,)."""
    return Fit(
        np.array(center), np.zeros(COLUMNS), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3)),
        np.zeros(3), np.zeros(3),
    )  # fmt: skip


def stacks(moves: Displacements, pattern: NoisePattern) -> Floats:
    """Return the stack of each displacement alone, shape (displacement_count, COLUMNS)."""
    vector, cosine = moves.rotations[:, :3], moves.rotations[:, 3:]
    sine = np.linalg.norm(vector, axis=1, keepdims=True)
    axis = vector / np.maximum(sine, TINY)
    t = moves.translations
    slide = np.sum(t * axis, axis=1, keepdims=True)
    across = t - slide * axis
    # Rᵀ v − v of a v across the axis, by the half angle: −2 sin² v − 2 sin cos (a × v).
    right = -2.0 * sine * (sine * across + cosine * np.cross(axis, across))
    square = 4.0 * sine[:, 0] ** 2
    matrix = [square * ((i == j) - axis[:, i] * axis[:, j]) for i, j in _PAIRS]
    return np.column_stack(
        [*matrix, right, np.sum(across**2, axis=1), slide[:, 0] ** 2, square,
         pattern.sigma.at(moves.times) ** 2, pattern.epsilon.at(moves.times) ** 2,
         np.where(cosine < 0.0, -vector, vector)]
    )  # fmt: skip


@shared
def solve(fit: Fit) -> None:
    """Find the line and the point that a sum of stacks leaves, whether or not they are any good."""
    stack, work = fit.stack, fit.work
    work[0, 0], work[0, 1], work[0, 2] = stack[0], stack[1], stack[2]
    work[1, 0], work[1, 1], work[1, 2] = stack[1], stack[3], stack[4]
    work[2, 0], work[2, 1], work[2, 2] = stack[2], stack[4], stack[5]
    eigen(work, fit.values, fit.vectors)
    _turn_as(fit.vectors, stack)
    for i in range(3):
        fit.line[i] = fit.center[i]
    least = SINGULAR * max(fit.values[2], TINY)
    for e in range(2, -1, -1):
        if e == 0:
            for i in range(3):
                fit.point[i] = fit.line[i]
        pull = 0.0
        for i in range(3):
            pull -= fit.vectors[i, e] * (stack[RIGHT + i] + _times_matrix(stack, fit.center, i))
        if fit.values[e] <= least:
            continue
        for i in range(3):
            if e > 0:
                fit.line[i] += fit.vectors[i, e] * pull / fit.values[e]
            else:
                fit.point[i] += fit.vectors[i, e] * pull / fit.values[e]


@shared
def _turn_as(vectors: Floats, stack: Floats) -> None:
    """Give the first of some vectors the sense in which the object turns on the whole."""
    turn = 0.0
    for i in range(3):
        turn += vectors[i, 0] * stack[SENSE + i]
    if turn < 0.0:
        for i in range(3):
            vectors[i, 0] = -vectors[i, 0]


@shared
def _times_matrix(stack: Floats, p: Floats, i: int) -> float:
    """Return an element of N p."""
    if i == 0:
        return float(stack[0] * p[0] + stack[1] * p[1] + stack[2] * p[2])
    if i == 1:
        return float(stack[1] * p[0] + stack[3] * p[1] + stack[4] * p[2])
    return float(stack[2] * p[0] + stack[4] * p[1] + stack[5] * p[2])


@shared
def is_solved(stack: Floats, p: Floats) -> bool:
    """Return whether a point solves the equations of a stack, each of their rows within ε_max."""
    return bool(_across(stack, p) + stack[ALONG] <= 3.0 * stack[EPSILON])


@shared
def gap(stack: Floats, p: Floats) -> float:
    """Return how far a point is from the axes of a stack [m], 0 if that is what noise explains."""
    if is_solved(stack, p):
        return 0.0
    return math.sqrt(_across(stack, p) / stack[WEIGHT])


@shared
def tilt(stack: Floats, vectors: Floats) -> float:
    """Return the sine of the angle from the first of some vectors to the axes of a stack.

    Slow turns have axes that point anywhere: it is 0 if σ_max explains it.
    """
    oblique = 0.0
    for i in range(3):
        oblique += vectors[i, 0] * _times_matrix(stack, vectors[:, 0], i)
    if oblique <= stack[SIGMA]:
        return 0.0
    return math.sqrt(oblique / stack[WEIGHT])


@shared
def _across(stack: Floats, p: Floats) -> float:
    """Return Σ σ3² d², d being the distances of a point from the axes of a stack."""
    square = stack[ACROSS]
    for i in range(3):
        square += p[i] * (_times_matrix(stack, p, i) + 2.0 * stack[RIGHT + i])
    return max(float(square), 0.0)


@shared
def shift(poses: tuple[Floats, Floats], p: Floats, first: int, last: int) -> float:
    """Return how far a point of the object is on one frame from where it is on another [m]."""
    translations, rotations = poses
    one = turned(quaternion_at(rotations, first), (p[0], p[1], p[2]))
    other = turned(quaternion_at(rotations, last), (p[0], p[1], p[2]))
    square = 0.0
    for i in range(3):
        square += (other[i] - one[i] + translations[last, i] - translations[first, i]) ** 2
    return math.sqrt(square)


@shared
def veer(poses: tuple[Floats, Floats], vectors: Floats, first: int, last: int) -> float:
    """Return the sine of the angle by which the first of some vectors turns between two frames."""
    axis = (vectors[0, 0], vectors[1, 0], vectors[2, 0])
    one = turned(quaternion_at(poses[1], first), axis)
    other = turned(quaternion_at(poses[1], last), axis)
    cosine = one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
    return math.sqrt(max(0.0, 1.0 - cosine * cosine))

"""Limits of joints, in NumPy: boxes that hold the rotation vector of R_rest⁻¹R.

Two vectors stand for one rotation, of which the longer one goes the other way around. A joint has
the one that is nearer to its box, so that a box may go beyond half a turn.
"""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels.rotations import conjugate, from_vector, multiply, normalize, to_vector


def limit_boxes(lowest: Floats, highest: Floats) -> tuple[Floats, Floats]:
    """(…, 3), (…, 3) limits in degrees, ±inf for free, to boxes of rotation vectors [rad].

    What is free goes half around.
    """
    free = (lowest <= -180.0) & (highest >= 180.0)
    low = np.where(free | np.isinf(lowest), -180.0, lowest)
    high = np.where(free | np.isinf(highest), 180.0, highest)
    return np.radians(low), np.radians(high)


def limited_vectors(rotations: Floats, rest: Floats, low: Floats, high: Floats) -> Floats:
    """(…, 4), (…, 4), (…, 3), (…, 3) to (…, 3): rotation vectors from rest [rad]."""
    short = to_vector(multiply(conjugate(rest), rotations))
    angle = np.linalg.norm(short, axis=-1, keepdims=True)
    factor = np.divide(2.0 * np.pi, angle, out=np.ones_like(angle), where=angle > 1e-6)
    long = short * (1.0 - factor)
    nearer = _distance(long, low, high) < _distance(short, low, high)
    return np.asarray(np.where(nearer[..., None], long, short))


def beyond_limits(rotations: Floats, rest: Floats, low: Floats, high: Floats) -> Floats:
    """(…, 4), (…, 4), (…, 3), (…, 3) to (…): how far the farthest component is outside [rad]."""
    vectors = limited_vectors(rotations, rest, low, high)
    return np.asarray(np.maximum(np.maximum(low - vectors, vectors - high), 0.0).max(axis=-1))


def within_limits(rotations: Floats, rest: Floats, low: Floats, high: Floats) -> Floats:
    """(…, 4), (…, 4), (…, 3), (…, 3) to (…, 4): the components clamped that are outside.

    Rotations that are within are given back as they are.
    """
    vectors = limited_vectors(rotations, rest, low, high)
    clamped = np.clip(vectors, low, high)
    outside = np.any(clamped != vectors, axis=-1, keepdims=True)
    inside = normalize(multiply(rest, from_vector(clamped)))
    return np.asarray(np.where(outside, inside, rotations))


def _distance(vectors: Floats, low: Floats, high: Floats) -> Floats:
    return np.asarray(np.linalg.norm(vectors - np.clip(vectors, low, high), axis=-1))

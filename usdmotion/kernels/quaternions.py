"""One unit quaternion xyzw, one vector at a time, for use inside kernels.

Arguments and results are tuples, so that nothing is allocated and no array is counted.
"""

# mypy: disable-error-code="no-any-return"
import math
from typing import Any

from usdmotion.arrays import Floats
from usdmotion.kernels.compiling import shared

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@shared
def vector_at(vectors: Floats, index: int) -> Vector:
    """(N, 3) to one vector."""
    return (vectors[index, 0], vectors[index, 1], vectors[index, 2])


@shared
def vector_in(vectors: Floats, frame: int, index: int) -> Vector:
    """(F, N, 3) to one vector."""
    return (vectors[frame, index, 0], vectors[frame, index, 1], vectors[frame, index, 2])


@shared
def quaternion_at(rotations: Floats, index: int) -> Quaternion:
    """(N, 4) to one rotation."""
    return (
        rotations[index, 0],
        rotations[index, 1],
        rotations[index, 2],
        rotations[index, 3],
    )


@shared
def quaternion_in(rotations: Floats, frame: int, index: int) -> Quaternion:
    """(F, N, 4) to one rotation."""
    return (
        rotations[frame, index, 0],
        rotations[frame, index, 1],
        rotations[frame, index, 2],
        rotations[frame, index, 3],
    )


@shared
def product(a: Any, b: Any) -> Quaternion:
    """Return the rotation that turns by b first, then by a."""
    return (
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    )


@shared
def inverse(q: Any) -> Quaternion:
    """Return the rotation that undoes q."""
    return (-q[0], -q[1], -q[2], q[3])


@shared
def turned(q: Any, v: Any) -> Vector:
    """Return the vector v turned by q."""
    tx = 2.0 * (q[1] * v[2] - q[2] * v[1])
    ty = 2.0 * (q[2] * v[0] - q[0] * v[2])
    tz = 2.0 * (q[0] * v[1] - q[1] * v[0])
    return (
        v[0] + q[3] * tx + q[1] * tz - q[2] * ty,
        v[1] + q[3] * ty + q[2] * tx - q[0] * tz,
        v[2] + q[3] * tz + q[0] * ty - q[1] * tx,
    )


@shared
def unit(q: Any) -> Quaternion:
    """Return q at length one; the identity where q has no length."""
    square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    if square == 0.0:
        return (0.0, 0.0, 0.0, 1.0)
    scale = 1.0 / math.sqrt(square)
    return (q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale)


@shared
def rotation_vector(q: Any) -> Vector:
    """Return axis times angle, the angle in [0, π]; exact to the last bits near zero."""
    sign = -1.0 if q[3] < 0.0 else 1.0
    sine = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])
    if sine < 1e-12:
        scale = 2.0 * sign
    else:
        scale = 2.0 * math.atan2(sine, sign * q[3]) / sine * sign
    return (q[0] * scale, q[1] * scale, q[2] * scale)


@shared
def quaternion(v: Any) -> Quaternion:
    """Return the rotation by a rotation vector."""
    angle = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    scale = 0.5 - angle * angle / 48.0 if angle < 1e-4 else math.sin(0.5 * angle) / angle
    return (v[0] * scale, v[1] * scale, v[2] * scale, math.cos(0.5 * angle))


@shared
def interpolated(a: Any, b: Any, s: float) -> Quaternion:
    """Return the rotation at s on the shorter arc from a (s = 0) to b (s = 1)."""
    v = rotation_vector(product(b, inverse(a)))
    return unit(product(quaternion((v[0] * s, v[1] * s, v[2] * s)), a))


@shared
def cross(a: Any, b: Any) -> Vector:
    """Return the vector product of a and b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

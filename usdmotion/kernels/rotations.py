"""Arrays of unit quaternions xyzw, in NumPy: for everything outside the hot loops."""

from typing import cast

import numpy as np

from usdmotion.arrays import Floats

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]


def _cross(a: Floats, b: Floats) -> Floats:
    """(…, 3), (…, 3) to (…, 3): as np.cross, which for few vectors spends its time on axes."""
    return a[..., _NEXT] * b[..., _LAST] - a[..., _LAST] * b[..., _NEXT]


def multiply(a: Floats, b: Floats) -> Floats:
    """(…, 4), (…, 4) to (…, 4): turn by b first, then by a."""
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    vector = aw * bv + bw * av + _cross(av, bv)
    return np.concatenate([vector, aw * bw - np.sum(av * bv, axis=-1, keepdims=True)], axis=-1)


def conjugate(q: Floats) -> Floats:
    """(…, 4) to (…, 4): the inverse rotations."""
    return q * (-1.0, -1.0, -1.0, 1.0)


def rotate(q: Floats, v: Floats) -> Floats:
    """(…, 4), (…, 3) to (…, 3): the vectors turned."""
    twice = 2.0 * _cross(q[..., :3], v)
    turned: Floats = v + q[..., 3:] * twice + _cross(q[..., :3], twice)
    return turned


def normalize(q: Floats) -> Floats:
    """(…, 4) to (…, 4): at length one."""
    return cast(Floats, q / np.linalg.norm(q, axis=-1, keepdims=True))


def to_vector(q: Floats) -> Floats:
    """(…, 4) to (…, 3): axis times angle [rad], the angle in [0, π]."""
    q = np.where(q[..., 3:] < 0.0, -q, q)
    sine = np.linalg.norm(q[..., :3], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, q[..., 3:])
    scale = np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 1e-12)
    return cast(Floats, q[..., :3] * scale)


def from_vector(v: Floats) -> Floats:
    """(…, 3) to (…, 4): the rotations by axis times angle [rad]."""
    angle = np.linalg.norm(v, axis=-1, keepdims=True)
    half = 0.5 * angle
    scale = 0.5 * np.sinc(half / np.pi)
    return np.concatenate([v * scale, np.cos(half)], axis=-1)


def slerp(a: Floats, b: Floats, s: Floats) -> Floats:
    """(…, 4), (…, 4), (…) to (…, 4): from a at s = 0 to b at s = 1, the shorter way."""
    turn = to_vector(multiply(b, conjugate(a)))
    return normalize(multiply(from_vector(turn * np.asarray(s)[..., None]), a))


def chordal_mean(q: Floats, weights: Floats) -> Floats:
    """(…, N, 4), (…, N) to (…, 4): the rotation nearest to all in the chordal distance.

    It is the eigenvector of the largest eigenvalue of Σ w q qᵀ (Markley et al. 2007, eq. 12).
    """
    outer = np.einsum("...n,...ni,...nj->...ij", weights, q, q)
    return cast(Floats, np.linalg.eigh(outer)[1][..., :, -1])


def compose(
    translation_a: Floats, rotation_a: Floats, translation_b: Floats, rotation_b: Floats
) -> tuple[Floats, Floats]:
    """(…, 3), (…, 4), (…, 3), (…, 4) to (…, 3), (…, 4): frame b, given in frame a."""
    return translation_a + rotate(rotation_a, translation_b), multiply(rotation_a, rotation_b)

"""Turns between directions, quaternions xyzw: what tells frames apart."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import slerp

IDENTITY = np.array((0.0, 0.0, 0.0, 1.0))
X, Y, Z = np.eye(3)


def unit(vectors: Floats) -> Floats:
    """(…, 3) to (…, 3): at length one; nothing stays nothing."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0.0)
    return np.asarray(unit)


def across(vectors: Floats, axis: Floats) -> Floats:
    """(…, 3), (…, 3) to (…, 3): what of vectors is across a unit axis."""
    return np.asarray(vectors - np.sum(vectors * axis, axis=-1, keepdims=True) * axis)


def from_y_z(y: Floats, z: Floats) -> Floats:
    """(…, 3), (…, 3) to (…, 4): the frame whose z is along z and whose y is on y's side."""
    from scipy.spatial.transform import Rotation

    z = unit(z)
    y = unit(across(y, z))
    matrices = np.stack([np.cross(y, z), y, z], axis=-1)
    found = Rotation.from_matrix(matrices.reshape(-1, 3, 3)).as_quat()
    return np.asarray(found.reshape(*matrices.shape[:-2], 4))


def swing(a: Floats, b: Floats) -> Floats:
    """(…, 3), (…, 3) to (…, 4): the smallest turns that take unit vectors to others."""
    a, b = np.broadcast_arrays(a, b)
    cosine = np.sum(a * b, axis=-1, keepdims=True)
    turn = np.concatenate([np.cross(a, b), 1.0 + cosine], axis=-1)
    # Of all half turns between opposite directions any will do, if it is always the same.
    aside = np.cross(a, np.where(np.abs(a[..., :1]) < 0.9, X, Y))
    half = np.concatenate([aside, np.zeros_like(cosine)], axis=-1)
    turn = np.where(cosine > -1.0 + 1e-12, turn, half)
    return np.asarray(turn / np.linalg.norm(turn, axis=-1, keepdims=True))


def about(axis: Floats, angles: Floats) -> Floats:
    """(3,), (…) to (…, 4): turns about a unit axis [rad]."""
    half = 0.5 * angles[..., None]
    return np.concatenate([np.sin(half) * axis, np.cos(half)], axis=-1)


def twist(q: Floats, axis: int) -> Floats:
    """(…, 4) to (…): how far rotations turn about a principal axis, in −π..π [rad]."""
    angle = 2.0 * np.arctan2(q[..., axis], q[..., 3])
    return np.asarray((angle + np.pi) % (2.0 * np.pi) - np.pi)


def along(rotations: Floats, places: Floats, wanted: Floats) -> Floats:
    """Return rotations between others that stand along a line, held before and after them.

    Args:
        rotations: Quaternions xyzw, shape (F, N, 4).
        places: Where each stands, ascending, shape (N,).
        wanted: Where they are wanted, shape (M,).

    Returns:
        Quaternions, shape (F, M, 4).
    """
    last = len(places) - 1
    after = np.clip(np.searchsorted(places, wanted, side="right"), min(1, last), last)
    before = np.maximum(after - 1, 0)
    span = places[after] - places[before]
    share = np.divide(wanted - places[before], span, out=np.zeros(len(wanted)), where=span > 0.0)
    start, end = rotations[:, before], rotations[:, after]
    return slerp(start, end, np.broadcast_to(np.clip(share, 0.0, 1.0), start.shape[:2]))


def continuous(q: Floats) -> Floats:
    """(F, …, 4) to (F, …, 4): the same rotations, of the sign that is nearer to the last one."""
    dots = np.sum(q[1:] * q[:-1], axis=-1, keepdims=True)
    signs = np.cumprod(np.where(dots < 0.0, -1.0, 1.0), axis=0)
    return np.concatenate([q[:1], q[1:] * signs])

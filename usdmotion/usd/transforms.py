"""Matrices of USD as translations, rotations and scales.

Gf's matrices are for row vectors: the rows of the upper left block are the axes of a frame.
"""

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.kernels import rotate

_SKEW = 1e-5
"""Largest cosine between two axes, and relative difference of two scales, taken for rounding."""
_STILL = 1e-9
"""How much the matrices of what does not move may differ, relative to their size."""


def rigid(matrices: Floats, name: str) -> tuple[Floats, Floats, Floats]:
    """Take matrices apart.

    Args:
        matrices: Shape (count, 4, 4).
        name: What they place, for the error.

    Returns:
        Translations (count, 3), rotations xyzw (count, 4), scales along the axes (count, 3).

    Raises:
        SceneError: One is sheared, mirrored or flat, so that it has no rotation.
    """
    axes = matrices[:, :3, :3]
    scales = np.linalg.norm(axes, axis=2)
    if not (scales > 0.0).all():
        raise SceneError(f"{name} is scaled to nothing; give it a scale above zero")
    axes = axes / scales[..., None]
    skew = np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3)).max(initial=0.0)
    if not skew <= _SKEW:
        raise SceneError(
            f"{name} is sheared by an uneven scale above it, or between two samples of a matrix "
            "that turns; make that scale uniform, or sample the matrix more often"
        )
    if np.linalg.det(axes).min(initial=1.0) < 0.0:
        raise SceneError(f"{name} is mirrored by a negative scale; make that scale positive")
    return matrices[:, 3, :3].copy(), _quaternions(axes.transpose(0, 2, 1)), scales


def matrices_of(translations: Floats, rotations: Floats) -> Floats:
    """Return the matrices (…, 4, 4) of rigid transforms (…, 3), (…, 4)."""
    matrices = np.zeros((*translations.shape[:-1], 4, 4))
    for axis in range(3):
        matrices[..., axis, :3] = rotate(rotations, np.eye(3)[axis])
    matrices[..., 3, :3] = translations
    matrices[..., 3, 3] = 1.0
    return matrices


def even(scales: Floats) -> bool:
    """Tell whether scales (…, 3) are the same along the three axes."""
    return bool((np.ptp(scales, axis=-1) <= _SKEW * np.abs(scales).max(axis=-1)).all())


def is_still(matrices: Floats) -> bool:
    """Tell whether matrices (frame_count, 4, 4) are the same on all frames."""
    return bool(np.ptp(matrices, axis=0).max() <= _STILL * np.abs(matrices).max())


def world_matrices(prim: Usd.Prim, time_codes: Floats) -> Floats:
    """Return the local-to-world matrices of a prim, (frame_count, 4, 4), or one if it is still."""
    cache = UsdGeom.XformCache()
    codes = time_codes if _moves(prim) else time_codes[:1]
    found = np.empty((len(codes), 4, 4))
    for matrix, code in zip(found, codes, strict=True):
        cache.SetTime(Usd.TimeCode(code))
        matrix[:] = cache.GetLocalToWorldTransform(prim)
    return found


def parent_matrices(prim: Usd.Prim, time_codes: Floats) -> Floats:
    """Return the matrices of what a prim's own transform is relative to; as `world_matrices`."""
    if UsdGeom.Xformable(prim).GetResetXformStack():
        return np.eye(4)[None]
    return world_matrices(prim.GetParent(), time_codes)


def local_matrices(prim: Usd.Prim, time_codes: Floats) -> Floats:
    """Return the matrices of a prim's own transform; as `world_matrices`."""
    xform = UsdGeom.Xformable(prim)
    codes = time_codes if xform.TransformMightBeTimeVarying() else time_codes[:1]
    return np.array([xform.GetLocalTransformation(Usd.TimeCode(code)) for code in codes])


def _moves(prim: Usd.Prim) -> bool:
    while prim and not prim.IsPseudoRoot():
        xform = UsdGeom.Xformable(prim)
        if xform and xform.TransformMightBeTimeVarying():
            return True
        prim = prim.GetParent()
    return False


def _quaternions(matrices: Floats) -> Floats:
    """Return xyzw of rotation matrices for column vectors, from the largest of four squares."""
    m = matrices
    trace = m[:, 0, 0] + m[:, 1, 1] + m[:, 2, 2]
    squares = np.stack(
        [
            1.0 + 2.0 * m[:, 0, 0] - trace,
            1.0 + 2.0 * m[:, 1, 1] - trace,
            1.0 + 2.0 * m[:, 2, 2] - trace,
            1.0 + trace,
        ],
        axis=1,
    )
    xy, yz, zx = m[:, 1, 0] + m[:, 0, 1], m[:, 2, 1] + m[:, 1, 2], m[:, 0, 2] + m[:, 2, 0]
    xw, yw, zw = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    x2, y2, z2, w2 = squares.T
    rows = np.array([[x2, xy, zx, xw], [xy, y2, yz, yw], [zx, yz, z2, zw], [xw, yw, zw, w2]])
    largest = squares.argmax(axis=1)
    quaternions = rows[largest, :, np.arange(len(m))]
    return np.asarray(quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True))

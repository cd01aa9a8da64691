"""Joints, which are no prims: their names as a list, and which of them is where."""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel

from usdmotion.errors import SceneError

_INDENT = "    "


def labels(tokens: Sequence[str]) -> list[str]:
    """Return the joints of a Skeleton as people read a tree of them, one name each, all different.

    A name is the last of a token, or all of it where two joints end in the same.
    """
    leaves = [token.rsplit("/", 1)[-1] for token in tokens]
    return [
        _INDENT * token.count("/") + (leaf if leaves.count(leaf) == 1 else token)
        for token, leaf in zip(tokens, leaves, strict=True)
    ]


def nearest_joint(skeleton: Usd.Prim, prop: Usd.Prim, time_code: float) -> str:
    """Return the joint of a Skeleton that is nearest to a prim at a time.

    A prim is where the middle of what it shows is, or its origin where it shows nothing.

    Raises:
        SceneError: USD cannot pose the Skeleton.
    """
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(skeleton))
    placed = UsdGeom.XformCache(time_code)
    joints = query.ComputeJointWorldTransforms(placed) if query else None
    if not joints:
        raise SceneError(f"<{skeleton.GetPath()}> has no pose; `usdmotion inspect` says why")
    places = np.array([matrix.ExtractTranslation() for matrix in joints], dtype=np.float64)
    away = np.linalg.norm(places - np.array(_middle(prop, placed, time_code)), axis=1)
    return str(query.GetJointOrder()[int(away.argmin())])


def _middle(prop: Usd.Prim, placed: UsdGeom.XformCache, time_code: float) -> Gf.Vec3d:
    purposes = [UsdGeom.Tokens.default_, UsdGeom.Tokens.proxy, UsdGeom.Tokens.render]
    bound = UsdGeom.BBoxCache(time_code, purposes).ComputeWorldBound(prop)
    if not bound.GetRange().IsEmpty():
        return bound.ComputeCentroid()
    return placed.GetLocalToWorldTransform(prop).ExtractTranslation()

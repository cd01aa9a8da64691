"""What a point instancer scatters."""

from collections.abc import Iterator

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats

MOST = 500
"""Of more instances, every so many are drawn."""


def scattered(prim: Usd.Prim, time_code: float) -> Iterator[tuple[Usd.Prim, Floats]]:
    """Yield the prototypes of an instancer, and the matrices (count, 4, 4) of their instances.

    Matrices take places in the space of the prototype's parent to the world. Instances that are
    masked are left out.
    """
    instancer, time = UsdGeom.PointInstancer(prim), Usd.TimeCode(time_code)
    kinds = instancer.GetProtoIndicesAttr().Get(time)
    mask = instancer.ComputeMaskAtTime(time)
    matrices = instancer.ComputeInstanceTransformsAtTime(
        time,
        time,
        UsdGeom.PointInstancer.IncludeProtoXform,
        UsdGeom.PointInstancer.IgnoreMask,
    )
    if kinds is None or matrices is None or len(matrices) != len(kinds):
        return
    world = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim))
    placed = np.array(matrices).reshape(-1, 4, 4) @ world
    indices = np.array(kinds)
    kept = np.flatnonzero(np.array(mask) if len(mask) else np.ones(len(indices), dtype=np.bool_))
    kept = kept[:: 1 + len(kept) // MOST]
    for index, path in enumerate(instancer.GetPrototypesRel().GetForwardedTargets()):
        prototype = prim.GetStage().GetPrimAtPath(path)
        of_it = kept[indices[kept] == index]
        if prototype and len(of_it):
            yield prototype, placed[of_it]

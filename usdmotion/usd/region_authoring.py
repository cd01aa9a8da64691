"""Regions, authored as the shapes of USD that they are."""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.constraints import Region
from usdmotion.errors import SceneError
from usdmotion.kernels import Shape
from usdmotion.usd.goal_authoring import author_transform
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import parent_matrices


def author_region(
    stage: Usd.Stage, region: Region, *, time_codes: Sequence[float] | Floats = (0.0,)
) -> None:
    """Author a region as a Plane, Cube, Sphere, Cylinder or Capsule at its path.

    Args:
        stage: Where, in its edit target.
        region: In metres and in the world; its size does not change.
        time_codes: Time code of each frame, where it moves.

    Raises:
        SceneError: Its size changes, or no shape of USD is like it.
    """
    extent, margin = np.asarray(region.extent), np.asarray(region.margin)
    if extent.ndim > 1 or margin.ndim > 0:
        raise SceneError(f"<{region.path}> changes its size over time; give it one size")
    unit = read_facts(stage).meters_per_unit
    kind, sizes, scale = _shape(region, extent / unit, float(margin) / unit)
    prim = stage.DefinePrim(Sdf.Path(region.path), kind)
    for name, size in sizes.items():
        prim.GetAttribute(name).Set(size)
    xform, codes = UsdGeom.Xformable(prim), np.array(time_codes, dtype=float)
    if np.any(parent_matrices(prim, codes) != np.eye(4)):
        xform.SetResetXformStack(True)
    author_transform(prim, region.translation / unit, region.rotation, codes)
    if scale is not None:
        xform.AddScaleOp().Set(Gf.Vec3f(*scale.tolist()))
    UsdGeom.Boundable(prim).CreateExtentAttr(
        UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), Usd.TimeCode.Default())
    )


def _shape(
    region: Region, extent: Floats, margin: float
) -> tuple[str, dict[str, float | str], Floats | None]:
    """Return the type of a prim, its attributes, and the scale it needs, in stage units."""
    if region.shape == Shape.HALF_SPACE:
        return "Plane", {"axis": "Z"}, None
    if region.shape == Shape.CYLINDER and margin == 0.0:
        return "Cylinder", {"axis": "Z", "radius": extent[0], "height": 2.0 * extent[2]}, None
    if region.shape == Shape.BOX and margin == 0.0:
        return "Cube", {"size": 2.0}, extent
    if region.shape == Shape.BOX and not extent[:2].any():
        sizes = {"axis": "Z", "radius": margin, "height": 2.0 * extent[2]}
        return ("Capsule", sizes, None) if extent[2] else ("Sphere", {"radius": margin}, None)
    raise SceneError(f"<{region.path}> is like no shape of USD; round it, or give it edges")

"""Colours of surfaces, and whether anybody sees them."""

import numpy as np
from pxr import Usd, UsdGeom, UsdShade

from usdmotion.arrays import Floats

Color = tuple[float, float, float]


def purposes_of(prims: list[Usd.Prim]) -> frozenset[str]:
    """Return the purposes that are drawn: the rendered ones, proxies where nothing is rendered."""
    found = {str(UsdGeom.Imageable(prim).ComputePurpose()) for prim in prims}
    fine = UsdGeom.Tokens.render if UsdGeom.Tokens.render in found else UsdGeom.Tokens.proxy
    return frozenset({str(UsdGeom.Tokens.default_), str(fine)})


def is_visible(prim: Usd.Prim, time_code: float) -> bool:
    """Tell whether a prim is not hidden at a time, by itself or by one above it."""
    visibility = UsdGeom.Imageable(prim).ComputeVisibility(Usd.TimeCode(time_code))
    return bool(visibility != UsdGeom.Tokens.invisible)


def color_of(prim: Usd.Prim, time_code: float) -> Color | None:
    """Return one linear colour for a surface: its display colour, on average, or its material's.

    None where neither says, or a picture is put on it.
    """
    found = _primvar(prim, "displayColor", time_code)
    if found is not None:
        red, green, blue = found.mean(axis=0).tolist()
        return red, green, blue
    return _diffuse(prim, time_code)


def opacity_of(prim: Usd.Prim, time_code: float) -> float:
    """Return the opacity of a surface, on average."""
    found = _primvar(prim, "displayOpacity", time_code)
    return 1.0 if found is None else float(found.mean())


def _primvar(prim: Usd.Prim, name: str, time_code: float) -> Floats | None:
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
    values = primvar.ComputeFlattened(Usd.TimeCode(time_code)) if primvar else None
    return np.array(values, dtype=np.float64) if values is not None and len(values) else None


def _diffuse(prim: Usd.Prim, time_code: float) -> Color | None:
    """Return the diffuse colour of a preview material, where that is one and the same all over."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    if not material:
        return None
    shader = material.ComputeSurfaceSource()[0]
    source = shader.GetInput("diffuseColor") if shader else None
    if not source or source.HasConnectedSource():
        return None
    color = source.Get(Usd.TimeCode(time_code))
    return None if color is None else (float(color[0]), float(color[1]), float(color[2]))

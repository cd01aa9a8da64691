"""Points and curves to look at, as specs of prims that nobody renders."""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from pxr import Gf, Sdf, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import Color
from usdmotion.usd.layers import set_value, set_varying

_TYPES = Sdf.ValueTypeNames
GUIDES = "Guides"
"""Name of what is made under a contact, and under a detection."""
PLACED = "xformOp:transform:guide"
"""The transform of a guide; what it refers to may have another."""
_DIGITS = 9
"""Of the transform of a guide; more is rounding."""


def author_points(prim: Sdf.PrimSpec, points: Floats, width: float, color: Color) -> None:
    """Make a spec one of points.

    Args:
        prim: The spec.
        points: In its frame and units, shape (point_count, 3).
        width: How large each is drawn, in those units.
        color: Their colour.
    """
    make(prim, "Points")
    _author_places(prim, points, width, "vertex")
    author_color(prim, color)


def author_curves(prim: Sdf.PrimSpec, curves: Sequence[Floats], width: float, color: Color) -> None:
    """Make a spec one of polylines.

    Args:
        prim: The spec.
        curves: In its frame and units, each of shape (point_count, 3), at least two points.
        width: How thick they are, in those units.
        color: Their colour.
    """
    make(prim, "BasisCurves")
    set_value(prim, "type", _TYPES.Token, UsdGeom.Tokens.linear)
    counts = Vt.IntArray([len(curve) for curve in curves])
    set_varying(prim, "curveVertexCounts", _TYPES.IntArray, counts)
    _author_places(prim, np.concatenate(curves), width, "constant")
    author_color(prim, color)


def make(prim: Sdf.PrimSpec, kind: str) -> None:
    """Make a spec that of a prim of some type."""
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = kind


def guide(prim: Sdf.PrimSpec) -> None:
    """Let a prim, and what is below it, be drawn for people only, and bound nothing."""
    set_value(prim, "purpose", _TYPES.Token, UsdGeom.Tokens.guide)


def author_color(prim: Sdf.PrimSpec, color: Color) -> None:
    """Give a spec a colour."""
    colors = Vt.Vec3fArray([Gf.Vec3f(*color)])
    set_varying(prim, "primvars:displayColor", _TYPES.Color3fArray, colors, "constant")


def author_opacity(prim: Sdf.PrimSpec, opacity: Mapping[float, float] | float) -> None:
    """Give a spec, and what is below it, an opacity: for all times, or at some time codes."""
    name, kind = "primvars:displayOpacity", _TYPES.FloatArray
    if isinstance(opacity, float):
        set_varying(prim, name, kind, Vt.FloatArray([opacity]), "constant")
    else:
        samples = {code: Vt.FloatArray([value]) for code, value in opacity.items()}
        set_varying(prim, name, kind, samples, "constant")


def place(prim: Sdf.PrimSpec, matrix: Floats | None) -> None:
    """Give a spec a transform, or one that is as if nothing were above it.

    Args:
        prim: The spec.
        matrix: For row vectors, shape (4, 4); None makes its frame the world's.
    """
    order = [UsdGeom.XformOpTypes.resetXformStack] if matrix is None else []
    rounded = None if matrix is None else np.round(matrix, _DIGITS) + 0.0
    if rounded is not None and not np.array_equal(rounded, np.eye(4)):
        order = [PLACED]
        set_varying(prim, PLACED, _TYPES.Matrix4d, Gf.Matrix4d(rounded.tolist()))
    set_value(prim, "xformOpOrder", _TYPES.TokenArray, Vt.TokenArray(order))


def _author_places(prim: Sdf.PrimSpec, points: Floats, width: float, interpolation: str) -> None:
    # A hundredth of what can be seen is near enough, and short to write.
    points = np.round(points, 2 - math.floor(math.log10(width))) + 0.0
    places = Vt.Vec3fArray.FromNumpy(points.astype(np.float32))
    set_varying(prim, "points", _TYPES.Point3fArray, places)
    # USD computes no extent of points that share one width.
    widths = Vt.FloatArray([width] * (len(points) if interpolation == "vertex" else 1))
    set_varying(prim, "widths", _TYPES.FloatArray, widths, interpolation)
    box = np.array([points.min(axis=0) - 0.5 * width, points.max(axis=0) + 0.5 * width])
    extent = Vt.Vec3fArray.FromNumpy(box.astype(np.float32))
    set_varying(prim, "extent", _TYPES.Float3Array, extent)

"""Points and curves to look at, as specs of prims that nobody renders."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

import numpy as np
from pxr import Gf, Sdf, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import Color
from usdmotion.usd.layers import set_value, set_varying

_TYPES = Sdf.ValueTypeNames
WORLD = "World"
"""The class below the guides of an edit whose frame is the world's."""
PLACED = "xformOp:transform:guide"
"""The transform of a guide; what it refers to may have another."""
MOVED, TURNED = "xformOp:translate:guide", "xformOp:orient:guide"
_TURN_DIGITS = 5
"""Of a quaternion of a guide."""
_Made = TypeVar("_Made")
_DIGITS = 9
"""Of the transform of a guide; more is rounding."""


def author_points(
    prim: Sdf.PrimSpec, points: Floats | Mapping[float, Floats], width: float, color: Color
) -> None:
    """Make a spec one of points.

    Args:
        prim: The spec.
        points: In its frame and units, shape (point_count, 3), for all times or at time codes.
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
    _author_polylines(prim, np.concatenate(curves), [len(curve) for curve in curves], width, color)


def author_curve(
    prim: Sdf.PrimSpec, points: Floats | Mapping[float, Floats], width: float, color: Color
) -> None:
    """Make a spec one polyline.

    Args:
        prim: The spec.
        points: In its frame and units, shape (point_count, 3), for all times or at time codes.
        width: How thick it is, in those units.
        color: Its colour.
    """
    _author_polylines(prim, points, [_count(points)], width, color)


def author_mesh(
    prim: Sdf.PrimSpec,
    points: Floats | Mapping[float, Floats],
    counts: Sequence[int],
    corners: Sequence[int],
    detail: float,
) -> None:
    """Make a spec a mesh of flat faces.

    Args:
        prim: The spec.
        points: In its frame and units, shape (point_count, 3), for all times or at time codes.
        counts: Corners of each face.
        corners: Which points those are, face by face.
        detail: The smallest length that can be seen, in those units.
    """
    make(prim, "Mesh")
    set_varying(prim, "faceVertexCounts", _TYPES.IntArray, Vt.IntArray(list(counts)))
    set_varying(prim, "faceVertexIndices", _TYPES.IntArray, Vt.IntArray(list(corners)))
    set_value(prim, "subdivisionScheme", _TYPES.Token, UsdGeom.Tokens.none)
    _author_points(prim, points, detail, beyond=0.0)


def author_extent(
    prim: Sdf.PrimSpec, points: Floats | Mapping[float, Floats], beyond: float = 0.0
) -> None:
    """Give a spec the box around points, and around so much beyond them."""

    def box(points: Floats) -> Vt.Vec3fArray:
        return _vectors(np.array([points.min(axis=0) - beyond, points.max(axis=0) + beyond]))

    set_varying(prim, "extent", _TYPES.Float3Array, _each(points, box))


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


def author_visibility(prim: Sdf.PrimSpec, seen: Mapping[float, bool]) -> None:
    """Let a spec be seen from some time codes on, and not from others on."""
    tokens = {
        code: UsdGeom.Tokens.inherited if on else UsdGeom.Tokens.invisible
        for code, on in seen.items()
    }
    set_varying(prim, "visibility", _TYPES.Token, tokens)


def move(
    prim: Sdf.PrimSpec,
    translations: Mapping[float, Floats] | Floats,
    rotations: Mapping[float, Floats] | Floats | None,
    detail: float,
) -> None:
    """Give a spec a place, and a rotation if it has one, for all times or at time codes.

    Args:
        prim: The spec.
        translations: In the frame and units above it, shape (3,).
        rotations: Unit xyzw, shape (4,).
        detail: The smallest length that can be seen, in those units.
    """
    digits = _digits(detail)
    places = _each(translations, lambda each: Gf.Vec3d(*_rounded(each, digits).tolist()))
    set_varying(prim, MOVED, _TYPES.Double3, places)
    # What has the world's frame by a class keeps it.
    placed = any(path.name == WORLD for path in prim.inheritPathList.prependedItems)
    order = [PLACED, MOVED] if placed else [MOVED]
    if rotations is not None:
        turns = _each(rotations, _quaternion)
        set_varying(prim, TURNED, _TYPES.Quatf, turns)
        order.append(TURNED)
    set_value(prim, "xformOpOrder", _TYPES.TokenArray, Vt.TokenArray(order))


def _author_polylines(
    prim: Sdf.PrimSpec,
    points: Floats | Mapping[float, Floats],
    counts: Sequence[int],
    width: float,
    color: Color,
) -> None:
    make(prim, "BasisCurves")
    set_value(prim, "type", _TYPES.Token, UsdGeom.Tokens.linear)
    set_varying(prim, "curveVertexCounts", _TYPES.IntArray, Vt.IntArray(list(counts)))
    _author_places(prim, points, width, "constant")
    author_color(prim, color)


def _count(points: Floats | Mapping[float, Floats]) -> int:
    return len(next(iter(points.values())) if isinstance(points, Mapping) else points)


def _author_places(
    prim: Sdf.PrimSpec,
    points: Floats | Mapping[float, Floats],
    width: float,
    interpolation: str,
) -> None:
    # USD computes no extent of points that share one width.
    widths = Vt.FloatArray([width] * (_count(points) if interpolation == "vertex" else 1))
    set_varying(prim, "widths", _TYPES.FloatArray, widths, interpolation)
    _author_points(prim, points, width, beyond=0.5 * width)


def _author_points(
    prim: Sdf.PrimSpec, points: Floats | Mapping[float, Floats], detail: float, beyond: float
) -> None:
    digits = _digits(detail)
    rounded = _each(points, lambda each: _rounded(each, digits))
    set_varying(prim, "points", _TYPES.Point3fArray, _each(rounded, _vectors))
    author_extent(prim, rounded, beyond)


def _vectors(values: Floats) -> Vt.Vec3fArray:
    return Vt.Vec3fArray.FromNumpy(values.astype(np.float32))


def _each(
    values: Floats | Mapping[float, Floats], pack: Callable[[Floats], _Made]
) -> _Made | dict[float, _Made]:
    """Return what is made of a value, or of those at some time codes."""
    if isinstance(values, Mapping):
        return {code: pack(each) for code, each in values.items()}
    return pack(values)


def _quaternion(rotation: Floats) -> Gf.Quatf:
    x, y, z, w = _rounded(rotation, _TURN_DIGITS).tolist()
    return Gf.Quatf(w, x, y, z)


def _digits(detail: float) -> int:
    """Return how many digits a hundredth of a length has: near enough, and short to write."""
    return 2 - math.floor(math.log10(detail))


def _rounded(values: Floats, digits: int) -> Floats:
    return np.asarray(np.round(values, digits) + 0.0)

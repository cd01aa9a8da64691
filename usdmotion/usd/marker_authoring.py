"""Markers as points, and rigid clusters of them as frames."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdmotion.arrays import Bools, Floats
from usdmotion.capture import Cluster, Markers

_WIDTH = 0.014
"""Diameter of a marker as it is drawn [m]: the balls that most laboratories glue on."""
_THIN = 0.004
"""Thickness of the sticks between the markers of a cluster [m]."""
_WHITE = (0.85, 0.85, 0.88)
_GREEN = (0.25, 0.65, 0.45)


def author_markers(stage: Usd.Stage, path: str, markers: Markers, codes: Floats) -> None:
    """Author markers as one prim of points, in an order that never changes.

    A marker that is out of sight stays where it was with a width of 0, and `primvars:seen` says 0.
    So every array has the same length on every frame: values can be read by index, USD can
    interpolate between frames, and nobody takes a guess for a measurement.

    Args:
        stage: Where; its units are the stage's.
        path: Path of the prim.
        markers: What to author.
        codes: Time code of each frame, shape (frame_count,).
    """
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    prim = UsdGeom.Points.Define(stage, path)
    points = (markers.positions / unit).astype(np.float32)
    attribute = prim.CreatePointsAttr()
    for code, each in zip(codes.tolist(), points, strict=True):
        attribute.Set(Vt.Vec3fArray.FromNumpy(each), code)
    count = len(markers.labels)
    prim.CreateIdsAttr(Vt.Int64Array(list(range(count))))
    prim.CreateDisplayColorAttr([_WHITE])
    prim.CreateExtentAttr(_extent(points.reshape(-1, 3), 0.5 * _WIDTH / unit))
    prim.SetWidthsInterpolation(UsdGeom.Tokens.vertex)
    primvars = UsdGeom.PrimvarsAPI(prim)
    label = primvars.CreatePrimvar("label", Sdf.ValueTypeNames.StringArray, UsdGeom.Tokens.vertex)
    label.Set(Vt.StringArray(list(markers.labels)))
    seen = primvars.CreatePrimvar("seen", Sdf.ValueTypeNames.IntArray, UsdGeom.Tokens.vertex)
    widths = prim.CreateWidthsAttr()
    for code, each in _changes(markers.seen, codes):
        seen.Set(Vt.IntArray.FromNumpy(each.astype(np.int32)), code)
        sizes = np.where(each, _WIDTH / unit, 0.0)
        widths.Set(Vt.FloatArray.FromNumpy(sizes.astype(np.float32)), code)


def author_cluster(stage: Usd.Stage, path: str, cluster: Cluster, codes: Floats) -> None:
    """Author a rigid cluster as an Xform that moves, with sticks between its markers to look at.

    It has no samples where too few of its markers were seen: USD moves it evenly from one sample to
    the next, so that nothing mistakes a gap for a thing that stands still. There it is invisible.

    Args:
        stage: Where; its units are the stage's.
        path: Path of the prim.
        cluster: What to author.
        codes: Time code of each frame, shape (frame_count,).
    """
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    xform = UsdGeom.Xform.Define(stage, path)
    translate = xform.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble)
    orient = xform.AddOrientOp(UsdGeom.XformOp.PrecisionFloat)
    for frame in np.flatnonzero(cluster.placed):
        code = float(codes[frame])
        translate.Set(Gf.Vec3d(*(cluster.translations[frame] / unit).tolist()), code)
        x, y, z, w = cluster.rotations[frame].tolist()
        orient.Set(Gf.Quatf(w, x, y, z), code)
    shown = {True: UsdGeom.Tokens.inherited, False: UsdGeom.Tokens.invisible}
    if not cluster.placed.all():
        for code, each in _changes(cluster.placed, codes):
            xform.CreateVisibilityAttr().Set(shown[bool(each)], code)
    prim = xform.GetPrim()
    prim.CreateAttribute(
        "usdmotion:markers", Sdf.ValueTypeNames.StringArray, False, Sdf.VariabilityUniform
    ).Set(Vt.StringArray(list(cluster.labels)))
    pairs = np.array(list(combinations(range(len(cluster.points)), 2)))
    points = (cluster.points[pairs.ravel()] / unit).astype(np.float32)
    author_lines(stage, f"{path}/Sticks", points, _THIN / unit, _GREEN)


def author_lines(
    stage: Usd.Stage, path: str, points: Floats, width: float, color: tuple[float, float, float]
) -> UsdGeom.BasisCurves:
    """Author straight lines between each two of some points, in the stage's units.

    Args:
        stage: Where.
        path: Path of the prim.
        points: First and last point of each line, shape (2 × line_count, 3).
        width: How thick they are.
        color: Linear red, green and blue.
    """
    curves = UsdGeom.BasisCurves.Define(stage, path)
    curves.CreateTypeAttr(UsdGeom.Tokens.linear)
    curves.CreateCurveVertexCountsAttr(Vt.IntArray([2] * (len(points) // 2)))
    curves.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.asarray(points, dtype=np.float32)))
    curves.CreateWidthsAttr(Vt.FloatArray([width]))
    curves.SetWidthsInterpolation(UsdGeom.Tokens.constant)
    curves.CreateDisplayColorAttr([color])
    curves.CreateExtentAttr(_extent(np.asarray(points, dtype=np.float32), 0.5 * width))
    return curves


def _changes(states: Bools, codes: Floats) -> Iterator[tuple[float, Bools]]:
    """Yield each state with its code where it changes, and the one before, which keeps it sharp."""
    rows = states.reshape(len(states), -1)
    changed = np.append(True, (rows[1:] != rows[:-1]).any(axis=1))
    kept = changed | np.append(changed[1:], False)
    for frame in np.flatnonzero(kept):
        yield float(codes[frame]), states[frame]


def _extent(points: Floats, girth: float) -> Vt.Vec3fArray:
    corners = np.stack([points.min(axis=0) - girth, points.max(axis=0) + girth])
    return Vt.Vec3fArray.FromNumpy(corners.astype(np.float32))

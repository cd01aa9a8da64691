"""Force plates: the plate, what it measured, and an arrow to look at."""

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.capture import ForcePlate
from usdmotion.usd.marker_authoring import author_lines

_GREY = (0.45, 0.45, 0.48)
_YELLOW = (0.95, 0.75, 0.15)
_LENGTH = 0.001
"""Length of the arrow for one newton [m]: that under a standing body is as high as its hips."""
_THICK = 0.012
"""Thickness of the arrow [m]."""

_FORCE = "Force of the plate on the body [N], in the axes of this prim."
_MOMENT = "Moment of the plate on the body about the origin of this prim [N m], in its axes."
_CENTER = "Centre of pressure in the frame of this prim; it has samples while the plate is loaded."


def author_plate(stage: Usd.Stage, path: str, plate: ForcePlate, codes: Floats) -> None:
    """Author a force plate: an Xform in the middle of its face, with what it measured over time.

    Args:
        stage: Where; its units are the stage's.
        path: Path of the prim.
        plate: What to author.
        codes: Time code of each sample, shape (sample_count,).
    """
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    middle = plate.corners.mean(axis=0)
    xform = UsdGeom.Xform.Define(stage, path)
    xform.AddTranslateOp().Set(Gf.Vec3d(*(middle / unit).tolist()))
    _author_face(stage, f"{path}/Face", (plate.corners - middle) / unit)
    centers = (plate.centers - middle) / unit
    prim, kinds = xform.GetPrim(), Sdf.ValueTypeNames
    force = _attribute(prim, "usdmotion:force", kinds.Vector3f, _FORCE)
    moment = _attribute(prim, "usdmotion:moment", kinds.Vector3f, _MOMENT)
    center = _attribute(prim, "usdmotion:centerOfPressure", kinds.Point3f, _CENTER)
    for sample, code in enumerate(codes.tolist()):
        force.Set(Gf.Vec3f(*plate.forces[sample].tolist()), code)
        moment.Set(Gf.Vec3f(*plate.moments[sample].tolist()), code)
        if plate.loaded[sample]:
            center.Set(Gf.Vec3f(*centers[sample].tolist()), code)
    if plate.loaded.any():
        _author_arrow(stage, f"{path}/Force", plate, centers, codes, unit)


def _attribute(
    prim: Usd.Prim, name: str, kind: Sdf.ValueTypeName, documentation: str
) -> Usd.Attribute:
    attribute = prim.CreateAttribute(name, kind, False)
    attribute.SetDocumentation(documentation)
    return attribute


def _author_face(stage: Usd.Stage, path: str, corners: Floats) -> None:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray.FromNumpy(corners.astype(np.float32))
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray([4]))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray([0, 1, 2, 3]))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateDoubleSidedAttr(True)
    mesh.CreateDisplayColorAttr([_GREY])
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))


def _author_arrow(
    stage: Usd.Stage, path: str, plate: ForcePlate, centers: Floats, codes: Floats, unit: float
) -> None:
    """Author a line from the centre of pressure along the force, which is there under load."""
    ends = np.stack([centers, centers + plate.forces * (_LENGTH / unit)], axis=1)
    loaded = plate.loaded
    arrow = author_lines(stage, path, ends[loaded].reshape(-1, 3), _THICK / unit, _YELLOW)
    arrow.CreateCurveVertexCountsAttr(Vt.IntArray([2]))
    points = arrow.GetPointsAttr()
    points.Clear()
    shown = arrow.CreateVisibilityAttr()
    for sample, code in enumerate(codes.tolist()):
        if loaded[sample]:
            points.Set(Vt.Vec3fArray.FromNumpy(ends[sample].astype(np.float32)), code)
        if sample == 0 or loaded[sample] != loaded[sample - 1]:
            token = UsdGeom.Tokens.inherited if loaded[sample] else UsdGeom.Tokens.invisible
            shown.Set(token, code)

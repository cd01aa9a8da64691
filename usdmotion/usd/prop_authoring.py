"""Props, authored from plain values: rigid meshes, and prims that carry them about."""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.usd.goal_authoring import author_transform
from usdmotion.usd.transforms import parent_matrices

_ORIGIN = np.zeros(3)
_NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


def author_mesh(
    stage: Usd.Stage,
    path: str,
    points: Floats,
    faces: Sequence[Sequence[int]],
    *,
    color: tuple[float, float, float],
) -> None:
    """Author a mesh of flat faces.

    Args:
        stage: Where, in its edit target.
        path: Path of the Mesh.
        points: In the frame of its parent [m], shape (point_count, 3).
        faces: Corners of each face, counterclockwise seen from outside.
        color: Red, green and blue, 0..1.
    """
    mesh = UsdGeom.Mesh.Define(stage, path)
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    places = Vt.Vec3fArray.FromNumpy((points / unit).astype(np.float32))
    mesh.CreatePointsAttr(places)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray([len(face) for face in faces]))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray([corner for face in faces for corner in face]))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(places))
    mesh.CreateDisplayColorAttr([Gf.Vec3f(*color)])


def author_prop(
    stage: Usd.Stage,
    path: str,
    *,
    translation: Floats = _ORIGIN,
    rotation: Floats = _NO_TURN,
    time_codes: Sequence[float] | Floats = (0.0,),
    inherits: str = "",
) -> None:
    """Author an Xform that carries what is under it.

    Args:
        stage: Where, in its edit target.
        path: Path of the Xform.
        translation: In the world [m], shape (3,), or (frame_count, 3) where it moves.
        rotation: In the world, xyzw, shape (4,) or (frame_count, 4).
        time_codes: Time code of each frame, where it moves.
        inherits: Path of a prim whose contents are its own too, and drawn nowhere else; "" is none.
    """
    prim = UsdGeom.Xform.Define(stage, path).GetPrim()
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    codes = np.array(time_codes, dtype=float)
    if np.any(parent_matrices(prim, codes) != np.eye(4)):
        UsdGeom.Xformable(prim).SetResetXformStack(True)
    if np.any(translation) or np.any(rotation != _NO_TURN):
        author_transform(prim, translation / unit, rotation, codes)
    if inherits:
        stage.GetPrimAtPath(inherits).SetSpecifier(Sdf.SpecifierClass)
        prim.GetInherits().AddInherit(inherits)

"""What an object looks like: written once, for all its ghosts to inherit."""

from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Tf, Usd, UsdGeom, UsdSkel, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import Color, ContactObject
from usdmotion.usd.guides.prims import author_color, guide, make, place
from usdmotion.usd.guides.skins import Part, Skins
from usdmotion.usd.layers import over, relate, set_value, set_varying
from usdmotion.usd.transforms import world_matrices

_TYPES = Sdf.ValueTypeNames
_MOST_PIECES = 32
"""Of a prop with more the box around it is shown."""
_BOX = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Faces of a box whose corners are in the order of their coordinates."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh of a prop."""

    path: Sdf.Path
    matrix: Floats
    """From it to the frame of the prop in stage units, without the prop's scale, (4, 4)."""
    names: tuple[str, ...]
    """Its attributes that would hide the colour of a ghost …"""
    materials: tuple[str, ...]
    """… and its relationships."""


@dataclass(frozen=True, eq=False)
class Shape:
    """What an object looks like in its own frame, in stage units."""

    part: Part | None = None
    """A mesh …"""
    pieces: tuple[Piece, ...] = ()
    """… or meshes that are on the stage."""

    @property
    def kind(self) -> str:
        """Type of the prim."""
        return "Mesh" if self.part is not None else "Xform"


def shape_of(held: ContactObject, prim: Usd.Prim, guide: str, skins: Skins) -> Shape | None:
    """Return what an object looks like, None where there is nothing to see.

    Args:
        held: The object.
        prim: The prim; of a joint, its Skeleton.
        guide: Path of the guide that is to show it.
        skins: The meshes that move with that Skeleton.
    """
    unit = UsdGeom.GetStageMetersPerUnit(prim.GetStage())
    if held.joint:
        part = skins.part(held.joint)
        if part is None:
            return None
        return Shape(Part(part.points * (held.units / unit), part.counts, part.corners))
    found = _meshes(prim, guide)
    if found is None or not found:
        return None
    if len(found) > _MOST_PIECES:
        corners = held.points / unit
        ordered = corners[np.lexsort(corners.T[::-1])]
        return Shape(Part(ordered, np.full(6, 4), np.array(_BOX).ravel()))
    code = np.array([held.start])
    scale = np.diag([*(held.units / unit), 1.0])
    inverse = np.linalg.inv(world_matrices(prim, code)[0])
    return Shape(
        pieces=tuple(
            Piece(
                mesh.GetPath(),
                world_matrices(mesh, code)[0] @ inverse @ scale,
                _colors(mesh),
                _materials(mesh),
            )
            for mesh in found
        )
    )


def author_shape(layer: Sdf.Layer, path: str, shape: Shape, color: Color) -> None:
    """Write a shape as a class, which is drawn nowhere but where it is inherited.

    Args:
        layer: Where.
        path: Path of the class.
        shape: The shape.
        color: Its colour.
    """
    prim = over(layer, path)
    make(prim, shape.kind)
    prim.specifier = Sdf.SpecifierClass
    if shape.part is not None:
        _author_mesh(prim, shape.part)
        author_color(prim, color)
    taken: set[str] = set()
    for piece in shape.pieces:
        name = Tf.MakeValidIdentifier(piece.path.name)
        while name in taken:
            name += "_"
        taken.add(name)
        _author_piece(over(layer, f"{path}/{name}"), piece, color)


def author_ghost(prim: Sdf.PrimSpec, path: str, kind: str, matrix: Floats) -> None:
    """Make a spec a copy of a shape in some pose.

    Args:
        prim: The spec.
        path: Path of the shape's class.
        kind: Its type.
        matrix: The pose, in stage units, for row vectors, shape (4, 4).
    """
    make(prim, kind)
    prim.inheritPathList.Prepend(Sdf.Path(path))
    place(prim, matrix)


def _meshes(prop: Usd.Prim, shown_at: str) -> list[Usd.Prim] | None:
    """Return the meshes of a prop that are seen; None where a reference to one would be a loop."""
    found = []
    everything = iter(Usd.PrimRange(prop, Usd.TraverseInstanceProxies()))
    for prim in everything:
        if prim.IsA(UsdSkel.Root):
            everything.PruneChildren()  # what is skinned moves otherwise
            continue
        if not prim.IsA(UsdGeom.Gprim):
            continue
        seen = UsdGeom.Imageable(prim)
        guide = seen.ComputePurpose() == UsdGeom.Tokens.guide
        if not guide and seen.ComputeVisibility() != UsdGeom.Tokens.invisible:
            if Sdf.Path(shown_at).HasPrefix(prim.GetPath()):
                return None
            found.append(prim)
    return found


def _colors(mesh: Usd.Prim) -> tuple[str, ...]:
    names = ("primvars:displayColor:indices", "primvars:displayOpacity")
    return tuple(name for name in names if mesh.HasAttribute(name))


def _materials(mesh: Usd.Prim) -> tuple[str, ...]:
    relationships = (each.GetName() for each in mesh.GetAuthoredRelationships())
    return tuple(name for name in relationships if name.startswith("material:binding"))


def _author_mesh(prim: Sdf.PrimSpec, part: Part) -> None:
    points = Vt.Vec3fArray.FromNumpy(part.points.astype(np.float32))
    set_varying(prim, "points", _TYPES.Point3fArray, points)
    counts, corners = (Vt.IntArray(each.tolist()) for each in (part.counts, part.corners))
    set_varying(prim, "faceVertexCounts", _TYPES.IntArray, counts)
    set_varying(prim, "faceVertexIndices", _TYPES.IntArray, corners)
    set_value(prim, "subdivisionScheme", _TYPES.Token, UsdGeom.Tokens.none)
    extent = UsdGeom.PointBased.ComputeExtent(points)
    set_varying(prim, "extent", _TYPES.Float3Array, extent)


def _author_piece(prim: Sdf.PrimSpec, piece: Piece, color: Color) -> None:
    """Refer to a mesh, without its materials and whatever else it takes part in."""
    prim.specifier = Sdf.SpecifierDef
    prim.referenceList.Prepend(Sdf.Reference(primPath=piece.path))
    prim.SetInfo("apiSchemas", Sdf.TokenListOp.CreateExplicit([]))
    guide(prim)
    place(prim, piece.matrix)
    author_color(prim, color)
    kinds = {"primvars:displayOpacity": _TYPES.FloatArray}
    for name in piece.names:
        set_varying(prim, name, kinds.get(name, _TYPES.IntArray), Sdf.ValueBlock())
    for name in piece.materials:
        relate(prim, name)

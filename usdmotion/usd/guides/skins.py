"""The parts of skinned meshes that follow one joint."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion.arrays import Floats, Ints

_MOST_POINTS = 300
"""Of a part with more the convex hull is shown, so that a layer stays small."""


@dataclass(frozen=True, eq=False)
class Part:
    """A rigid piece of mesh."""

    points: Floats
    """Shape (point_count, 3)."""
    counts: Ints
    """Corners of each face, shape (face_count,)."""
    corners: Ints
    """Which points those are, face by face."""


@dataclass(frozen=True, eq=False)
class _Mesh:
    points: Floats
    """Where the skeleton was bound, in its space, shape (point_count, 3)."""
    joints: Ints
    """The joint that each point follows most, shape (point_count,)."""
    counts: Ints
    corners: Ints


@dataclass(frozen=True, eq=False)
class Skins:
    """The meshes that a skeleton moves."""

    skeleton: Usd.Prim

    def part(self, token: str) -> Part | None:
        """Return what follows a joint, in its frame and units; None where nothing does."""
        tokens = [str(each) for each in UsdSkel.Skeleton(self.skeleton).GetJointsAttr().Get() or ()]
        binds = UsdSkel.Skeleton(self.skeleton).GetBindTransformsAttr().Get() or ()
        if token not in tokens or len(binds) != len(tokens):
            return None
        joint = tokens.index(token)
        parts = [part for mesh in self._meshes if (part := _following(mesh, joint)) is not None]
        if not parts:
            return None
        inverse = np.linalg.inv(np.array(binds[joint]))
        whole = _joined(parts)
        points = whole.points @ inverse[:3, :3] + inverse[3, :3]
        return _reduced(Part(points, whole.counts, whole.corners))

    @cached_property
    def _meshes(self) -> list[_Mesh]:
        root = UsdSkel.Root.Find(self.skeleton)
        if not root:
            return []
        cache, everything = UsdSkel.Cache(), Usd.TraverseInstanceProxies()
        cache.Populate(root, everything)
        tokens = UsdSkel.Skeleton(self.skeleton).GetJointsAttr().Get() or ()
        index = {str(token): joint for joint, token in enumerate(tokens)}
        return [
            mesh
            for binding in cache.ComputeSkelBindings(root, everything)
            if binding.GetSkeleton().GetPrim() == self.skeleton
            for query in binding.GetSkinningTargets()
            if (mesh := _read(query, index)) is not None
        ]


def _read(query: UsdSkel.SkinningQuery, index: dict[str, int]) -> _Mesh | None:
    mesh = UsdGeom.Mesh(query.GetPrim())
    if not mesh or not query.HasJointInfluences():
        return None
    if mesh.ComputeVisibility() == UsdGeom.Tokens.invisible:
        return None
    points = np.array(mesh.GetPointsAttr().Get(Usd.TimeCode.EarliestTime()), dtype=np.float64)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get(Usd.TimeCode.EarliestTime()))
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get(Usd.TimeCode.EarliestTime()))
    influences = query.ComputeVaryingJointInfluences(len(points))
    if influences is None or counts.sum() != len(corners) or not len(points):
        return None
    joints, weights = (np.array(each).reshape(len(points), -1) for each in influences)
    strongest = joints[np.arange(len(points)), weights.argmax(axis=1)]
    order = query.GetJointOrder()
    if order is not None:
        known = np.array([index.get(str(token), -1) for token in order])
        strongest = known[strongest]
    bind = np.array(query.GetGeomBindTransform())
    return _Mesh(points @ bind[:3, :3] + bind[3, :3], strongest, counts, corners)


def _following(mesh: _Mesh, joint: int) -> Part | None:
    """Return the faces whose corners all follow a joint."""
    face_of = np.repeat(np.arange(len(mesh.counts)), mesh.counts)
    others = np.bincount(face_of, mesh.joints[mesh.corners] != joint, len(mesh.counts))
    kept = others == 0
    if not kept.any():
        return None
    corners = mesh.corners[kept[face_of]]
    used, corners = np.unique(corners, return_inverse=True)
    return Part(mesh.points[used], mesh.counts[kept], corners)


def _joined(parts: list[Part]) -> Part:
    firsts = np.cumsum([0, *(len(part.points) for part in parts[:-1])])
    return Part(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.counts for part in parts]),
        np.concatenate([part.corners + first for part, first in zip(parts, firsts, strict=True)]),
    )


def _reduced(part: Part) -> Part | None:
    """Return a part, or its hull where it has many points; None where that is flat."""
    if len(part.points) <= _MOST_POINTS:
        return part
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(part.points)
    except QhullError:
        return None
    faces = part.points[hull.simplices]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    inwards = (normals * hull.equations[:, :3]).sum(axis=1) < 0.0
    simplices = np.where(inwards[:, None], hull.simplices[:, ::-1], hull.simplices)
    used, corners = np.unique(simplices, return_inverse=True)
    return Part(part.points[used], np.full(len(simplices), 3), corners.ravel())

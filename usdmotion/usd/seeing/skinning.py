"""Which surfaces skeletons move, and where UsdSkel puts them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt

from usdmotion.arrays import Floats, Ints

_EVERYTHING = Usd.TraverseInstanceProxies()


@dataclass(frozen=True, eq=False)
class Skin:
    """What of UsdSkel moves one surface."""

    cache: UsdSkel.Cache
    """Holds what the queries are answered from."""
    prim: Usd.Prim
    """The Skeleton; inside an instance the query knows only what all instances share."""
    skeleton: UsdSkel.SkeletonQuery
    surface: UsdSkel.SkinningQuery

    @property
    def path(self) -> str:
        """Path of the Skeleton."""
        return str(self.prim.GetPath())

    @property
    def joints(self) -> Ints:
        """The joints of the skeleton that have any weight at all, by their numbers."""
        influences = self.surface.ComputeJointInfluences(Usd.TimeCode.EarliestTime())
        if influences is None:
            return np.zeros(0, dtype=np.int64)
        indices, weights = (np.array(each) for each in influences)
        order, own = self.skeleton.GetJointOrder(), self.surface.GetJointOrder()
        used = np.unique(indices[weights > 0.0]).astype(np.int64)
        if own is None:
            return used
        known = {str(token): number for number, token in enumerate(order)}
        found = [known.get(str(own[int(each)]), -1) for each in used]
        return np.array([each for each in found if each >= 0], dtype=np.int64)

    def placed(self, points: Floats, time_code: float) -> Floats | None:
        """Return where points of the surface are in the world; None where UsdSkel does not say.

        Args:
            points: In the frame of the surface, before anything moves them, (point_count, 3).
            time_code: When.
        """
        time = Usd.TimeCode(time_code)
        transforms = self.skeleton.ComputeSkinningTransforms(time)
        if not transforms:
            return None
        space = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(self.prim))
        if not UsdGeom.PointBased(self.surface.GetPrim()):
            matrix = self.surface.ComputeSkinnedTransform(transforms, time)
            moved = _under(points, np.array(Gf.Matrix4d(matrix)))
        else:
            array = self._shaped(Vt.Vec3fArray.FromNumpy(points.astype(np.float32)), time)
            if self.surface.HasJointInfluences() and not self.surface.ComputeSkinnedPoints(
                transforms, array, time
            ):
                return None
            moved = np.array(array, dtype=np.float64)
        return _under(moved, space)

    def _shaped(self, points: Vt.Vec3fArray, time: Usd.TimeCode) -> Vt.Vec3fArray:
        """Return points as blend shapes deform them, before any joint does."""
        animation = self.skeleton.GetAnimQuery()
        if not (self.surface.HasBlendShapes() and animation):
            return points
        weights = animation.ComputeBlendShapeWeights(time)
        mapper = self.surface.GetBlendShapeMapper()
        if weights is None or not len(weights):
            return points
        if mapper is not None:
            weights = mapper.Remap(weights)
        shapes = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(self.surface.GetPrim()))
        if weights is None or len(weights) != shapes.GetNumBlendShapes():
            return points
        shares = shapes.ComputeSubShapeWeights(weights)
        shapes.ComputeDeformedPoints(
            *shares,
            shapes.ComputeBlendShapePointIndices(),
            shapes.ComputeSubShapePointOffsets(),
            points,
        )
        return points


def skins_of(stage: Usd.Stage) -> Mapping[str, Skin]:
    """Return what moves surfaces of a stage, by the paths of the surfaces."""
    return {str(skin.surface.GetPrim().GetPath()): skin for skin in _skins(stage)}


def _skins(stage: Usd.Stage) -> Iterator[Skin]:
    cache = UsdSkel.Cache()
    for prim in Usd.PrimRange.Stage(stage, _EVERYTHING):
        root = UsdSkel.Root(prim)
        if not root:
            continue
        cache.Populate(root, _EVERYTHING)
        for binding in cache.ComputeSkelBindings(root, _EVERYTHING):
            skeleton = binding.GetSkeleton()
            query = cache.GetSkelQuery(skeleton)
            for target in binding.GetSkinningTargets() if query else ():
                yield Skin(cache, skeleton.GetPrim(), query, target)


def _under(points: Floats, matrix: Floats) -> Floats:
    return np.asarray(points @ matrix[:3, :3] + matrix[3, :3])

"""The surfaces of a stage, time by time."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.guides import is_segment_guide
from usdmotion.usd.relations import is_a
from usdmotion.usd.seeing.gprims import read_gprim
from usdmotion.usd.seeing.instancers import scattered
from usdmotion.usd.seeing.looks import color_of, is_visible, opacity_of, purposes_of
from usdmotion.usd.seeing.seen import SeenSurface
from usdmotion.usd.seeing.skinning import Skin, skins_of
from usdmotion.usd.shot import Facts

_EVERYTHING = Usd.TraverseInstanceProxies()


@dataclass(frozen=True, eq=False)
class Sight:
    """A stage that is looked at."""

    stage: Usd.Stage
    facts: Facts
    skins: Mapping[str, Skin]
    """What moves surfaces, by their paths."""
    prims: tuple[Usd.Prim, ...]
    """The surfaces, and the instancers, that there are."""
    notes: dict[str, str] = field(default_factory=dict)
    """One sentence for each path of what cannot be drawn, as it turns up."""

    @classmethod
    def of(cls, stage: Usd.Stage, facts: Facts) -> "Sight":
        """Return the sight of a stage."""
        prims = list(_drawn(stage))
        purposes = purposes_of(prims)
        fit = (each for each in prims if UsdGeom.Imageable(each).ComputePurpose() in purposes)
        return cls(stage, facts, skins_of(stage), tuple(fit))

    def surfaces(self, time_code: float) -> tuple[SeenSurface, ...]:
        """Return the surfaces that are not hidden at a time."""
        found: list[SeenSurface] = []
        for prim in self.prims:
            if is_visible(prim, time_code):
                try:
                    found += self._seen(prim, time_code)
                except SceneError as error:
                    self.notes[str(prim.GetPath())] = f"{error}, and is not drawn"
        return tuple(found)

    def _seen(self, prim: Usd.Prim, time_code: float) -> Iterator[SeenSurface]:
        if is_a(prim, "UsdGeomPointInstancer"):
            yield from self._scattered(prim, time_code)
            return
        shape = read_gprim(prim, time_code)
        opacity = opacity_of(prim, time_code)
        if shape is None or opacity <= 0.0:
            return
        points, triangles = shape
        skin = self.skins.get(str(prim.GetPath()))
        moved = skin.placed(points, time_code) if skin is not None else None
        if moved is None:
            skin, moved = None, _under(points, _world(prim, time_code))
        yield SeenSurface(
            path=str(prim.GetPath()),
            points=moved * self.facts.meters_per_unit,
            triangles=triangles,
            color=color_of(prim, time_code),
            opacity=opacity,
            skeleton=skin.path if skin else "",
            joints=skin.joints if skin else None,
            sketch=skin is not None and is_segment_guide(triangles),
        )

    def _scattered(self, instancer: Usd.Prim, time_code: float) -> Iterator[SeenSurface]:
        for prototype, matrices in scattered(instancer, time_code):
            above = np.linalg.inv(_world(prototype, time_code))
            for prim in Usd.PrimRange(
                prototype, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)
            ):
                shape = read_gprim(prim, time_code) if UsdGeom.Gprim(prim) else None
                if shape is None or not is_visible(prim, time_code):
                    continue
                local = _under(shape[0], _world(prim, time_code) @ above)
                points = np.concatenate([_under(local, matrix) for matrix in matrices])
                firsts = len(local) * np.arange(len(matrices))
                yield SeenSurface(
                    path=str(instancer.GetPath()),
                    points=points * self.facts.meters_per_unit,
                    triangles=(firsts[:, None, None] + shape[1]).reshape(-1, 3),
                    color=color_of(prim, time_code),
                    opacity=opacity_of(prim, time_code),
                )


def _drawn(stage: Usd.Stage) -> Iterator[Usd.Prim]:
    """Yield surfaces and instancers, but not what instancers scatter, nor guides."""
    prims = iter(Usd.PrimRange.Stage(stage, _EVERYTHING))
    for prim in prims:
        imageable = UsdGeom.Imageable(prim)
        if imageable and imageable.GetPurposeAttr().Get() == UsdGeom.Tokens.guide:
            prims.PruneChildren()
        elif is_a(prim, "UsdGeomPointInstancer"):
            prims.PruneChildren()
            yield prim
        elif is_a(prim, "UsdGeomGprim"):
            yield prim


def _world(prim: Usd.Prim, time_code: float) -> Floats:
    return np.array(UsdGeom.XformCache(Usd.TimeCode(time_code)).GetLocalToWorldTransform(prim))


def _under(points: Floats, matrix: Floats) -> Floats:
    return np.asarray(points @ matrix[:3, :3] + matrix[3, :3])

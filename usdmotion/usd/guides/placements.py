"""Where guides stand, so that places in the world can be written below prims that are moved."""

import math
from dataclasses import dataclass, field

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import thinned
from usdmotion.usd.clips import merged
from usdmotion.usd.detections.trajectories import moves_at
from usdmotion.usd.guides.prims import PLACED, WORLD, make, place
from usdmotion.usd.guides.sheets import Sheet, author_home
from usdmotion.usd.layers import over, set_value, set_varying
from usdmotion.usd.relations import edit_of
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import is_still, world_matrices

_TYPES = Sdf.ValueTypeNames
_AROUND = 2.5
"""How far from a prim that moves, at most, what is below it is drawn [m]."""
_NEAR = 1e-3
"""How far that may be from its place [m]."""


@dataclass(frozen=True, eq=False)
class Placement:
    """A transform for a prim, still or moving."""

    matrices: Floats
    """For row vectors, shape (count, 4, 4)."""
    codes: Floats
    """Time codes of the stage, shape (count,); one matrix is for all times."""

    @property
    def is_identity(self) -> bool:
        """Whether it says nothing."""
        return len(self.matrices) == 1 and bool(np.allclose(self.matrices[0], np.eye(4)))


def placement(prim: Usd.Prim, onto: Usd.Prim | None = None) -> Placement:
    """Return what brings what is below a prim into another frame.

    Args:
        prim: The prim.
        onto: Whose frame; None is the world's.
    """
    times = _times((prim, onto))
    places = world_matrices(prim, times)
    above = np.eye(4)[None] if onto is None else world_matrices(onto, times)
    matrices = np.asarray(above @ np.linalg.inv(places))
    if len(matrices) == 1 or is_still(matrices):
        return Placement(matrices[:1], times[:1])
    unit = UsdGeom.GetStageMetersPerUnit(prim.GetStage())
    low, high = places[:, 3, :3].min(axis=0), places[:, 3, :3].max(axis=0)
    box = np.where(list(np.ndindex(2, 2, 2)), high + _AROUND / unit, low - _AROUND / unit)
    corners = np.concatenate([box, np.ones((8, 1))], axis=1) @ np.linalg.inv(above[0])
    shown = (corners @ matrices)[..., :3]
    scale = np.linalg.norm(places[0, 0, :3])
    kept = thinned(times, shown, _NEAR / (unit * scale))
    return Placement(matrices[kept], times[kept])


def author_placement(sheet: Sheet, prim: Sdf.PrimSpec, placed: Placement) -> None:
    """Give a spec a transform."""
    if len(placed.matrices) == 1:
        if not placed.is_identity:
            place(prim, placed.matrices[0])
        return
    codes = sheet.own_codes(placed.codes).tolist()
    samples = {
        code: Gf.Matrix4d(_short(matrix).tolist())
        for code, matrix in zip(codes, placed.matrices, strict=True)
    }
    set_varying(prim, PLACED, _TYPES.Matrix4d, samples)
    set_value(prim, "xformOpOrder", _TYPES.TokenArray, Vt.TokenArray([PLACED]))


@dataclass(frozen=True, eq=False)
class Standing:
    """How what stands below a prim comes to have the frame of the world."""

    placed: Placement
    shared: str = ""
    """The class that does it for all that is below an edit; "" where the prim is moved itself."""

    def author(self, sheet: Sheet, prim: Sdf.PrimSpec) -> None:
        """Give a spec below that prim the frame of the world, whatever it had."""
        prim.inheritPathList.ClearEdits()
        _clear(prim)
        if self.placed.is_identity:
            return
        if self.shared:
            prim.inheritPathList.Prepend(Sdf.Path(self.shared))
        else:
            author_placement(sheet, prim, self.placed)


@dataclass(frozen=True, eq=False)
class Worlds:
    """Finds the way to the frame of the world from any prim, and writes it once for each edit."""

    sheet: Sheet
    _shared: dict[str, Placement] = field(default_factory=dict)
    """What the classes are that were asked for, by the paths of the guides of the edits."""

    def standing(self, owner: Usd.Prim) -> Standing:
        """Return how what stands below a prim comes to have the frame of the world.

        Args:
            owner: An edit, or a prim anywhere.
        """
        edit = edit_of(owner)
        if edit is None or _is_moved(owner, edit):
            return Standing(placement(owner))
        home = self.sheet.home(str(edit.GetPath()))
        if home not in self._shared:
            self._shared[home] = placement(edit)
        return Standing(self._shared[home], f"{home}/{WORLD}")

    def author(self) -> None:
        """Write the classes, before anything refers to them."""
        for home, placed in self._shared.items():
            if not placed.is_identity:
                author_home(self.sheet, home)
                prim = over(self.sheet.layer, f"{home}/{WORLD}")
                _clear(prim)
                make(prim, "Xform")
                prim.specifier = Sdf.SpecifierClass
                author_placement(self.sheet, prim, placed)


def _clear(prim: Sdf.PrimSpec) -> None:
    """Take the transform from a spec that has one from before."""
    for name in (PLACED, "xformOpOrder"):
        if name in prim.attributes:
            prim.RemoveProperty(prim.attributes[name])


def _is_moved(prim: Usd.Prim, edit: Usd.Prim) -> bool:
    """Tell whether a prim may be elsewhere than its edit."""
    while prim and prim != edit:
        if UsdGeom.Xformable(prim):
            return True
        prim = prim.GetParent()
    return False


def _times(prims: tuple[Usd.Prim | None, ...]) -> Floats:
    """Return time codes at which to look: where transforms have samples, and every frame meanwhile.

    Before the first of them and after the last nothing moves any more.
    """
    own: list[list[float]] = []
    for prim in prims:
        while prim and not prim.IsPseudoRoot():
            xform = UsdGeom.Xformable(prim)
            if xform and xform.TransformMightBeTimeVarying():
                facts = read_facts(prim.GetStage())
                own += [moves_at(op.GetAttr(), facts) for op in xform.GetOrderedXformOps()]
            prim = prim.GetParent()
    return merged([*own, _frames(merged(own), facts)]) if own else np.zeros(1)


def _frames(samples: Floats, facts: Facts) -> Floats:
    """Return the frames of a stage, and those around samples beyond its range."""
    ends = [code for code in (facts.start, facts.end) if code is not None]
    ends += [samples[0], samples[-1]] if len(samples) else []
    if not ends:
        return np.zeros(1)
    step = facts.time_codes_per_second / facts.frames_per_second
    first = ends[0] + step * math.floor((min(ends) - ends[0]) / step)
    return np.asarray(np.arange(first, max(ends) + 0.5 * step, step))


def _short(matrix: Floats) -> Floats:
    """Return a matrix without digits that nobody sees."""
    short = np.array(matrix)
    for part in (short[:3, :3], short[3, :3]):
        size = max(float(np.abs(part).max()), 1e-3)
        part[:] = np.round(part, max(0, 8 - math.ceil(math.log10(size)))) + 0.0
    return short

"""Where guides stand, so that places in the world can be written below prims that are moved."""

import math
from dataclasses import dataclass

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import thinned
from usdmotion.usd.clips import merged
from usdmotion.usd.guides.prims import PLACED, WORLD, make, place
from usdmotion.usd.guides.sheets import Sheet
from usdmotion.usd.layers import over, set_value, set_varying
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import is_still, world_matrices

_TYPES = Sdf.ValueTypeNames
_NEAR = 2e-4
"""How far a guide may be from its place below what moves, over the size of what is drawn."""


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


def placement(
    prim: Usd.Prim, codes: Floats, box: Floats, onto: Usd.Prim | None = None
) -> Placement:
    """Return what brings what is below a prim into another frame.

    Args:
        prim: The prim.
        codes: Time codes that matter, ascending.
        box: Corners of what is drawn, in that frame, shape (corner_count, 3).
        onto: Whose frame; None is the world's.
    """
    times = _times((prim, onto), codes)
    below = np.linalg.inv(world_matrices(prim, times))
    above = np.eye(4)[None] if onto is None else world_matrices(onto, times)
    matrices = np.asarray(above @ below)
    if len(matrices) == 1 or is_still(matrices):
        return Placement(matrices[:1], times[:1])
    corners = np.concatenate([box, np.ones((len(box), 1))], axis=1) @ matrices
    shown = corners[..., :3]
    size = np.linalg.norm(np.ptp(shown, axis=1), axis=1).max()
    kept = thinned(times, shown, _NEAR * size)
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


def author_world(sheet: Sheet, home: str, placed: Placement) -> None:
    """Write the class whose frame is the world's, unless nothing needs it."""
    if not placed.is_identity:
        prim = over(sheet.layer, f"{home}/{WORLD}")
        make(prim, "Xform")
        prim.specifier = Sdf.SpecifierClass
        author_placement(sheet, prim, placed)


def put_in_world(prim: Sdf.PrimSpec, home: str, placed: Placement) -> None:
    """Let a spec below an edit have the world's frame, by the class in the edit's guides."""
    if not placed.is_identity:
        prim.inheritPathList.Prepend(Sdf.Path(f"{home}/{WORLD}"))


def _times(prims: tuple[Usd.Prim | None, ...], codes: Floats) -> Floats:
    """Return time codes at which to look: those given, every sample of a transform, every frame."""
    own: list[Floats] = [codes]
    for prim in prims:
        while prim and not prim.IsPseudoRoot():
            xform = UsdGeom.Xformable(prim)
            if xform and xform.TransformMightBeTimeVarying():
                own.append(np.array(xform.GetTimeSamples()))
                own.append(_frames(prim.GetStage()))
            prim = prim.GetParent()
    return merged(own)


def _frames(stage: Usd.Stage) -> Floats:
    facts = read_facts(stage)
    if facts.start is None or facts.end is None:
        return np.zeros(0)
    step = facts.time_codes_per_second / facts.frames_per_second
    return np.asarray(np.arange(facts.start, facts.end + 0.5 * step, step))


def _short(matrix: Floats) -> Floats:
    """Return a matrix without digits that nobody sees."""
    short = np.array(matrix)
    for part in (short[:3, :3], short[3, :3]):
        size = max(float(np.abs(part).max()), 1e-3)
        part[:] = np.round(part, max(0, 8 - math.ceil(math.log10(size)))) + 0.0
    return short

"""How an object moves in the world: a joint, or any prim that has a transform."""

from dataclasses import dataclass

import numpy as np
from pxr import Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.usd.clips import merged
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import rigid, world_matrices

_LONGEST = 0.1
"""Where samples are farther apart than this [s], what USD shows between them is looked at too."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """An object's frame in the world over time."""

    time_codes: Floats
    """When, shape (frame_count,)."""
    translations: Floats
    """World position [m], shape (frame_count, 3)."""
    rotations: Floats
    """World orientation, without scale, xyzw, shape (frame_count, 4)."""
    points: Floats
    """Points that stand for its size, in its frame [m], shape (point_count, 3)."""
    units: Floats
    """Metres per unit along the axes of the frame, shape (frame_count or 1, 3)."""
    ground: float
    """Height of the ground along the up axis [m]; not a number where nobody knows."""

    def units_at(self, time_code: float) -> Floats:
        """Return metres per unit along the axes at about a time, shape (3,)."""
        return np.asarray(self.units[min(self.frame(time_code), len(self.units) - 1)])

    def frame(self, time_code: float) -> int:
        """Return the frame that is nearest to a time."""
        return int(np.abs(self.time_codes - time_code).argmin())


def read_trajectory(prim: Usd.Prim, facts: Facts, *, still: bool = False) -> Trajectory:
    """Return how a prim moves.

    Args:
        prim: The prim.
        facts: Units and rates of the stage.
        still: Whether it may be one that does not.

    Raises:
        SceneError: It does not move, or is sheared or mirrored.
    """
    name = f"<{prim.GetPath()}>"
    own = _own_times(prim, facts)
    codes = filled(own, facts) if len(own) > 1 else np.array([facts.start or 0.0])
    translations, rotations, scales = rigid(world_matrices(prim, codes), name)
    if len(own) < 2 or len(translations) < len(codes):
        if not still:
            raise SceneError(f"{name} does not move; name a prim that is animated, or one below it")
        codes = codes[:1]
    units = scales * facts.meters_per_unit
    return Trajectory(
        time_codes=codes,
        translations=translations * facts.meters_per_unit,
        rotations=rotations,
        points=_corners(prim, codes[0]) * units[0],
        units=units,
        ground=float("nan"),
    )


def filled(codes: Floats, facts: Facts) -> Floats:
    """Return time codes with some between those that are far apart, as even as can be."""
    longest = max(_LONGEST, 1.0 / facts.frames_per_second)
    gaps = np.diff(codes) / facts.time_codes_per_second
    if not (gaps > longest + 1e-9).any():
        return codes
    parts = np.where(gaps > longest + 1e-9, np.ceil(gaps * facts.frames_per_second - 1e-6), 1)
    pieces = [
        np.linspace(first, last, int(count), endpoint=False)
        for first, last, count in zip(codes[:-1], codes[1:], parts, strict=True)
    ]
    return np.concatenate([*pieces, codes[-1:]])


def moves_at(attribute: Usd.Attribute, facts: Facts) -> list[float]:
    """Return the time codes of an attribute's samples, or the first and the last of a spline."""
    if not attribute.HasSpline():
        return [float(code) for code in attribute.GetTimeSamples()]
    # What a spline shows is between its knots as well.
    knots = list(attribute.GetSpline().GetKnots().keys())
    first = min(knots) if facts.start is None else facts.start
    last = max(knots) if facts.end is None else facts.end
    return [first, last] if last > first else []


def _own_times(prim: Usd.Prim, facts: Facts) -> Floats:
    """Return the time codes at which a prim or one above it has a sample of its transform."""
    times: list[list[float]] = [[]]
    while prim and not prim.IsPseudoRoot():
        xform = UsdGeom.Xformable(prim)
        for op in xform.GetOrderedXformOps() if xform else ():
            times.append(moves_at(op.GetAttr(), facts))
        if xform and xform.GetResetXformStack():
            break
        prim = prim.GetParent()
    return merged(times)


def _corners(prim: Usd.Prim, code: float) -> Floats:
    """Return the corners of the box around a prim in its own frame and units, its origin if none.

    Shape (point_count, 3).
    """
    shown = [UsdGeom.Tokens.default_, UsdGeom.Tokens.proxy, UsdGeom.Tokens.render]
    cache = UsdGeom.BBoxCache(Usd.TimeCode(code), shown, useExtentsHint=True)
    found = []
    # The box of what stands above shapes is along the world's axes; each shape's own is not.
    for each in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()):
        if each.IsA(UsdGeom.Boundable):
            box = cache.ComputeRelativeBound(each, prim)
            if not box.GetRange().IsEmpty():
                matrix, extent = box.GetMatrix(), box.GetRange()
                found += [matrix.Transform(extent.GetCorner(corner)) for corner in range(8)]
    if not found:
        return np.zeros((1, 3))
    low, high = np.min(found, axis=0), np.max(found, axis=0)
    return np.asarray(np.where(list(np.ndindex(2, 2, 2)), high, low))

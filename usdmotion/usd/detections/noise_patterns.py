"""The noise pattern of a detection: splines of USD over time codes, in stage units."""

from itertools import pairwise
from typing import Any

import numpy as np
from pxr import Ts, Usd, Vt

from usdmotion.arrays import Floats
from usdmotion.curves import Spline
from usdmotion.detecting import NoisePattern
from usdmotion.usd.attribute_authoring import time_code_array
from usdmotion.usd.clips import merged
from usdmotion.usd.detections.contact_prims import MEMORY
from usdmotion.usd.faults.detections import EPSILON, SIGMA, says_pattern
from usdmotion.usd.relations import floats
from usdmotion.usd.shot import Facts

_SAME = 1e-9
"""Values of curves that differ by less were not changed."""


def read_pattern(prim: Usd.Prim, time_codes: Floats, facts: Facts) -> NoisePattern | None:
    """Return the noise pattern that a detection carries, None where it has none of its own.

    One that was estimated, and is as it was written, is not its own: it is estimated anew.

    Args:
        prim: The MotionDetection.
        time_codes: The frames; the splines go through what is shown on each of them.
        facts: Units and rates of the stage.
    """
    if not has_pattern(prim) or _is_estimate(prim):
        return None
    seconds = (time_codes - time_codes[0]) / facts.time_codes_per_second
    sigma, epsilon = (_values(prim, name, time_codes) for name in (SIGMA, EPSILON))
    return NoisePattern(
        Spline.through(seconds, sigma),
        Spline.through(seconds, epsilon * facts.meters_per_unit),
    )


def has_pattern(prim: Usd.Prim) -> bool:
    """Tell whether a detection says how much both σ and ε may be."""
    return all(says_pattern(prim, name) for name in (SIGMA, EPSILON))


def author_pattern(
    prim: Usd.Prim, pattern: NoisePattern, first: float, facts: Facts, *, estimated: bool
) -> None:
    """Give a detection its noise pattern.

    Args:
        prim: The MotionDetection.
        pattern: The pattern, in metres and seconds.
        first: Time code at which seconds start.
        facts: Units and rates of the stage.
        estimated: Whether it was told from the motion alone, so that it may be told again.
    """
    scales = ((SIGMA, pattern.sigma, 1.0), (EPSILON, pattern.epsilon, facts.meters_per_unit))
    for name, spline, unit in scales:
        prim.GetAttribute(name).SetSpline(_of_usd(spline, unit, first, facts))
    codes = _memorable(prim) if estimated else np.zeros(0)
    memory = {
        "times": time_code_array(codes),
        "sigma": Vt.DoubleArray.FromNumpy(_values(prim, SIGMA, codes)),
        "epsilon": Vt.DoubleArray.FromNumpy(_values(prim, EPSILON, codes)),
    }
    prim.SetCustomDataByKey(f"{MEMORY}:estimate", memory)


def _of_usd(spline: Spline, unit: float, first: float, facts: Facts) -> Any:
    """Return a spline of USD: the tangents of a cubic Hermite are a third as wide as its span."""
    rate = facts.time_codes_per_second
    codes = first + spline.times * rate
    widths = np.diff(codes) / 3.0
    before, after = np.append(0.0, widths), np.append(widths, 0.0)
    shown = Ts.Spline("double")
    for index, code in enumerate(codes):
        knot = Ts.Knot(
            typeName="double",
            time=float(code),
            value=float(spline.values[index] / unit),
            nextInterp=Ts.InterpCurve,
        )
        slope = float(spline.slopes[index] / unit / rate)
        knot.SetPreTanWidth(float(before[index]))
        knot.SetPostTanWidth(float(after[index]))
        knot.SetPreTanSlope(slope)
        knot.SetPostTanSlope(slope)
        shown.SetKnot(knot)
    return shown


def _values(prim: Usd.Prim, name: str, codes: Floats) -> Floats:
    attribute = prim.GetAttribute(name)
    return np.array([attribute.Get(Usd.TimeCode(code)) for code in codes], dtype=np.float64)


def _memorable(prim: Usd.Prim) -> Floats:
    """Return the time codes that tell two patterns apart: those of all knots, and between them."""
    found = []
    for name in (SIGMA, EPSILON):
        knots = list(prim.GetAttribute(name).GetSpline().GetKnots().keys())
        found += [knots, [0.5 * (one + other) for one, other in pairwise(knots)]]
    return merged(found)


def _is_estimate(prim: Usd.Prim) -> bool:
    """Tell whether a pattern is the estimate that was written, and nobody has changed it."""
    memory = prim.GetCustomDataByKey(f"{MEMORY}:estimate") or {}
    codes = np.array(floats(memory.get("times", ())))
    splines = all(prim.GetAttribute(name).HasSpline() for name in (SIGMA, EPSILON))
    if not splines or not len(codes):
        return False
    now = _memorable(prim)
    if len(now) != len(codes) or not np.allclose(now, codes):
        return False
    return all(
        np.allclose(_values(prim, name, codes), memory.get(key, ()), rtol=_SAME, atol=_SAME)
        for name, key in ((SIGMA, "sigma"), (EPSILON, "epsilon"))
    )

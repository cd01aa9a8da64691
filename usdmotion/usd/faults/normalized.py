"""Normalized motions that are not those of a whole body."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.s4d import lacking
from usdmotion.usd.faults.fault import Fault, error
from usdmotion.usd.relations import mistyped, value

NEEDED = tuple(
    f"usdmotion:{name}"
    for name in (
        "limbs",
        "limbFrames",
        "limbLengths",
        "limbTwists",
        "segments",
        "segmentRotations",
        "spine",
        "rootPosition",
        "rootHeading",
        "rootOrientation",
    )
)
"""What every body has; what the schema falls back to is the motion of nobody."""

_TOLD = 4
"""How many of these are listed."""


def find_partial_motions(prim: Usd.Prim) -> Iterator[Fault]:
    """Find normalized motions that lack an array, a limb or a part that every body has."""
    missing = [name for name in NEEDED if not prim.GetAttribute(name).HasAuthoredValue()]
    if missing:
        rest = f" and {len(missing) - _TOLD} more" if len(missing) > _TOLD else ""
        yield error(
            prim,
            "PartialMotion",
            f"has no {', '.join(missing[:_TOLD])}{rest}; normalize the motion again",
        )
        return
    if any(mistyped(prim.GetAttribute(name)) for name in NEEDED):
        return  # that is told by itself
    limbs, segments = (value(prim, f"usdmotion:{each}", ()) for each in ("limbs", "segments"))
    spine = prim.GetAttribute("usdmotion:spine")
    codes = spine.GetTimeSamples() or [Usd.TimeCode.Default()]
    for points in sorted({len(spine.Get(code) or ()) for code in codes}):
        what = lacking(limbs, segments, points)
        if what:
            yield error(prim, "PartialMotion", what)
            return

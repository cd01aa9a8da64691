"""The faults that concern what is solved: errors refuse it, warnings go with the answer."""

from collections.abc import Iterable

from pxr import Usd

from usdmotion.usd.drawn import without_guides
from usdmotion.usd.faults import CHECKS, Fault
from usdmotion.usd.relations import is_a

_ELSEWHERE = ("Animation", "Recruiting")
"""Checks that read whole animations: reading does that itself, and so does mending."""


def concerns(top: Usd.Prim) -> list[Fault]:
    """List the faults of an edit and everything below it, or of another prim alone."""
    below = without_guides(Usd.PrimRange(top))
    prims = below if is_a(top, "UsdMotionEdit") else iter([top])
    return [
        fault
        for prim in prims
        for check in CHECKS
        if check.name not in _ELSEWHERE and check.concerns(prim)
        for fault in check.find(prim)
    ]


def warnings(
    edits: Iterable[Usd.Prim], players: Iterable[tuple[Usd.Prim, Usd.Prim | None]]
) -> tuple[str, ...]:
    """Return a sentence about each thing that is probably not meant.

    Args:
        edits: The edits that are solved.
        players: The skeletons that take part, and the animation that each is read from.
    """
    found = [fault for edit in edits for fault in concerns(edit)]
    for skeleton, animation in players:
        # What starts from an animation of its own has none bound until its result is.
        named = () if animation is None else ("NoAnimation",)
        found += [fault for fault in concerns(skeleton) if fault.name not in named]
        found += concerns(animation) if animation is not None else []
    sentences = (fault.sentence for fault in found if fault.severity == "warning")
    return tuple(dict.fromkeys(sentences))

"""Joints that are rigidly connected, as an ankle and the ball of its foot, and their contacts."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, rotate
from usdmotion.usd.detections.entries import Entry
from usdmotion.usd.detections.searches import Sought

if TYPE_CHECKING:
    from usdmotion.usd.detections.authoring import Authored

_RIGID = 1e-4
"""How far an offset of two joints may change while they count as rigidly connected [m]."""
_ORIGIN = 1e-9
"""A held point this near to the origin of its joint is the origin [m]."""

Key = tuple[int, int]
"""Index of the object, and of its entry."""
Offsets = dict[tuple[int, int], Floats]
"""Where a joint is in the frame of one that carries it [m], by the indices of both objects."""


@dataclass(frozen=True, eq=False)
class Link:
    """A contact of a frame, and one of a joint that the frame carries, which hold together."""

    frame: Key
    carried: Key
    offset: Floats
    """Where the joint is in the frame [m], shape (3,)."""


def held_ones(authored: "Authored") -> Iterator[tuple[int, Entry]]:
    """Yield the entries of which it is known what they hold, and where in all of them they are."""
    for index, entry in enumerate(authored.entries):
        if entry.contact is not None or entry.there is not None:
            yield index, entry


def offsets_of(authored: Sequence["Authored"]) -> Offsets:
    """Return which objects carry which others rigidly, by their indices, and where they are."""
    soughts = [each.found.sought for each in authored]
    found = {
        (above, below): _offset(soughts[above], soughts[below])
        for above in range(len(soughts))
        for below in range(len(soughts))
    }
    return {pair: offset for pair, offset in found.items() if offset is not None}


def links_of(authored: Sequence["Authored"], offsets: Offsets) -> Iterator[Link]:
    """Yield the contacts that hold together, of objects that carry each other."""
    for (above, below), offset in offsets.items():
        for upper, frame in held_ones(authored[above]):
            for lower, carried in held_ones(authored[below]):
                if _holds(frame, carried):
                    yield Link((above, upper), (below, lower), offset)


def _offset(above: Sought, below: Sought) -> Floats | None:
    """Return where a joint is in the frame of one above it, None where that changes or is none."""
    same = above.watched.performer is below.watched.performer is not None
    if not same or not below.watched.joint.startswith(f"{above.watched.joint}/"):
        return None
    frame, point = above.trajectory, below.trajectory
    inside = rotate(conjugate(frame.rotations), point.translations - frame.translations)
    steady = np.ptp(inside, axis=0).max() <= _RIGID
    return np.asarray(inside.mean(axis=0)) if steady else None


def _holds(frame: Entry, carried: Entry) -> bool:
    """Tell whether a frame and the origin of a joint that it carries are held at one time."""
    above, below = frame.held, carried.held
    held = above.kind == "space" and below.kind in ("space", "point")
    origin = max(np.abs(above.point).max(), np.abs(below.point).max()) <= _ORIGIN
    return held and bool(origin) and frame.interval.overlap(carried.interval) >= 0.0

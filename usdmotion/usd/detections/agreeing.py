"""Contacts of joints that are rigidly connected, as those of an ankle and the ball of its foot.

Each is found alone, and where both hold they are millimetres apart: enforced as they are, one of
them would give way, differently while the other one comes and goes.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.detecting import Contact
from usdmotion.kernels import conjugate, rotate, world_points
from usdmotion.usd.detections.entries import SAMPLE, Entry
from usdmotion.usd.detections.searches import Sought

if TYPE_CHECKING:
    from usdmotion.usd.detections.authoring import Authored

_RIGID = 1e-4
"""How far an offset of two joints may change while they count as rigidly connected [m]."""
_ORIGIN = 1e-9
"""A held point this near to the origin of its joint is the origin [m]."""

Key = tuple[int, int]
"""Index of the object, and of its entry."""


@dataclass(frozen=True, eq=False)
class _Link:
    """A contact of a frame, and one of a joint that the frame carries, which hold together."""

    frame: Key
    carried: Key
    offset: Floats
    """Where the joint is in the frame [m], shape (3,)."""


def agreed(authored: Sequence["Authored"]) -> tuple["Authored", ...]:
    """Return what was found with contacts that can hold together.

    A frame that is held carries the joints below it that it is rigidly connected to. Where one of
    these is held as well, both are where a person says, else where the longer contact is. What is
    carried begins and ends without easing while the frame is held, because it is in its place then;
    and it ranks higher, so that it stays when the frame is let go.

    Args:
        authored: What has become of the contacts of each object.
    """
    links = list(_links(authored))
    entries = {(o, e): entry for o, each in enumerate(authored) for e, entry in _on(each)}
    given = [key for key, entry in entries.items() if entry.contact is None]
    longest = sorted(entries, key=lambda key: _length(entries[key]), reverse=True)
    settled = {*given}
    for key in (*given, *longest):
        if key in given or key not in settled:
            _spread(key, links, entries, settled)
    for link in links:
        entries[link.carried] = _uneased(entries[link.carried], entries[link.frame])
    low = {link.frame for link in links}
    for key, entry in entries.items():
        before = authored[key[0]]
        if entry.contact is not before.entries[key[1]].contact:
            entry = replace(entry, contact=_measured(entry, before.found.sought))
        entries[key] = replace(entry, priority=2 if key in low else 1)
    return tuple(
        replace(each, entries=tuple(entries.get((o, e), x) for e, x in enumerate(each.entries)))
        for o, each in enumerate(authored)
    )


def _on(authored: "Authored") -> Iterator[tuple[int, Entry]]:
    """Yield the entries of which it is known what they hold, and where in all of them they are."""
    for index, entry in enumerate(authored.entries):
        if entry.contact is not None or entry.there is not None:
            yield index, entry


def _links(authored: Sequence["Authored"]) -> Iterator[_Link]:
    for above, carrier in enumerate(authored):
        for below, other in enumerate(authored):
            offset = _offset(carrier.found.sought, other.found.sought)
            if offset is None:
                continue
            for upper, frame in _on(carrier):
                for lower, carried in _on(other):
                    if _holds(frame, carried):
                        yield _Link((above, upper), (below, lower), offset)


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
    above, below = _held(frame), _held(carried)
    held = above.kind == "space" and below.kind in ("space", "point")
    origin = max(np.abs(above.point).max(), np.abs(below.point).max()) <= _ORIGIN
    return held and bool(origin) and frame.interval.overlap(carried.interval) >= 0.0


def _held(entry: Entry) -> Contact:
    contact = entry.contact or entry.there
    assert contact is not None
    return contact


def _spread(
    start: Key, links: Sequence[_Link], entries: dict[Key, Entry], settled: set[Key]
) -> None:
    """Bring everything that holds together with a contact to where that says it is."""
    settled.add(start)
    reached = [start]
    while reached:
        here = reached.pop(0)
        for link in links:
            there = {link.frame: link.carried, link.carried: link.frame}.get(here)
            if there is not None and there not in settled:
                settled.add(there)
                reached.append(there)
                entries[there] = _moved(link, entries, there)


def _moved(link: _Link, entries: dict[Key, Entry], there: Key) -> Entry:
    frame, carried = _held(entries[link.frame]), _held(entries[link.carried])
    arm = rotate(frame.orientation, link.offset)
    if there == link.carried:
        return replace(entries[there], contact=replace(carried, location=frame.location + arm))
    return replace(entries[there], contact=replace(frame, location=carried.location - arm))


def _uneased(carried: Entry, frame: Entry) -> Entry:
    """Return a contact that does not ease at an end at which the frame holds it anyhow."""
    first, last = frame.interval.start - SAMPLE, frame.interval.end + SAMPLE
    before, after = carried.eased
    return replace(
        carried,
        eased=(
            0.0 if first <= carried.interval.start <= last else before,
            0.0 if first <= carried.interval.end <= last else after,
        ),
    )


def _measured(entry: Entry, sought: Sought) -> Contact:
    """Return a contact with how far its object is from where it is now."""
    assert entry.contact is not None
    contact, way = entry.contact, sought.trajectory
    codes = way.time_codes
    inside = (codes >= entry.interval.start - SAMPLE) & (codes <= entry.interval.end + SAMPLE)
    held = world_points(way.translations[inside], way.rotations[inside], contact.point)
    apart = np.linalg.norm(held - contact.location, axis=1).max(initial=0.0)
    return replace(contact, residual=float(apart))


def _length(entry: Entry) -> float:
    return entry.interval.end - entry.interval.start

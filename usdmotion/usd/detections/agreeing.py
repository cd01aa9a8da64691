"""Contacts of joints that are rigidly connected, as those of an ankle and the ball of its foot.

Each is found alone, and where both hold they are millimetres apart: enforced as they are, one of
them would give way, differently while the other one comes and goes.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.detecting import Contact
from usdmotion.kernels import rotate, world_points
from usdmotion.usd.detections.easing import eased
from usdmotion.usd.detections.entries import SAMPLE, Entry
from usdmotion.usd.detections.links import Key, Link, held_ones, links_of, offsets_of
from usdmotion.usd.detections.searches import Sought

if TYPE_CHECKING:
    from usdmotion.usd.detections.authoring import Authored


def agreed(authored: Sequence["Authored"]) -> tuple["Authored", ...]:
    """Return what was found with contacts that can hold together.

    A frame that is held carries the joints below it that it is rigidly connected to. Where one of
    these is held as well, both are where a person says, else where the longer contact is. What is
    carried ranks higher, so that it stays when the frame is let go.

    Args:
        authored: What has become of the contacts of each object.
    """
    offsets = offsets_of(authored)
    links = list(links_of(authored, offsets))
    entries = {(o, e): entry for o, each in enumerate(authored) for e, entry in held_ones(each)}
    given = [key for key, entry in entries.items() if entry.contact is None]
    longest = sorted(entries, key=lambda key: entries[key].interval.length, reverse=True)
    settled = {*given}
    for key in (*given, *longest):
        if key in given or key not in settled:
            _spread(key, links, entries, settled)
    entries = eased(authored, entries, links, offsets)
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


def _spread(
    start: Key, links: Sequence[Link], entries: dict[Key, Entry], settled: set[Key]
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


def _moved(link: Link, entries: dict[Key, Entry], there: Key) -> Entry:
    frame, carried = entries[link.frame].held, entries[link.carried].held
    arm = rotate(frame.orientation, link.offset)
    if there == link.carried:
        return replace(entries[there], contact=replace(carried, location=frame.location + arm))
    return replace(entries[there], contact=replace(frame, location=carried.location - arm))


def _measured(entry: Entry, sought: Sought) -> Contact:
    """Return a contact with how far its object is from where it is now."""
    assert entry.contact is not None
    contact, way = entry.contact, sought.trajectory
    codes = way.time_codes
    inside = (codes >= entry.interval.start - SAMPLE) & (codes <= entry.interval.end + SAMPLE)
    held = world_points(way.translations[inside], way.rotations[inside], contact.point)
    apart = np.linalg.norm(held - contact.location, axis=1).max(initial=0.0)
    return replace(contact, residual=float(apart))

"""How contacts come and go: no faster than what is held may be displaced.

A held place is not quite where the motion is, and two that follow each other are not quite one.
From one to the other, and to the motion itself, there has to be time.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import rotate
from usdmotion.usd.detections.entries import SAMPLE, Entry
from usdmotion.usd.detections.links import Key, Link, Offsets
from usdmotion.usd.detections.searches import Sought

if TYPE_CHECKING:
    from usdmotion.usd.detections.authoring import Authored

_EASED = 0.2
"""How long a contact eases in and out at most [s]."""
_PACE = 0.12
"""How fast what is held may go from one place to the next, beside the motion [m/s]."""
_SHARE = 0.4
"""How much of a contact may be given up at one end for the one beside it."""
_ON = ("detected", "template", "own")
"""States of contacts that hold."""

Entries = dict[Key, Entry]


def eased(
    authored: Sequence["Authored"], entries: Entries, links: Sequence[Link], offsets: Offsets
) -> Entries:
    """Return contacts with the times in which they ease.

    Those of one joint, and of joints that are rigidly connected, that follow each other begin and
    end where there is time to go from place to place, and ease within half of what is free. What a
    frame carries does not ease while that is held. The ends of a clip are no reason not to ease.

    Args:
        authored: What has become of the contacts of each object.
        entries: The contacts of which it is known what they hold.
        links: Those that hold together.
        offsets: The objects that carry each other.
    """
    result = {(o, e): entry for o, each in enumerate(authored) for e, entry in _on(each)} | entries
    together = {(link.frame, link.carried) for link in links}
    for before, after in _neighbours(authored, result, offsets):
        _part(before, after, authored, result)
    for link in links:
        result[link.carried] = _reaching(result[link.carried], result[link.frame])
    room = {key: [_longest(authored, key)] * 2 for key in result}
    for before, after in _neighbours(authored, result, offsets):
        if (before, after) in together or (after, before) in together:
            continue
        half = 0.5 * (result[after].interval.start - result[before].interval.end)
        room[before][1] = min(room[before][1], max(half, 0.0))
        room[after][0] = min(room[after][0], max(half, 0.0))
    found = {key: replace(result[key], eased=(room[key][0], room[key][1])) for key in entries}
    for link in links:
        found[link.carried] = _uneased(found[link.carried], found[link.frame])
    return found


def _on(authored: "Authored") -> Iterator[tuple[int, Entry]]:
    for index, entry in enumerate(authored.entries):
        if entry.state in _ON:
            yield index, entry


def _longest(authored: Sequence["Authored"], key: Key) -> float:
    """Return for how many time codes a contact eases at most."""
    return _EASED * authored[key[0]].found.sought.facts.time_codes_per_second


def _neighbours(
    authored: Sequence["Authored"], entries: Entries, offsets: Offsets
) -> list[tuple[Key, Key]]:
    """Return each two contacts of one rigid piece of a body that follow each other soon."""
    found = []
    for before, one in entries.items():
        soon = one.interval.end + 2.0 * _longest(authored, before)
        for after, other in entries.items():
            follows = one.interval.end < other.interval.start + SAMPLE <= soon
            if follows and before != after and _is_one(before[0], after[0], offsets):
                found.append((before, after))
    return found


def _is_one(one: int, other: int, offsets: Offsets) -> bool:
    return one == other or (one, other) in offsets or (other, one) in offsets


def _part(before: Key, after: Key, authored: Sequence["Authored"], entries: Entries) -> None:
    """Let one contact end earlier and the next begin later, if they are too near to each other."""
    one, other = entries[before], entries[after]
    sought = authored[before[0]].found.sought
    known = all(each.contact or each.there for each in (one, other))
    if sought.watched.performer is None or before[0] != after[0] or not known:
        return  # nobody enforces what a prop does
    rate = sought.facts.time_codes_per_second
    gap = other.interval.start - one.interval.end
    lacking = min(_step(one, other, sought) / _PACE, 2.0 * _EASED) * rate - gap
    if lacking > 0.0:
        share = _given(one) / max(_given(one) + _given(other), SAMPLE)
        entries[before] = _shortened(one, sought, 0.0, share * lacking)
        entries[after] = _shortened(other, sought, (1.0 - share) * lacking, 0.0)


def _given(entry: Entry) -> float:
    """Return how much of a contact there is to give up; a person's is as long as he says."""
    return entry.interval.length if entry.contact is not None else 0.0


def _step(one: Entry, other: Entry, sought: Sought) -> float:
    """Return how far what is held goes from the end of a contact to the next, beside the motion."""
    ends = _away(one, one.interval.end, sought), _away(other, other.interval.start, sought)
    return float(np.linalg.norm(ends[1] - ends[0], axis=1).max())


def _away(entry: Entry, time_code: float, sought: Sought) -> Floats:
    """Return how far the points of an object are held from where they are, (point_count, 3)."""
    contact, way = entry.held, sought.trajectory
    frame = way.frame(time_code)
    points = np.concatenate([contact.point[None], way.points])
    here = way.translations[frame] + rotate(way.rotations[frame], points)
    if contact.kind != "space":
        return np.broadcast_to(contact.location - here[0], here.shape)
    held = contact.location + rotate(contact.orientation, points - contact.point)
    return np.asarray(held - here)


def _shortened(entry: Entry, sought: Sought, first: float, last: float) -> Entry:
    """Return a contact that begins and ends by so many time codes later and earlier, at samples."""
    interval, codes = entry.interval, sought.trajectory.time_codes
    most = _SHARE * interval.length
    start = interval.start + min(first, most)
    end = interval.end - min(last, most)
    inside = codes[(codes >= start - SAMPLE) & (codes <= end + SAMPLE)]
    if len(inside) < 2:
        return entry
    changed = replace(
        interval,
        start=float(inside[0]) if first else interval.start,
        end=float(inside[-1]) if last else interval.end,
    )
    return replace(entry, interval=changed)


def _reaching(carried: Entry, frame: Entry) -> Entry:
    """Return a contact that still meets the frame that holds it too, which may be shorter now."""
    interval = carried.interval
    start, end = min(interval.start, frame.interval.end), max(interval.end, frame.interval.start)
    if carried.contact is None:
        return carried
    return replace(carried, interval=replace(interval, start=start, end=end))


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

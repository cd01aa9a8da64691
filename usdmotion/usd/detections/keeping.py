"""What becomes of the contacts that are there when an object is looked at again.

What a person made, changed, marked as an example or switched off stays; what was only detected is
detected anew. Times are time codes; nothing here knows of prims.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

State = Literal["detected", "dropped", "template", "own", "off"]
"""Of a contact that is there: found before and untouched; found before that and not again; an
example; made or changed by a person; switched off."""


@dataclass(frozen=True, slots=True)
class Interval:
    """A stretch of time in which an object is held somehow."""

    kind: str
    start: float
    end: float

    @property
    def length(self) -> float:
        """For how long it is, in time codes."""
        return self.end - self.start

    def overlap(self, other: "Interval") -> float:
        """Return for how long both last; negative is how far they are apart."""
        return min(self.end, other.end) - max(self.start, other.start)

    def covers(self, other: "Interval") -> bool:
        """Tell whether both last together for more than half of the shorter one."""
        shorter = min(self.length, other.length)
        both = self.overlap(other)
        return both >= 0.0 and (both > 0.5 * shorter or shorter == 0.0)


@dataclass(frozen=True, slots=True)
class Known:
    """A contact that is there."""

    name: str
    """Name of its prim; "" of an example that has none yet."""
    state: State
    interval: Interval
    """When it holds; of an example, when somebody says so."""


@dataclass(frozen=True, slots=True)
class Settlement:
    """Where what was found goes, and what goes away."""

    onto: dict[int, int]
    """Which known contact is written again with which one found, by their indices."""
    left_out: dict[int, int]
    """Which one found is not written because of which known one."""
    dropped: tuple[int, ...]
    """Known ones that were not found again."""


def settle(known: Sequence[Known], found: Sequence[Interval]) -> Settlement:
    """Return what becomes of the contacts of one object.

    An example takes the contact of its kind that overlaps it longest. Of the others what overlaps
    something of a person's for more than half of the shorter of the two is left out. What was found
    before takes what is found of its kind with the longest overlap, and so keeps its name.
    """
    onto = _matched(known, found, ("template",), range(len(found)))
    free = [index for index in range(len(found)) if index not in onto]
    # An example that nothing was found in is what a person says, as all that is a person's.
    stays = [
        index
        for index, each in enumerate(known)
        if each.state in ("own", "off") or (each.state == "template" and index not in onto.values())
    ]
    left_out = {
        index: keeper
        for index in free
        for keeper in reversed(stays)
        if known[keeper].interval.covers(found[index])
    }
    free = [index for index in free if index not in left_out]
    onto |= _matched(known, found, ("detected", "dropped"), free)
    dropped = tuple(
        index
        for index, each in enumerate(known)
        if each.state == "detected" and index not in onto.values()
    )
    return Settlement(onto, left_out, dropped)


def _matched(
    known: Sequence[Known],
    found: Sequence[Interval],
    states: tuple[State, ...],
    free: Sequence[int],
) -> dict[int, int]:
    """Return pairs of one kind that overlap, longest first, each in one pair at most."""
    pairs = sorted(
        (
            (known[old].interval.overlap(found[new]), -states.index(known[old].state), old, new)
            for old in range(len(known))
            for new in free
            if known[old].state in states
            and known[old].interval.kind == found[new].kind
            and known[old].interval.overlap(found[new]) >= 0.0
        ),
        key=lambda pair: (-pair[0], -pair[1], pair[2], pair[3]),
    )
    taken: dict[int, int] = {}
    for _, _, old, new in pairs:
        if new not in taken and old not in taken.values():
            taken[new] = old
    return taken

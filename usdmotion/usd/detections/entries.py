"""The contacts of one object as they are after a detection: names, what is written."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.detecting import Contact, Template
from usdmotion.kernels import conjugate, multiply, to_vector
from usdmotion.usd.detections.keeping import Interval, Known, State, settle
from usdmotion.usd.detections.trajectories import Trajectory
from usdmotion.usd.shot import Facts

SAMPLE = 1e-6
"""Time codes this near to a sample's are that sample's."""


@dataclass(frozen=True, eq=False)
class Entry:
    """One contact of an object."""

    name: str
    """Name of its prim."""
    state: State
    interval: Interval
    """When it is fully on, in time codes."""
    contact: Contact | None = None
    """What is written of it; None leaves it as it is."""
    example: Interval | None = None
    """When somebody says that the object is held, of a template."""
    new: bool = False
    """Whether it has no prim yet."""
    found: bool = False
    """Whether a detector has found it now."""
    eased: tuple[float, float] = (0.0, 0.0)
    """For how many time codes it eases in and out."""
    there: Contact | None = None
    """What is held by one that is left as it is, where that can be told."""
    priority: int = 1
    """Its rank among the constraints of its edit, if it is new."""

    @property
    def held(self) -> Contact:
        """What is held, of one of which that is known."""
        contact = self.contact or self.there
        assert contact is not None
        return contact

    @property
    def times(self) -> tuple[float, float, float, float]:
        """Its four key times; those of its easing as text keeps them."""
        start, end = self.interval.start, self.interval.end
        return round(start - self.eased[0], 9), start, end, round(end + self.eased[1], 9)


def entries_of(
    known: Sequence[Known],
    contacts: Sequence[Contact],
    trajectory: Trajectory,
    facts: Facts,
    *,
    names: Sequence[str] = (),
    placeless: Sequence[str] = (),
) -> tuple[tuple[Entry, ...], tuple[str, ...]]:
    """Return what the contacts of an object become, and a sentence about each that is left out.

    Args:
        known: The contacts that are there, and examples that are to be.
        contacts: What was found.
        trajectory: How the object moves.
        facts: Rates of the stage.
        names: Names that prims beside them have.
        placeless: Names of contacts that do not say where they are held.
    """
    found = [interval_of(contact, trajectory, facts) for contact in contacts]
    settled = settle(known, found)
    entries: list[Entry] = []
    notes: list[str] = []
    written = {old: new for new, old in settled.onto.items()}
    for index, each in enumerate(known):
        if index in written:
            entries.append(_written(each, found[written[index]], contacts[written[index]]))
        elif index in settled.dropped:
            entries.append(Entry(each.name, "dropped", each.interval))
        else:
            entries.append(_kept(each, trajectory, each.name in placeless))
            if each.state == "template":
                notes.append(_unconfirmed(each))
    free = [index for index in range(len(found)) if index not in settled.onto]
    for index in free:
        if index in settled.left_out:
            keeper = known[settled.left_out[index]]
            notes.append(_left_out(found[index], keeper))
        else:
            entries.append(
                Entry("", "detected", found[index], contacts[index], new=True, found=True)
            )
    entries.sort(key=lambda entry: (entry.interval.start, entry.interval.end))
    named = _named(entries, [*names, *(each.name for each in known)])
    return tuple(named), tuple(notes)


def interval_of(contact: Contact | Template, trajectory: Trajectory, facts: Facts) -> Interval:
    """Return when a contact or an example holds, in time codes."""
    codes = trajectory.time_codes
    ends = []
    for seconds in (contact.start, contact.end):
        code = float(codes[0] + seconds * facts.time_codes_per_second)
        nearest = float(codes[trajectory.frame(code)])
        ends.append(nearest if abs(nearest - code) < SAMPLE else code)
    return Interval(contact.kind, ends[0], ends[1])


def _written(known: Known, interval: Interval, contact: Contact) -> Entry:
    is_template = known.state == "template"
    return Entry(
        known.name,
        "template" if is_template else "detected",
        interval,
        contact,
        known.interval if is_template else None,
        new=not known.name,
        found=True,
    )


def _kept(known: Known, trajectory: Trajectory, placeless: bool) -> Entry:
    entry = Entry(known.name, known.state, known.interval, new=not known.name)
    if known.state != "template" or (known.name and not placeless):
        return entry
    # It says when and not where: it is where the object is then.
    return replace(entry, contact=_there(known.interval, trajectory), example=known.interval)


def _there(interval: Interval, trajectory: Trajectory) -> Contact:
    frame = trajectory.frame(0.5 * (interval.start + interval.end))
    return Contact(
        kind=interval.kind,
        start=0.0,
        end=0.0,
        point=np.zeros(3),
        location=trajectory.translations[frame],
        orientation=trajectory.rotations[frame],
        axis=_axis(interval, trajectory),
    )


def _axis(interval: Interval, trajectory: Trajectory) -> Floats:
    """Return about what an object turns from one end of an interval to the other, (3,)."""
    ends = [trajectory.rotations[trajectory.frame(c)] for c in (interval.start, interval.end)]
    turn = to_vector(multiply(ends[1], conjugate(ends[0])))
    length = float(np.linalg.norm(turn))
    return np.asarray(turn / length) if length > 1e-6 else np.array([0.0, 0.0, 1.0])


def _named(entries: Sequence[Entry], taken: Sequence[str]) -> list[Entry]:
    """Give those that have no name one, in their order."""
    free = _numbers({*taken})
    return [entry if entry.name else replace(entry, name=next(free)) for entry in entries]


def _numbers(taken: set[str]) -> Iterator[str]:
    number = 0
    while True:
        number += 1
        if f"Contact{number:02d}" not in taken:
            yield f"Contact{number:02d}"


def _unconfirmed(known: Known) -> str:
    return (
        f"nothing was found where {_words(known.interval)} is a template; it stays as it is given"
    )


def _left_out(interval: Interval, keeper: Known) -> str:
    why = "switched off" if keeper.state == "off" else "somebody's own"
    return (
        f"{_words(interval)} was found and left out, because {keeper.name or 'a template'}, from "
        f"{keeper.interval.start:g} to {keeper.interval.end:g}, is {why}"
    )


def _words(interval: Interval) -> str:
    return f"a {interval.kind} contact from {interval.start:g} to {interval.end:g}"

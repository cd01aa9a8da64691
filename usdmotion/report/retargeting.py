"""What became of a motion on another body: a table and JSON."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from rich.table import Table

from usdmotion.cast import Cast
from usdmotion.constraints import ContactConstraint
from usdmotion.motion import WorldPose
from usdmotion.report.normalizing import TravellerReport, travellers_table
from usdmotion.report.planting import slide_cells, slide_of, slide_table
from usdmotion.report.verdict import EditReport, Report


@dataclass(frozen=True)
class SlideReport:
    """How far a joint of a foot slides on either body while it is in contact on the first one.

    The slide of a contact is the largest distance of the joint from its mean place.
    """

    part: str
    """H-Anim name of the joint."""
    contacts: int
    worst_before: float | None
    """Largest slide of a contact on the body that it was recorded on [m]; None where that body is
    not known, as of a file of normalized motions."""
    worst_after: float
    """The same on the other body."""
    mean_before: float | None
    """Mean of the slides of all contacts there [m]."""
    mean_after: float


@dataclass(frozen=True)
class MappedReport:
    """What has a place on the other body."""

    parts: tuple[str, ...]
    """Parts that both bodies have, by their H-Anim names."""
    shared_out: tuple[str, ...]
    """Vertebrae and joints of digits that only one has, which share in what their row does."""
    missing: tuple[str, ...]
    """Parts that move and that the other body has not."""
    carried: tuple[str, ...]
    """Joints that are no part and were carried along by name."""
    left: tuple[str, ...]
    """Those that the other body has not."""
    at_rest: tuple[str, ...]
    """Joints of the other body that nothing moves."""


@dataclass(frozen=True)
class RetargetingReport:
    """A motion on another body."""

    source: str
    """Path of what it was taken from."""
    skeleton: str
    """Path of the Skeleton that it was put on."""
    animation: str
    """Path of the SkelAnimation that was written."""
    edit: str
    """Path of the MotionEdit that was written, "" for none."""
    frames: int
    first: float
    """Time code of the first frame."""
    last: float
    leg_before: float | None
    """Length of a leg of the body that it was taken from [m]; None where nobody says."""
    leg: float
    """Length of a leg of the body that it was put on [m]."""
    mapped: MappedReport
    slides: tuple[SlideReport, ...]
    travellers: tuple[TravellerReport, ...]
    edits: tuple[EditReport, ...]
    """What was solved."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that whoever asked should know."""

    @property
    def met(self) -> bool:
        """Whether every constraint that was enforced was met."""
        return all(row.met for edit in self.edits for row in edit.constraints)

    def to_json(self) -> str:
        """Return the machine-readable form; the fields are its keys."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def tables(self) -> list[Table | str]:
        """Return what people read in a terminal."""
        return [
            *self._sentences(),
            *_slides(self.slides),
            *travellers_table(self.travellers),
            *Report(self.edits).tables(),
        ]

    def _sentences(self) -> Iterator[str]:
        scale = ""
        if self.leg_before is not None:
            scale = f", {self.leg / self.leg_before:.3f} of the {self.leg_before:.3f} m before"
        yield (
            f"<{self.source}> on <{self.skeleton}>: {self.frames} frames from {self.first:g} to "
            f"{self.last:g}; a leg is {self.leg:.3f} m{scale}"
        )
        mapped = self.mapped
        told = (
            (mapped.parts, "parts of the body mapped"),
            (mapped.shared_out, "vertebrae or joints of digits share in their row"),
            (mapped.missing, "parts have no place"),
            (mapped.carried, "other joints carried along by name"),
            (mapped.left, "other joints have no place"),
            (mapped.at_rest, "joints stay at rest"),
        )
        shown = (
            f"{len(names)} {what}" + ("" if names is mapped.parts else f" ({_some(names)})")
            for names, what in told
            if names
        )
        yield "; ".join(shown)


def slides_of(
    before: Cast | None,
    after: Cast,
    solved: WorldPose,
    contacts: Sequence[tuple[str, ContactConstraint | None, ContactConstraint]],
) -> tuple[SlideReport, ...]:
    """Return how feet slide while they are in contact.

    Args:
        before: Who was recorded; None where that is not known.
        after: Who the motion was put on.
        solved: All nodes of that one.
        contacts: The part that each holds, the contact before, the contact after.
    """
    found: dict[str, list[tuple[float, float]]] = {}
    nowhere = float("nan")
    for part, was, now in contacts:
        when = now.plateau(after)
        if not when.any():
            continue
        slid = nowhere
        if before is not None and was is not None:
            slid = slide_of(before, was, when, (before.positions, before.orientations))
        found.setdefault(part, []).append((slid, slide_of(after, now, when, solved)))
    return tuple(_slide(part, np.array(pairs)) for part, pairs in found.items())


def _slide(part: str, pairs: np.ndarray) -> SlideReport:
    (before, after), known = pairs.T, not np.isnan(pairs).any()
    return SlideReport(
        part=part,
        contacts=len(pairs),
        worst_before=float(before.max()) if known else None,
        worst_after=float(after.max()),
        mean_before=float(before.mean()) if known else None,
        mean_after=float(after.mean()),
    )


def _slides(slides: Sequence[SlideReport]) -> list[Table]:
    if not slides:
        return []
    table = slide_table("foot slide during the contacts of the source")
    if any(each.worst_before is None for each in slides):
        table.caption = "—: nobody knows the body that the motion was recorded on"
        table.caption_justify = "left"
    for each in slides:
        lengths = (each.worst_before, each.worst_after, each.mean_before, each.mean_after)
        table.add_row(each.part, *slide_cells(each.contacts, lengths))
    return [table]


def _some(names: Sequence[str]) -> str:
    leaves = [name.rsplit("/", 1)[-1] for name in names]
    return ", ".join(leaves[:4]) + (", …" if len(leaves) > 4 else "")

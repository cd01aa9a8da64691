"""What the status bar says: what happened, in one sentence."""

from collections.abc import Iterable, Sequence

from usdmotion.report import ConstraintReport, Report
from usdmotion.report.contacts import DetectionReport
from usdmotion.report.guides import GuidesReport
from usdmotion.report.wording import amount
from usdmotion.usd import Inspection


def leaf(path: str) -> str:
    """Return the last name of a path."""
    return path.rsplit("/", 1)[-1]


def told_apart(paths: Sequence[str]) -> list[str]:
    """Return last names, each with as many of those above it as tell it from the others."""
    names = [path.strip("/").split("/") for path in paths]
    most = max(map(len, names), default=0)

    def told(own: list[str]) -> str:
        counts = range(1, most + 1)
        alone = (n for n in counts if sum(each[-n:] == own[-n:] for each in names) == 1)
        return "/".join(own[-next(alone, most) :])

    return [told(own) for own in names]


def counted(count: int, noun: str) -> str:
    """Return how many there are of something."""
    return f"{count or 'no'} {noun}" + ("" if count == 1 else "s")


def of_inspection(found: Inspection) -> str:
    """Return what is on a stage."""
    parts = (
        (found.skeletons, "skeleton"),
        (found.edits, "edit"),
        (found.constraints, "constraint"),
        (found.detections, "detection"),
        (found.contacts, "contact"),
    )
    told = ", ".join(counted(len(held), noun) for held, noun in parts if held)
    return f"{told or 'nothing of usdmotion'}; {counted(len(found.faults), 'fault')} found"


def of_report(report: Report, place: str) -> str:
    """Return what became of edits, and where their results are."""
    rows = [row for edit in report.edits for row in edit.constraints]
    several = counted(len(report.edits), "edit")
    name = leaf(report.edits[0].path) if len(report.edits) == 1 else several
    missed = [row for row in rows if not row.met]
    count = counted(len(rows), "constraint")
    misses = map(_miss, missed, told_apart([row.path for row in missed]))
    told = f"{len(missed)} of {count} missed, {listed(misses)}"
    return noted(f"solved {name}: {told if missed else f'{count} met'}; in {place}", report.notes)


def of_detection(report: DetectionReport, place: str) -> str:
    """Return what was found, and where it is."""
    objects = told_apart([each.object for each in report.objects])
    told = f"{counted(report.count, 'contact')} on {listed(objects)}; in {place}"
    return noted(told, report.notes)


def of_guides(drawn: GuidesReport, place: str) -> str:
    """Return what was drawn, and where it is."""
    names = told_apart([f"{edit.path}/{name}" for edit in drawn.edits for name in edit.missed])
    missed = f", with {listed(names)} in red" if names else ""
    edits = listed(told_apart([edit.path for edit in drawn.edits]))
    return noted(f"drew {edits or 'contacts'}{missed}; in {place}", drawn.notes)


def noted(told: str, notes: Sequence[str]) -> str:
    """Return a sentence with a note; where there are more, they are printed and counted."""
    if len(notes) > 1:
        print(*(f"note: {note}" for note in notes), sep="\n")
        return f"{told}; {len(notes)} notes are in the terminal"
    return f"{told}; {notes[0]}" if notes else told


def listed(names: Iterable[str], most: int = 3) -> str:
    """Return names with commas, and how many more there are."""
    known = list(names)
    more = f" and {len(known) - most} more" if len(known) > most else ""
    return ", ".join(known[:most]) + more


def _miss(row: ConstraintReport, name: str) -> str:
    return f"{name} by {amount(row.max, row.unit)} at {row.worst_time:g}"

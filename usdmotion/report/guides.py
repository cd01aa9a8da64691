"""What was drawn over a stage: a table and JSON."""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

from rich.table import Table


@dataclass(frozen=True)
class EditGuides:
    """What was drawn of one edit."""

    path: str
    """Path of the MotionEdit."""
    solved: bool
    """Whether it was drawn with its result."""
    trajectories: int
    """Effectors whose trajectory was drawn."""
    goals: int
    missed: tuple[str, ...]
    """Names of the constraints that are missed somewhere, below the edit."""
    balance: bool
    """Whether its centre of mass was drawn."""


@dataclass(frozen=True)
class ObjectGuides:
    """What was drawn of the contacts of one object."""

    object: str
    """Path of the joint or the prim."""
    contacts: int


@dataclass(frozen=True)
class GuidesReport:
    """What was drawn over a stage."""

    edits: tuple[EditGuides, ...]
    objects: tuple[ObjectGuides, ...]
    """Whose contacts were drawn."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that whoever asked should know."""

    @property
    def contacts(self) -> int:
        """How many contacts were drawn."""
        return sum(each.contacts for each in self.objects)

    def to_json(self) -> str:
        """Return the machine-readable form."""
        return json.dumps(asdict(self), indent=2)

    def tables(self) -> Sequence[Table]:
        """Return what people read: a table of the edits, and one of whose contacts there are."""
        drawn = []
        if self.edits:
            heads = ("edit", "result", "trajectories", "goals", "missed", "centre of mass")
            drawn.append(_table(heads, map(_row, self.edits)))
        if self.objects:
            rows = ((each.object, str(each.contacts)) for each in self.objects)
            drawn.append(_table(("contacts of", "drawn"), rows))
        return drawn


def _row(edit: EditGuides) -> tuple[str, ...]:
    return (
        edit.path,
        "yes" if edit.solved else "not solved",
        str(edit.trajectories),
        str(edit.goals),
        ", ".join(edit.missed) if edit.solved else "",
        "yes" if edit.balance else "",
    )


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    table = Table()
    for head in heads:
        is_count = head in ("trajectories", "goals", "drawn")
        table.add_column(head, overflow="fold", justify="right" if is_count else "left")
    for row in rows:
        table.add_row(*row)
    return table

"""What was asked and what was met, measured by the host from the motion that came back."""

import json
from dataclasses import asdict, dataclass

import numpy as np
from rich.table import Table
from rich.text import Text

from usdmotion.arrays import Floats
from usdmotion.cleaning import Cleaning
from usdmotion.constraints import Constraint
from usdmotion.grounding import Grounding
from usdmotion.measuring import measure, tolerance
from usdmotion.report.wording import kind_of
from usdmotion.scene import Scene
from usdmotion.solving import Problem, Solution

_TOLD = 0.01
"""Errors are as large as each other within this share of what is tolerated."""


@dataclass(frozen=True)
class ConstraintReport:
    """What is left of one constraint where it is fully on; its fields are the keys of the JSON."""

    path: str
    type: str
    """Name of its schema class."""
    priority: int
    max: float
    """Largest error on the plateau, in `unit`; 0 where it is never fully on."""
    rms: float
    """Root mean square of the errors on the plateau, in `unit`."""
    unit: str
    """`m` or `deg`."""
    worst_time: float | None
    """Time code of the largest error; None where it is never fully on."""
    met: bool
    """Whether the largest error is within the constraint's tolerance."""


@dataclass(frozen=True)
class EditReport:
    """What became of one edit; its fields are the keys of the JSON."""

    path: str
    skeleton: str
    solver: str
    frames: int
    """How many frames were solved."""
    seconds: float
    """How long the solver took for the edit's whole scene."""
    iterations: int
    """Iterations spent on all frames together."""
    constraints: tuple[ConstraintReport, ...]
    cleaning: Cleaning | None = None
    """What was done to its input first; None where it was taken as it is."""
    ground: Grounding | None = None
    """What was done to put it on its ground after that; None where it has none."""


@dataclass(frozen=True)
class Report:
    """What became of every edit of a shot."""

    edits: tuple[EditReport, ...]
    notes: tuple[str, ...] = ()
    """One sentence about each thing in the shot that its maker should know."""

    @property
    def met(self) -> bool:
        """Whether every constraint of every edit was met."""
        return all(row.met for edit in self.edits for row in edit.constraints)

    def to_json(self) -> str:
        """Return the machine-readable form, `{"edits": [...]}`."""
        document = {"edits": [asdict(edit) for edit in self.edits]}
        return json.dumps(document, indent=2, allow_nan=False)

    def tables(self) -> list[Table]:
        """Return a table for a terminal for each edit."""
        return [_table(edit) for edit in self.edits]


def judge(scene: Scene, problem: Problem, solution: Solution) -> tuple[ConstraintReport, ...]:
    """Return what a solution leaves of every constraint of a scene, in the scene's order."""
    errors = measure(problem, solution, scene.constraints)
    return tuple(
        judged(constraint, left[demand.plateau], scene.time_codes[demand.plateau])
        for constraint, demand, left in zip(scene.constraints, scene.demands, errors.T, strict=True)
    )


def judged(constraint: Constraint, errors: Floats, time_codes: Floats) -> ConstraintReport:
    """Return the report of one constraint from its errors on the plateau and their times."""
    largest = float(errors.max(initial=0.0))
    on = len(errors) > 0
    # The first of those that are as large, so that rounding does not choose among them.
    alike = _TOLD * tolerance(constraint)
    return ConstraintReport(
        path=constraint.path,
        type=constraint.schema,
        priority=constraint.priority,
        max=largest,
        rms=float(np.sqrt(np.mean(errors**2))) if on else 0.0,
        unit=constraint.unit,
        worst_time=float(time_codes[(errors >= largest - alike).argmax()]) if on else None,
        met=largest <= tolerance(constraint),
    )


def _table(edit: EditReport) -> Table:
    title = (
        f"<{edit.path}>: {edit.frames} frames by {edit.solver} in {edit.seconds * 1e3:.0f} ms, "
        f"{edit.iterations / max(edit.frames, 1):.1f} iterations a frame"
    )
    table = Table(title=title, title_justify="left")
    for heading in ("priority", "constraint", "type"):
        table.add_column(heading)
    for heading in ("largest", "rms", "at time", "met"):
        table.add_column(heading, justify="right")
    for row in sorted(edit.constraints, key=lambda row: row.priority):
        table.add_row(
            str(row.priority),
            _short(row.path, edit.path),
            kind_of(row.type),
            _error(row.max, row.unit),
            _error(row.rms, row.unit),
            "never on" if row.worst_time is None else f"{row.worst_time:g}",
            Text("yes") if row.met else Text("no", style="bold red"),
        )
    return table


def _short(path: str, above: str) -> str:
    return path.removeprefix(f"{above}/")


def _error(value: float, unit: str) -> str:
    return f"{value * 1e3:.3f} mm" if unit == "m" else f"{value:.3f}°"

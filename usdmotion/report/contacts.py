"""The contacts of a shot after a detection: a table and JSON."""

import json
from dataclasses import asdict, dataclass
from typing import Literal

from rich.table import Table
from rich.text import Text

from usdmotion.report.wording import amount

_STATES = {
    "detected": "",
    "template": "template",
    "own": "kept",
    "off": "switched off",
    "dropped": "not found again",
}


@dataclass(frozen=True)
class ContactReport:
    """One contact."""

    path: str
    """Path of its prim."""
    kind: str
    start: float
    """Time code from which it holds."""
    end: float
    """Time code until which it holds."""
    seconds: float
    """For how long that is."""
    residual: float | None
    """Largest distance of what is held from its place [m]; None where nothing was found anew."""
    state: Literal["detected", "template", "own", "off", "dropped"]
    """Whether it was found, is an example, was left as somebody made, changed or switched it off,
    or is switched off because it was not found again."""


@dataclass(frozen=True)
class PatternReport:
    """How much an object that is held still moves in a step."""

    given_by: Literal["templates", "prim", "estimate"]
    """Where it is from."""
    sigma: tuple[float, float]
    """Smallest and largest σ_max over time; no unit."""
    epsilon: tuple[float, float]
    """Smallest and largest ε_max over time [m]."""


@dataclass(frozen=True)
class ObjectReport:
    """One joint or prim that was looked at."""

    path: str
    """Path of its MotionDetection."""
    object: str
    """The joint's token, or the prim's path."""
    detector: str
    kinds: tuple[str, ...]
    frames: int
    first: float
    """First time code that was looked at."""
    last: float
    """Last time code that was looked at."""
    pattern: PatternReport | None
    """The noise pattern; None of a detector that knows none."""
    contacts: tuple[ContactReport, ...]
    """In the order of their times."""


@dataclass(frozen=True)
class DetectionReport:
    """What was found on a shot."""

    objects: tuple[ObjectReport, ...]
    notes: tuple[str, ...] = ()
    """One sentence about each thing that whoever asked should know."""

    @property
    def count(self) -> int:
        """How many contacts hold now."""
        return sum(
            each.state not in ("off", "dropped")
            for object_ in self.objects
            for each in object_.contacts
        )

    def to_json(self) -> str:
        """Return the machine-readable form, `{"objects": [...], "notes": [...]}`."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def tables(self) -> list[Table | str]:
        """Return a table for a terminal for each object, one line where it has no contact."""
        return [_table(each) if each.contacts else _empty(each) for each in self.objects]


def _table(one: ObjectReport) -> Table:
    table = Table(title=_title(one), title_justify="left")
    for heading in ("contact", "kind"):
        table.add_column(heading)
    for heading in ("start", "end", "seconds", "residual"):
        table.add_column(heading, justify="right")
    table.add_column("")
    for each in one.contacts:
        quiet = "dim" if each.state in ("off", "dropped") else ""
        table.add_row(
            each.path.rsplit("/", 1)[-1],
            each.kind,
            f"{each.start:g}",
            f"{each.end:g}",
            f"{each.seconds:.2f}",
            "" if each.residual is None else amount(each.residual, "m"),
            Text(_STATES[each.state]),
            style=quiet,
        )
    return table


def _empty(one: ObjectReport) -> str:
    return f"{_title(one)}: no contact"


def _title(one: ObjectReport) -> str:
    said = f"<{one.path}>: {', '.join(one.kinds)} by {one.detector}"
    if one.pattern is None:
        return said
    sigma, epsilon = one.pattern.sigma, one.pattern.epsilon
    where = {"templates": "templates", "prim": "the prim", "estimate": "an estimate"}
    return (
        f"{said}, σ up to {_range(sigma)}, ε up to {_range(tuple(1e3 * e for e in epsilon))} mm "
        f"by {where[one.pattern.given_by]}"
    )


def _range(ends: tuple[float, ...]) -> str:
    low, high = (f"{end:.3g}" for end in ends)
    return low if low == high else f"{low} to {high}"

"""What became of motions that were taken off their bodies: a table and JSON."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass

from rich.table import Table

from usdmotion.report.wording import kind_of
from usdmotion.travelling import Left, Traveller


@dataclass(frozen=True)
class TravellerReport:
    """One constraint or contact; its fields are keys of the JSON."""

    name: str
    """Its path below the edit."""
    type: str
    """Name of its schema class; "" of one that does not travel."""
    joint: str
    """The part or joint that it holds; "" for none."""
    travels: bool
    why: str = ""
    """Why it does not."""
    found: bool = False
    """Whether it is a contact that was looked for on the way."""


@dataclass(frozen=True)
class NormalizedReport:
    """One motion; its fields are keys of the JSON."""

    path: str
    """Path of its prim."""
    skeleton: str
    """Path of the Skeleton that it was taken off."""
    source: str
    """Path of the SkelAnimation."""
    frames: int
    seconds: float
    leg: float
    """Length of a leg of that body [m]."""
    parts: tuple[str, ...]
    """Parts of the body that are joints of it, by their H-Anim names."""
    extra_joints: tuple[str, ...]
    """Joints that are no part, and travel along by their token."""
    carriers: tuple[str, ...]
    """What carries the body beside its ankles, by their H-Anim names."""
    travellers: tuple[TravellerReport, ...]


@dataclass(frozen=True)
class NormalizingReport:
    """Every motion of a shot."""

    motions: tuple[NormalizedReport, ...]
    notes: tuple[str, ...] = ()
    """One sentence about each thing that whoever asked should know."""

    def to_json(self) -> str:
        """Return the machine-readable form; the fields are its keys."""
        return json.dumps(asdict(self), indent=2, allow_nan=False)

    def tables(self) -> list[Table | str]:
        """Return what people read in a terminal."""
        shown: list[Table | str] = []
        for each in self.motions:
            shown.append(_sentence(each))
            shown += travellers_table(each.travellers)
        return shown


def travellers_of(
    travellers: Sequence[Traveller], left: Sequence[Left], found: Sequence[str]
) -> tuple[TravellerReport, ...]:
    """Return what there is to tell of constraints that travel, and of those that do not."""
    there = [
        TravellerReport(
            each.name,
            each.constraint.schema,
            each.constraint.joint,
            True,
            found=each.name in found,
        )
        for each in travellers
    ]
    return (*there, *(TravellerReport(each.name, "", "", False, each.why) for each in left))


def travellers_table(rows: Sequence[TravellerReport]) -> list[Table | str]:
    """Return a table of what travels, contacts of one joint in one row; nothing of nothing."""
    if not rows:
        return []
    table = Table(title="constraints and contacts", title_justify="left")
    for heading in ("what", "of", "travels"):
        table.add_column(heading)
    counted: dict[tuple[str, str, str], int] = {}
    behind: dict[tuple[str, str], list[str]] = {}
    for each in rows:
        of = each.joint.rsplit("/", 1)[-1]
        if each.travels:
            key = (kind_of(each.type), of, "found on the way" if each.found else "yes")
            counted[key] = counted.get(key, 0) + 1
        else:
            behind.setdefault((each.name.rpartition("/")[0], each.why), []).append(each.name)
    for (what, of, how), count in counted.items():
        table.add_row(f"{count} × {what}" if count > 1 else what, of, how)
    for (above, why), names in behind.items():
        several = f"{len(names)} of {above}" if above else ", ".join(names)
        table.add_row(several if len(names) > 1 else names[0], "", f"no: {why}")
    return [table]


def _sentence(each: NormalizedReport) -> str:
    extra = len(each.extra_joints)
    return (
        f"<{each.path}>: {each.frames} frames of <{each.source}>; {len(each.parts)} joints are "
        f"parts of a body, {extra} {'travel' if extra != 1 else 'travels'} along by name; a leg is "
        f"{each.leg:.3f} m"
        + (f"; carried by {', '.join(each.carriers)} too" if each.carriers else "")
    )

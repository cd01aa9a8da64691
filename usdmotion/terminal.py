"""What a terminal shows: tables of plain values, machine-readable output, what goes on now."""

import dataclasses
import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from typing import Any, Protocol

from rich.console import Console
from rich.table import Table
from rich.text import Text

from usdmotion.errors import FileError

_LISTED = 4
"""How much of a long list a table shows; JSON has all of it."""
_WIDE = 200
"""Columns of what has no width of its own, such as a log: a table that is cut tells nothing."""


class Account(Protocol):
    """What a verb has to tell in the end."""

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence about each thing that whoever asked should know."""
        ...

    def to_json(self) -> str:
        """Return the machine-readable form."""
        ...

    def tables(self) -> Sequence[Table | str]:
        """Return what people read."""
        ...


@dataclasses.dataclass(frozen=True)
class Terminal:
    """Where a verb talks to: people on one stream, notes on the other."""

    people: Console
    """For tables and what was written; nowhere with `--quiet`."""
    notes: Console
    """For what goes on now and what should be known; stderr, nowhere with `--quiet`."""

    @classmethod
    def open(cls, *, quiet: bool = False, json: str | None = None) -> "Terminal":
        """Return the terminal of a verb; stdout is left to the JSON where that goes there."""
        return cls(_console(stderr=json == "-", quiet=quiet), _console(stderr=True, quiet=quiet))

    @contextmanager
    def busy(self) -> Iterator[Callable[[str], None]]:
        """Yield what to tell about the work inside; it shows while a terminal is there."""
        with self.notes.status("starting") as status:
            yield lambda doing: status.update(Text(doing))

    def note(self, *sentences: str) -> None:
        """Tell what should be known."""
        for sentence in sentences:
            self.notes.print(f"note: {sentence}")

    def tell(self, *shown: object) -> None:
        """Show text or tables."""
        for each in shown:
            self.people.print(each)

    def account(self, told: "Account", *written: Path | str | None, json: str | None) -> None:
        """Tell what a verb has to tell: its notes, its JSON where that is asked for, its tables.

        Args:
            told: What became of it.
            written: What was written; None is nothing.
            json: Where the JSON goes, "-" for stdout; None is nowhere.
        """
        self.note(*told.notes)
        if json is not None:
            write_text(told.to_json(), json)
        self.tell(*told.tables(), *(f"wrote {each}" for each in written if each is not None))


def _console(*, stderr: bool, quiet: bool) -> Console:
    stream = sys.stderr if stderr else sys.stdout
    width = None if stream.isatty() else _WIDE
    return Console(
        stderr=stderr, quiet=quiet, width=width, soft_wrap=True, highlight=False, markup=False
    )


def rendered(*shown: object) -> str:
    """Return text and tables as they look where letters are equally wide and lines may be long."""
    page = Console(file=StringIO(), width=2 * _WIDE, highlight=False, markup=False, soft_wrap=True)
    for each in shown:
        page.print(each)
    return str(page.file.getvalue())  # type: ignore[attr-defined]


def tables(value: Any) -> list[Table | str]:
    """Return what shows a frozen value: its plain fields line by line, a table for each list."""
    shown: list[Table | str] = []
    for field in dataclasses.fields(value):
        held = getattr(value, field.name)
        title = field.name.replace("_", " ")
        if isinstance(held, tuple) and held and dataclasses.is_dataclass(held[0]):
            shown.append(table(title, held))
        elif held not in ((), "", None):
            shown.append(f"{title}: {_cell(held)}")
    return shown


def table(title: str, rows: Sequence[Any]) -> Table:
    """Return a table of frozen values of one kind: a column for each field that says something."""
    shown = Table(title=title, title_justify="left")
    names = [field.name for field in dataclasses.fields(rows[0])]
    told = [name for name in names if any(_cell(getattr(row, name)) for row in rows)]
    for name in told:
        shown.add_column(name.replace("_", " "), overflow="fold")
    for row in rows:
        shown.add_row(*(_cell(getattr(row, name)) for name in told))
    return shown


def to_json(value: Any) -> str:
    """Return a frozen value as a JSON document: its fields are the keys."""
    return json.dumps(dataclasses.asdict(value), indent=2, default=str)


def write_text(text: str, target: str) -> None:
    """Write a document to a file, whole or not at all, or to stdout for "-".

    Raises:
        FileError: The file cannot be written.
    """
    if target == "-":
        sys.stdout.write(text + "\n")
    else:
        write_bytes((text + "\n").encode(), Path(target))


def write_bytes(held: bytes, target: Path) -> None:
    """Write a file, whole or not at all.

    Raises:
        FileError: It cannot be written.
    """
    beside = Path(f"{target}.part")
    try:
        beside.write_bytes(held)
        os.replace(beside, target)
    except OSError as error:
        raise FileError(f"{target}: cannot be written: {error.strerror}") from error


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, tuple):
        told = [_cell(each) for each in value[:_LISTED]]
        return ", ".join(told) + (f", … ({len(value)})" if len(value) > _LISTED else "")
    return str(value)

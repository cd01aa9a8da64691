"""The application that every verb is a command of."""

from pathlib import Path
from typing import Protocol

import typer

from usdmotion.terminal import Account, Terminal

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Make captured motion fit the shot, in USD, without touching the original.",
)
schema = typer.Typer(no_args_is_help=True, help="Make USD know the schema.")
app.add_typer(schema, name="schema")


class Judged(Account, Protocol):
    """What a verb has to tell that enforces something."""

    @property
    def met(self) -> bool:
        """Whether everything is met."""
        ...


def finish(
    terminal: Terminal, told: Judged, *written: Path | None, json: str | None, strict: bool
) -> None:
    """Tell what became of what was enforced, and end with status 3 where that is minded.

    Args:
        terminal: Where to tell it.
        told: What became of it.
        written: What was written; None is nothing.
        json: Where the JSON goes, "-" for stdout; None is nowhere.
        strict: Whether somebody minds what is not met.
    """
    terminal.account(told, *written, json=json)
    if strict and not told.met:
        raise typer.Exit(3)

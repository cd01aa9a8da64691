"""Report: what became of a solved shot is shown in pictures."""

from pathlib import Path
from typing import Annotated

import typer

from usdmotion.cli.application import app
from usdmotion.cli.flags import Quiet, Shot
from usdmotion.terminal import Terminal


@app.command(epilog="Example: usdmotion report shot.edit.usda -o report.html --png pictures")
def report(
    result: Annotated[
        Path, typer.Argument(help="A layer that solve wrote, or a stage that shows it.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The page to write.", show_default=False),
    ] = None,
    shot: Shot = None,
    png: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write the pictures as files too.")
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Show what became of a solved shot, in pictures, as one file of HTML."""
    from usdmotion import reporting

    terminal = Terminal.open(quiet=quiet)
    output = output or result.with_suffix(".html")
    with terminal.busy() as say:
        findings = reporting.report(result, output, shot=shot, png=png, say=say)
    records = [edit.record for found in findings for edit in found.edits]
    for record in records:
        if record.stale:
            terminal.note(f"the result of <{record.edit}> is stale: its shot has changed since")
    terminal.tell(f"wrote {output}", *([f"wrote {png}"] if png else []))

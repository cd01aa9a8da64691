"""Inspect: what is on a stage is shown."""

from usdmotion.cli.application import app
from usdmotion.cli.flags import Json, Quiet, Source
from usdmotion.terminal import Terminal, tables, to_json, write_text


@app.command(epilog="Example: usdmotion inspect shot.usda --json -")
def inspect(shot: Source, json: Json = None, quiet: Quiet = False) -> None:
    """Show what is on a stage, and every fault found."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    usd.require_apart((), (json,))
    found = pipeline.inspect(shot)
    if json is not None:
        write_text(to_json(found), json)
    terminal.tell(*tables(found), *([] if found.faults else ["no faults found"]))

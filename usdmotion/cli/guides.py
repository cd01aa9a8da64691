"""Guides: what there is to see of a stage is drawn over it."""

from pathlib import Path
from typing import Annotated

import typer

from usdmotion.arguments import beside
from usdmotion.cli.application import app
from usdmotion.cli.flags import Json, Output, Quiet, Shot
from usdmotion.terminal import Terminal


@app.command(epilog="Example: usdmotion guides shot.usda -o shot.guides.usda")
def guides(
    stage: Annotated[Path, typer.Argument(help="A stage, or a layer that solve wrote.")],
    output: Output = None,
    shot: Shot = None,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Draw goals, trajectories, contacts, balance and misses, as a layer over the stage."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or beside(stage, "guides")
    usd.require_apart((output,), (json,))
    with terminal.busy() as say:
        drawn = pipeline.guides(stage, output, shot=shot, say=say)
    terminal.account(drawn, output, json=json)

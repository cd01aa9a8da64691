"""Normalize: motions leave their bodies, with what they must obey."""

from typing import Annotated

import typer

from usdmotion.arguments import beside, frames_of
from usdmotion.cli.application import app
from usdmotion.cli.flags import Contacts, Frames, Json, Output, Quiet, Source
from usdmotion.terminal import Terminal

Motion = Annotated[
    str,
    typer.Option("--source", metavar="PATH", help="Take only this Skeleton, or SkelAnimation."),
]
Edits = Annotated[
    list[str] | None,
    typer.Option("--edit", metavar="PATH", help="The edit whose constraints travel."),
]


@app.command(epilog="Example: usdmotion normalize shot.usda -o shot.s4d.usda")
def normalize(
    shot: Source,
    output: Output = None,
    source: Motion = "",
    edit: Edits = None,
    frames: Frames = None,
    contacts: Contacts = True,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Take motions off their bodies, so that any other body can have them."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or beside(shot, "s4d")
    usd.require_apart((output,), (json,))
    with terminal.busy() as say:
        told = pipeline.normalize(
            shot,
            output,
            source=source,
            edits=edit or (),
            frames=frames_of(frames),
            contacts=contacts,
            say=say,
        )
    terminal.account(told, output, json=json)

"""Picture: strips of poses, before and after, as papers show them."""

from pathlib import Path
from typing import Annotated

import typer

from usdmotion.arguments import moments_of, names_of
from usdmotion.cli.application import app
from usdmotion.cli.flags import Json, Quiet, Shot
from usdmotion.terminal import Terminal

Drawn = Annotated[
    Path | None,
    typer.Option("--output", "-o", help="The picture: .png or .svg.", show_default=False),
]
Moments = Annotated[
    str | None,
    typer.Option(
        "--frames",
        metavar="A:B:STEP|A,B,…",
        help="Time codes to draw; else about six at which it is worth looking.",
    ),
]
Views = Annotated[
    list[str] | None,
    typer.Option("--view", metavar="VIEWS", help="Some of front, side, top, three-quarter."),
]
Camera = Annotated[str, typer.Option(metavar="PATH", help="Look through this camera of the stage.")]
Compared = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="A layer over the shot, or a stage, to draw as what it is after."
    ),
]


@app.command(epilog="Example: usdmotion picture shot.usda -o strip.png --view front,side")
def picture(
    stage: Annotated[Path, typer.Argument(help="A stage, or a layer that solve wrote.")],
    output: Drawn = None,
    frames: Moments = None,
    view: Views = None,
    camera: Camera = "",
    compare: Compared = None,
    shot: Shot = None,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Draw a stage as a strip of poses; one with results beside what they were made from."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or stage.with_suffix(".png")
    usd.require_apart((), (output, json))
    with terminal.busy() as say:
        told = pipeline.picture(
            stage,
            output,
            shot=shot,
            frames=moments_of(frames),
            views=names_of(view),
            camera=camera,
            compare=compare,
            say=say,
        )
    terminal.account(told, output, json=json)

"""Retarget: a motion is put on another body."""

from pathlib import Path
from typing import Annotated

import typer

from usdmotion.arguments import beside, frames_of, names_of, options_of
from usdmotion.cli.application import app, finish
from usdmotion.cli.flags import Contacts, Frames, Ground, Json, Options, Output, Quiet, Strict
from usdmotion.cli.guides_option import Guides, WithGuides, file_of, guides_of
from usdmotion.terminal import Terminal

Source = Annotated[Path, typer.Argument(help="Normalized motions, or a shot.")]
Target = Annotated[Path, typer.Argument(help="The stage of the body.")]
Motion = Annotated[
    str,
    typer.Option(
        "--source", metavar="PATH", help="The motion, or the Skeleton, of several in the source."
    ),
]
Edits = Annotated[
    list[str] | None,
    typer.Option("--edit", metavar="PATH", help="The edit of a shot whose constraints travel."),
]
SkeletonPath = Annotated[
    str, typer.Option("--skeleton", metavar="PATH", help="The Skeleton, of several in the target.")
]
Solve = Annotated[
    bool, typer.Option("--solve/--no-solve", help="Enforce the constraints that came along.")
]
SolverName = Annotated[
    str | None, typer.Option("--solver", help="Name of the solver; else what the edit said.")
]


@app.command(
    cls=WithGuides, epilog="Example: usdmotion retarget shot.usda body.usda -o body.shot.usda"
)
def retarget(
    source: Source,
    target: Target,
    output: Output = None,
    motion: Motion = "",
    edit: Edits = None,
    frames: Frames = None,
    contacts: Contacts = True,
    skeleton: SkeletonPath = "",
    solve: Solve = True,
    solver: SolverName = None,
    option: Options = None,
    ground: Ground = None,
    guides: Guides = None,
    json: Json = None,
    strict: Strict = False,
    quiet: Quiet = False,
) -> None:
    """Put a motion on another body, with what it must obey."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    usd.require_apart((output := output or beside(target, "retargeted"), file_of(guides)), (json,))
    with terminal.busy() as say:
        told = pipeline.retarget(
            source,
            target,
            output,
            motion=motion,
            edits=edit or (),
            frames=frames_of(frames),
            contacts=contacts,
            skeleton=skeleton,
            enforce=solve,
            solver=solver,
            options=options_of(option),
            ground=names_of(ground) or None,
            guides=guides_of(guides),
            say=say,
        )
    finish(terminal, told, output, file_of(guides), json=json, strict=strict)

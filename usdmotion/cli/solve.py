"""Solve: the answer to what edits ask is written as a layer."""

from typing import Annotated

import typer

from usdmotion.arguments import cutoff_of, frames_of, names_of, options_of
from usdmotion.cli.application import app, finish
from usdmotion.cli.flags import (
    Clean,
    Composed,
    Edits,
    Frames,
    Ground,
    Json,
    MendRecruiting,
    Options,
    Output,
    Page,
    Quiet,
    Source,
    Strict,
)
from usdmotion.cli.guides_option import Guides, WithGuides, file_of, guides_of
from usdmotion.terminal import Terminal


@app.command(
    cls=WithGuides,
    epilog="Example: usdmotion solve shot.usda -o shot.edit.usda --compose shot.solved.usda",
)
def solve(
    shot: Source,
    output: Output = None,
    edit: Edits = None,
    solver: Annotated[str | None, typer.Option(help="Name of the solver.")] = None,
    option: Options = None,
    frames: Frames = None,
    clean: Clean = None,
    ground: Ground = None,
    compose: Composed = None,
    mend_recruiting: MendRecruiting = False,
    report: Page = None,
    guides: Guides = None,
    json: Json = None,
    strict: Strict = False,
    quiet: Quiet = False,
) -> None:
    """Solve the edits of a stage and write the layer that puts the answer over it."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or shot.with_name(f"{shot.stem}.edit.usda")
    usd.require_apart((output, compose, file_of(guides)), (report, json))
    with terminal.busy() as say:
        told = pipeline.solve(
            shot,
            output,
            edits=edit or (),
            solver=solver,
            options=options_of(option),
            frames=frames_of(frames),
            cleaning=cutoff_of(clean),
            ground=names_of(ground) or None,
            compose=compose,
            mend_recruiting=mend_recruiting,
            page=report,
            guides=guides_of(guides),
            say=say,
        )
    finish(terminal, told, output, compose, file_of(guides), report, json=json, strict=strict)

"""Clean: feet are found and planted, and the rest of the motion is kept."""

from typing import Annotated

import typer

from usdmotion.arguments import beside, cutoff_of, frames_of, names_of, options_of, template_of
from usdmotion.cli.application import app, finish
from usdmotion.cli.flags import (
    DetectorName,
    Frames,
    Json,
    Options,
    Output,
    Page,
    Quiet,
    Source,
    Strict,
    Templates,
)
from usdmotion.cli.guides_option import Guides, WithGuides, file_of, guides_of
from usdmotion.terminal import Terminal

Joints = Annotated[
    list[str] | None,
    typer.Option(metavar="NAMES", help="The joints that stand, with commas; else known feet."),
]
Smoothing = Annotated[
    float | None,
    typer.Option(
        metavar="HZ", help="Low-pass what was changed; 0 is off; else what an edit says, or 4."
    ),
]


@app.command(
    cls=WithGuides,
    epilog="Example: usdmotion clean shot.usda -o shot.clean.usda --report shot.html",
)
def clean(
    shot: Source,
    output: Output = None,
    joints: Joints = None,
    template: Templates = None,
    detector: DetectorName = "",
    option: Options = None,
    smoothing: Smoothing = None,
    frames: Frames = None,
    report: Page = None,
    guides: Guides = None,
    json: Json = None,
    strict: Strict = False,
    quiet: Quiet = False,
) -> None:
    """Plant feet that slide: find where they stand, hold them there, keep the rest."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or beside(shot, "clean")
    usd.require_apart((output, file_of(guides)), (report, json))
    with terminal.busy() as say:
        told = pipeline.clean(
            shot,
            output,
            joints=names_of(joints),
            templates=[template_of(text) for text in template or ()],
            detector=detector,
            options=options_of(option),
            smoothing=cutoff_of(smoothing, "--smoothing"),
            frames=frames_of(frames),
            page=report,
            guides=guides_of(guides),
            say=say,
        )
    finish(terminal, told, output, file_of(guides), report, json=json, strict=strict)

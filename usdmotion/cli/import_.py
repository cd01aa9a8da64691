"""Import: a stage is made of a file of motion."""

from typing import Annotated

import typer

from usdmotion.arguments import options_of
from usdmotion.cli.application import app
from usdmotion.cli.flags import Options, Output, Quiet, Source
from usdmotion.terminal import Terminal


@app.command("import", epilog="Example: usdmotion import walk.bvh -o walk.usda --fps 24")
def import_(
    source: Source,
    output: Output = None,
    fps: Annotated[
        float | None, typer.Option(help="Samples per second of the stage; else the file's.")
    ] = None,
    first: Annotated[float, typer.Option(help="Time code of the first sample.")] = 1.0,
    unit: Annotated[
        float | None, typer.Option(metavar="METRES", help="Length of one unit of the file.")
    ] = None,
    name: Annotated[str | None, typer.Option(help="Name of the character.")] = None,
    reader: Annotated[str | None, typer.Option(help="Name of the reader.")] = None,
    option: Options = None,
    quiet: Quiet = False,
) -> None:
    """Make a stage of a file of motion."""
    from usdmotion import pipeline

    terminal = Terminal.open(quiet=quiet)
    output = output or source.with_suffix(".usda")
    with terminal.busy() as say:
        say(f"reading {source}")
        recording = pipeline.import_motion(
            source,
            output,
            fps=fps,
            first=first,
            unit=unit,
            name=name,
            reader=reader,
            options=options_of(option),
        )
    terminal.note(*recording.notes)
    terminal.tell(f"wrote {output}: {recording.name}, {recording.summary}")

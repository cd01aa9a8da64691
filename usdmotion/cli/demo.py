"""Demo: a stage of our own is built."""

from pathlib import Path
from typing import Annotated

import typer

from usdmotion.cli.application import app
from usdmotion.cli.flags import Quiet
from usdmotion.errors import InputError
from usdmotion.terminal import Terminal


@app.command(epilog="Example: usdmotion demo reaching -o reaching")
def demo(
    name: Annotated[
        str | None, typer.Argument(help="Name of the demo; without it they are listed.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The folder to write into.")
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Build a stage, ready to be worked on, with motion that the project makes itself."""
    from usdmotion import demos

    terminal = Terminal.open(quiet=quiet)
    if name is None:
        terminal.tell(*demos.NAMES)
        return
    if name not in demos.NAMES:
        raise InputError(f"there is no demo '{name}'; there are: {', '.join(demos.NAMES)}")
    folder = output or Path(name)
    stage = demos.build(name, folder)
    terminal.tell(f"wrote {stage}", f"go on by: {demos.following(name, stage)}")

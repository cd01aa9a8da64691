"""Demo: stages of our own are built, and drawn."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from usdmotion.cli.application import app
from usdmotion.cli.flags import Quiet
from usdmotion.errors import InputError
from usdmotion.terminal import Terminal

EVERY = "all"
"""Instead of a name: every demo."""
Picture = Annotated[
    bool,
    typer.Option("--picture", help="Go on by what is said, and draw what became of it beside it."),
]


@app.command(epilog="Example: usdmotion demo reaching -o reaching")
def demo(
    name: Annotated[
        str | None,
        typer.Argument(help=f"Name of a demo, or {EVERY}; without it they are listed."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The folder to write into.")
    ] = None,
    picture: Picture = False,
    quiet: Quiet = False,
) -> None:
    """Build a stage, ready to be worked on, with motion that the project makes itself."""
    from usdmotion import demos
    from usdmotion.demos.gallery import draw
    from usdmotion.drawing import require_matplotlib

    terminal = Terminal.open(quiet=quiet)
    if name is None:
        terminal.tell(*demos.NAMES)
        return
    if name != EVERY and name not in demos.NAMES:
        raise InputError(
            f"there is no demo '{name}'; there are: {', '.join(demos.NAMES)}, and {EVERY}"
        )
    if picture:
        require_matplotlib()
    for each in demos.NAMES if name == EVERY else (name,):
        stage = demos.build(each, output or Path(name))
        terminal.tell(f"wrote {stage}", f"go on by: {demos.following(each, stage)}")
        if picture:
            with terminal.busy() as say:
                drawn = draw(each, stage, _carry_out, say=say)
            terminal.tell(*(f"wrote {file}" for file in drawn))


def _carry_out(command: str) -> None:
    """Carry out a command of this program, in this process."""
    _, *words = shlex.split(command)
    app(words, standalone_mode=False)

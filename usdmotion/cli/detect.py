"""Detect: what a motion already obeys is written as contacts over it."""

from typing import Annotated

import typer

from usdmotion.arguments import beside, duration_of, names_of, options_of, template_of
from usdmotion.cli.application import app
from usdmotion.cli.flags import DetectorName, Json, Options, Output, Quiet, Source, Templates
from usdmotion.cli.guides_option import WithGuides, file_of
from usdmotion.errors import OptionError
from usdmotion.terminal import Terminal

Joints = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAMES", help="Joints to look at: tokens, last names or H-Anim names, with commas."
    ),
]
Prims = Annotated[
    list[str] | None,
    typer.Option(metavar="PATHS", help="Animated prims to look at, with commas."),
]
Kinds = Annotated[
    list[str] | None,
    typer.Option(metavar="KINDS", help="What to look for: space, line, point, plane, slide."),
]
Minimum = Annotated[
    float | None, typer.Option(metavar="SECONDS", help="Drop contacts that last for less.")
]
Edit = Annotated[str, typer.Option(metavar="PATH", help="Look at the skeleton of this edit only.")]
Guides = Annotated[
    str | None,
    typer.Option(
        "--guides",
        metavar="[FILE]",
        help="Draw contacts in the layer, as it does anyway, or all there is to see in FILE.",
    ),
]
NoGuides = Annotated[bool, typer.Option("--no-guides", help="Draw no contacts to look at.")]


@app.command(
    cls=WithGuides,
    epilog="Example: usdmotion detect shot.usda -o shot.contacts.usda --joints wrist,elbow",
)
def detect(
    shot: Source,
    output: Output = None,
    joints: Joints = None,
    prims: Prims = None,
    kinds: Kinds = None,
    template: Templates = None,
    detector: DetectorName = "",
    option: Options = None,
    minimum: Minimum = None,
    edit: Edit = "",
    guides: Guides = None,
    no_guides: NoGuides = False,
    json: Json = None,
    quiet: Quiet = False,
) -> None:
    """Find contacts, and write a layer over the shot that has them."""
    from usdmotion import pipeline, usd

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or beside(shot, "contacts")
    if no_guides and guides is not None:
        raise OptionError("--guides and --no-guides are both given; leave one out")
    usd.require_apart((output, file_of(guides)), (json,))
    with terminal.busy() as say:
        found = pipeline.detect(
            shot,
            output,
            joints=names_of(joints),
            prims=names_of(prims),
            kinds=names_of(kinds),
            templates=[template_of(text) for text in template or ()],
            detector=detector,
            options=options_of(option),
            minimum=duration_of(minimum, "--minimum"),
            edit=edit,
            guides=file_of(guides) or not no_guides,
            say=say,
        )
    terminal.account(found, f"{output}: {found.count} contacts", file_of(guides), json=json)

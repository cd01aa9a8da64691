"""Arguments and options that several verbs have."""

from pathlib import Path
from typing import Annotated

import typer

Source = Annotated[Path, typer.Argument(help="The file to read.")]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", help="The layer to write.", show_default=False)
]
Json = Annotated[
    str | None, typer.Option("--json", metavar="FILE|-", help="Write the result as JSON too.")
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")]
Options = Annotated[
    list[str] | None,
    typer.Option("--option", metavar="NAME=VALUE", help="Set an option; may be repeated."),
]

Edits = Annotated[
    list[str] | None,
    typer.Option("--edit", metavar="PATH", help="Solve this edit; may be repeated."),
]
Frames = Annotated[
    str | None, typer.Option(metavar="A:B", help="First and last time code, inclusive.")
]
Clean = Annotated[
    float | None,
    typer.Option(metavar="HZ", help="Clean the input first: outliers out, low-pass; 0 is off."),
]
Ground = Annotated[
    list[str] | None,
    typer.Option(
        "--ground", metavar="PRIMS", help="Put the input on these prims first; may be repeated."
    ),
]
Composed = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Write a stage that shows the answer.")
]
Page = Annotated[
    Path | None, typer.Option("--report", metavar="FILE", help="Write a report of it as HTML.")
]
MendRecruiting = Annotated[
    bool,
    typer.Option("--mend-recruiting", help="Let constraints recruit what lower ranks move."),
]
Shot = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="The shot under the layer; else the file beside it after which it is named.",
    ),
]
Strict = Annotated[
    bool, typer.Option("--strict", help="End with status 3 where a constraint is not met.")
]
DetectorName = Annotated[str, typer.Option("--detector", help="Name of the detector.")]
Templates = Annotated[
    list[str] | None,
    typer.Option(
        "--template",
        metavar="JOINT:START:END[:KIND]",
        help="An example, in time codes, from which noise is learnt; may be repeated.",
    ),
]
Contacts = Annotated[
    bool,
    typer.Option(
        "--contacts/--no-contacts",
        help="Look for contacts of feet, knees and hands where feet have none.",
    ),
]

"""The command line: one function a verb, over the pipeline.

Rooms that are slow to import are imported in the verb that needs them.
"""

import sys
from pathlib import Path
from typing import Annotated

import typer

from usdmotion.arguments import cutoff_of, frames_of, options_of
from usdmotion.errors import InputError
from usdmotion.terminal import Terminal, table, tables, to_json, write_text

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Make captured motion fit the shot, in USD, without touching the original.",
)
schema = typer.Typer(no_args_is_help=True, help="Make USD know the schema.")
app.add_typer(schema, name="schema")

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
Strict = Annotated[
    bool, typer.Option("--strict", help="End with status 3 where a constraint is not met.")
]


def main() -> None:
    """Run the command line; the exit status is 0 done, 1 a bug, 2 the input is at fault.

    With `--strict` it is 3 where a constraint was not met.
    """
    try:
        app()
    except InputError as error:
        print(f"usdmotion: {error}", file=sys.stderr)
        raise SystemExit(2) from None


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
    frames, joints = recording.motion.rotations.shape[:2]
    terminal.tell(f"wrote {output}: {recording.name}, {frames} frames of {joints} joints")


@app.command(epilog="Example: usdmotion inspect shot.usda --json -")
def inspect(shot: Source, json: Json = None, quiet: Quiet = False) -> None:
    """Show what is on a stage, and every fault found."""
    from usdmotion import pipeline

    terminal = Terminal.open(quiet=quiet, json=json)
    found = pipeline.inspect(shot)
    if json is not None:
        write_text(to_json(found), json)
    terminal.tell(*tables(found), *([] if found.faults else ["no faults found"]))


@app.command(
    epilog="Example: usdmotion solve shot.usda -o shot.edit.usda --compose shot.solved.usda"
)
def solve(
    shot: Source,
    output: Output = None,
    edit: Edits = None,
    solver: Annotated[str | None, typer.Option(help="Name of the solver.")] = None,
    option: Options = None,
    frames: Frames = None,
    clean: Clean = None,
    compose: Composed = None,
    mend_recruiting: MendRecruiting = False,
    report: Page = None,
    json: Json = None,
    strict: Strict = False,
    quiet: Quiet = False,
) -> None:
    """Solve the edits of a stage and write the layer that puts the answer over it."""
    from usdmotion import pipeline

    terminal = Terminal.open(quiet=quiet, json=json)
    output = output or shot.with_name(f"{shot.stem}.edit.usda")
    with terminal.busy() as say:
        told = pipeline.solve(
            shot,
            output,
            edits=edit or (),
            solver=solver,
            options=options_of(option),
            frames=frames_of(frames),
            cleaning=cutoff_of(clean),
            compose=compose,
            mend_recruiting=mend_recruiting,
            page=report,
            say=say,
        )
    terminal.note(*told.notes)
    if json is not None:
        write_text(told.to_json(), json)
    written = (f"wrote {path}" for path in (output, compose, report) if path)
    terminal.tell(*told.tables(), *written)
    if strict and not told.met:
        raise typer.Exit(3)


@app.command(epilog="Example: usdmotion report shot.edit.usda -o report.html --png pictures")
def report(
    result: Annotated[
        Path, typer.Argument(help="A layer that solve wrote, or a stage that shows it.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The page to write.", show_default=False),
    ] = None,
    shot: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="The shot under the layer; else the file beside it after which it is named.",
        ),
    ] = None,
    png: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write the pictures as files too.")
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Show what became of a solved shot, in pictures, as one file of HTML."""
    from usdmotion import reporting

    terminal = Terminal.open(quiet=quiet)
    output = output or result.with_suffix(".html")
    with terminal.busy() as say:
        findings = reporting.report(result, output, shot=shot, png=png, say=say)
    records = [edit.record for found in findings for edit in found.edits]
    for record in records:
        if record.stale:
            terminal.note(f"the result of <{record.edit}> is stale: its shot has changed since")
    terminal.tell(f"wrote {output}", *([f"wrote {png}"] if png else []))


@app.command(epilog="Example: usdmotion plugins --json plugins.json")
def plugins(json: Json = None, quiet: Quiet = False) -> None:
    """Show what is installed, and what was set aside and why."""
    from usdmotion.catalogue import Catalogue
    from usdmotion.plugins import host

    terminal = Terminal.open(quiet=quiet, json=json)
    catalogue = Catalogue.of(host())
    if json is not None:
        write_text(to_json(catalogue), json)
    terminal.tell(*tables(catalogue))


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
    """Build a stage, ready to be solved, with motion that the project makes itself."""
    from usdmotion import demos

    terminal = Terminal.open(quiet=quiet)
    if name is None:
        terminal.tell(*demos.NAMES)
        return
    if name not in demos.NAMES:
        raise InputError(f"there is no demo '{name}'; there are: {', '.join(demos.NAMES)}")
    folder = output or Path(name)
    stage = demos.build(name, folder)
    terminal.tell(f"wrote {stage}", f"solve it by: usdmotion solve {stage}")


@schema.command("path", epilog="Example: usdmotion schema path")
def schema_path() -> None:
    """Print the folder of the schema; needs no USD."""
    import usdmotion_schemas

    print(usdmotion_schemas.plugin_path())


@schema.command("env", epilog="Example: usdmotion schema env")
def schema_env() -> None:
    """Print the environment in which any USD process knows the schema; needs no USD."""
    import usdmotion_schemas

    from usdmotion.plugins import host

    for line in usdmotion_schemas.environment(host().schemas):
        print(line)


@schema.command("check", epilog="Example: usdmotion schema check")
def schema_check() -> None:
    """Tell whether this USD knows the schema; status 2 where it does not."""
    from usdmotion.plugins import host
    from usdmotion.usd import registration

    findings = registration.check(host().schemas)
    Terminal.open().tell(table("schema", findings))
    if not all(finding.ok for finding in findings):
        raise typer.Exit(2)

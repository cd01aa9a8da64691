"""Pictures of the stages that the project makes itself, as the figures of the papers."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from shlex import quote
from tempfile import TemporaryDirectory

from usdmotion import demos
from usdmotion.demos.figures import Answer, Figure, Plot
from usdmotion.drawing import Picture, drawing, strip_picture
from usdmotion.drawing.strips import Row, Strip
from usdmotion.picturing import look_at, strip_of
from usdmotion.terminal import write_bytes

DPI = 110.0
"""Pixels in an inch: wide enough for a page, and a file of some ten kilobytes."""
Run = Callable[[str], None]
"""Carries out a command as the command line does."""


def figures(name: str) -> dict[str, Figure | Plot]:
    """Return the figures of a demo by the names of their pictures."""
    module = import_module(f"usdmotion.demos.{name}")
    return {name: module.PICTURE, **getattr(module, "MORE_PICTURES", {})}


def draw(
    name: str, stage: Path, run: Run, *, say: Callable[[str], None] = lambda _: None
) -> tuple[Path, ...]:
    """Draw the pictures of a demo beside its stage; return them.

    Args:
        name: One of `NAMES`.
        stage: The stage, as `build` wrote it.
        run: Carries out what is to be done with it, in a folder that is gone afterwards.
        say: Is told what is being done.

    Raises:
        InputError: A picture cannot be written, or matplotlib is missing.
    """
    drawn = []
    for title, figure in figures(name).items():
        output = stage.with_name(f"{title}.png")
        with TemporaryDirectory() as folder, drawing():
            say(f"working on {title}")
            picture = _picture(name, figure, stage, Path(folder), run)
            say(f"drawing {output}")
            write_bytes(picture.png(DPI), output)
        drawn.append(output)
    return tuple(drawn)


def _picture(name: str, figure: Figure | Plot, stage: Path, folder: Path, run: Run) -> Picture:
    if isinstance(figure, Figure):
        rows = _rows(name, figure, stage, folder, run)
        return strip_picture(Strip(rows, figure.shows), name=name)
    shown = _answered(name, Answer(), stage, folder / name, run)[1] if figure.solved else stage
    return Picture(name, figure.shows, figure.draw(shown))


def _rows(name: str, figure: Figure, stage: Path, folder: Path, run: Run) -> tuple[Row, ...]:
    """Return the rows of a figure: the stage as it was, and what became of it."""
    rows: list[Row] = []
    frames: Sequence[float] = figure.frames
    for place, answer in enumerate(figure.answers):
        asked, answered = _answered(name, answer, stage, folder / str(place), run)
        compared = figure.before and asked != answered
        looked = look_at(
            asked if compared else answered,
            frames=frames or None,
            views=figure.views,
            compare=answered if compared else None,
        )
        frames = looked.codes.tolist()
        found = strip_of(looked).rows
        before, after = (found[::2], found[1::2]) if len(looked.sceneries) > 1 else ((), found)
        if figure.before and place == 0:
            rows += before
        title = answer.title if len(figure.answers) > 1 or rows else ""
        rows += [replace(row, title=title) for row in after]
    return tuple(rows)


def _answered(name: str, answer: Answer, stage: Path, folder: Path, run: Run) -> tuple[Path, Path]:
    """Return a stage that asks for something, and one that shows what became of that."""
    from usdmotion.usd import vary

    folder.mkdir()
    asked = stage
    if answer.build is not None:
        asked = folder / f"built.{stage.name}"
        answer.build(asked)
    if answer.variant or answer.without:
        varied = folder / stage.name
        vary(asked, varied, variant=answer.variant, without=answer.without)
        asked = varied
    shown = asked
    for number, step in enumerate(answer.steps or (demos.following(name, Path("{stage}")),)):
        shown = _carried_out(step, shown, folder / f"{number}.{stage.name}", run)
    if answer.hidden:
        seen = folder / f"seen.{stage.name}"
        vary(shown, seen, hidden=answer.hidden)
        return seen, seen
    return asked, shown


def _carried_out(step: str, stage: Path, output: Path, run: Run) -> Path:
    """Carry out a step on a stage, and return the stage that shows what became of it."""
    command = step.partition(" -o ")[0].format(stage=quote(str(stage)))
    if " inspect " in command:
        return stage
    if " solve " in command:
        edit = output.with_suffix(".edit.usda")
        run(f"{command} -o {quote(str(edit))} --compose {quote(str(output))} --quiet")
    else:
        run(f"{command} -o {quote(str(output))} --quiet")
    return output

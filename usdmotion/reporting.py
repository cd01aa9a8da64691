"""The report of a shot that was solved: one page, and its pictures as files."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from usdmotion.answering import beside_its_input
from usdmotion.drawing import strip_picture
from usdmotion.errors import FileError
from usdmotion.grounding import Told
from usdmotion.outcome import Outcome
from usdmotion.plugins import host
from usdmotion.report.findings import Findings, findings_of
from usdmotion.report.page import Chapter, page
from usdmotion.report.pictures import drawing, pictures_of, postures_of, require_matplotlib
from usdmotion.scene import Scene
from usdmotion.showing import ShownScene, shown
from usdmotion.showing.poses import poses
from usdmotion.showing.telling import telling_frames
from usdmotion.terminal import write_bytes, write_text

__all__ = ["report", "require_matplotlib", "tell"]


def report(
    result: Path,
    output: Path,
    *,
    shot: Path | None = None,
    png: Path | None = None,
    ground: Told | None = None,
    inputs: Sequence[Scene] = (),
    say: Callable[[str], None] = lambda _: None,
) -> tuple[Findings, ...]:
    """Write the report of what a stage, or a layer of results, shows.

    Everything in it is measured from the motion in the result. The same inputs give the same bytes.

    Args:
        result: A stage on which results are, or a layer that `solve` wrote.
        output: The file of HTML.
        shot: The shot under the layer; None finds it beside it, as `usd.read_outcomes` says.
        png: The folder into which the pictures are written as well, made where it is missing.
        ground: The ground that a program told when it was solved.
        inputs: What `Answers` has of that solve, where it is at hand.
        say: Is told what is being done.

    Returns:
        What it tells, scene by scene.

    Raises:
        InputError: The result cannot be read, the report not be written, or matplotlib is missing.
    """
    from usdmotion import usd

    usd.require_apart((), (output, png))
    require_matplotlib()
    say(f"reading {result}")
    read = usd.read_outcomes(result, shot=shot, kinds=host().constraints)
    call = "usdmotion.reporting.report"
    outcomes = [beside_its_input(each, ground, result, call, inputs) for each in read]
    return tell(outcomes, result.name, output, png=png, say=say)


def tell(
    outcomes: Sequence[Outcome],
    name: str,
    output: Path,
    *,
    png: Path | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> tuple[Findings, ...]:
    """Write the report of some outcomes that are beside their inputs, as `report` does.

    Args:
        outcomes: What became of each scene.
        name: How the whole is called.
        output: The file of HTML.
        png: The folder into which the pictures are written as well, made where it is missing.
        say: Is told what is being done.

    Returns:
        What it tells, scene by scene.

    Raises:
        InputError: The report cannot be written, or matplotlib is missing.
    """
    require_matplotlib()
    say("measuring")
    findings = tuple(findings_of(outcome) for outcome in outcomes)
    say("drawing")
    with drawing():
        chapters = [
            chapter
            for outcome, found in zip(outcomes, findings, strict=True)
            for chapter in _chapters(found, shown(outcome, found))
        ]
        if png is not None:
            _write_pictures(chapters, png)
        write_text(page(name, chapters), str(output))
    return findings


def _chapters(found: Findings, scene: ShownScene) -> Iterator[Chapter]:
    for edit, seen in zip(found.edits, scene.edits, strict=True):
        strip = poses(scene, seen, telling_frames(seen, len(found.scene.times)))
        yield Chapter(
            found,
            edit,
            pictures_of(found, edit),
            list(postures_of(found, edit)),
            strip_picture(strip, name="strip"),
        )


def _write_pictures(chapters: list[Chapter], folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"{folder}: cannot be made: {error.strerror}") from error
    leaves = [chapter.edit.edit.path.rsplit("/", 1)[-1] for chapter in chapters]
    for chapter, leaf in zip(chapters, leaves, strict=True):
        path = chapter.edit.edit.path
        name = leaf if leaves.count(leaf) == 1 else path.strip("/").replace("/", "_")
        drawn = [each for group in chapter.pictures.values() for each in group]
        strip = [] if chapter.strip is None else [chapter.strip]
        for picture in (*drawn, *chapter.frames, *strip):
            write_bytes(picture.png(), folder / f"{name}.{picture.name}.png")

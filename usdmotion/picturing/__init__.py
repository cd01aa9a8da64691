"""Pictures of a stage, from file to file: strips of poses, before and after."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from usdmotion.asking import Span
from usdmotion.drawing import drawing, require_matplotlib, strip_picture
from usdmotion.errors import FileError
from usdmotion.grounding import Told
from usdmotion.picturing.looking import Looked, look_at
from usdmotion.picturing.pictured import Pictured
from usdmotion.picturing.strips import empty_panels, strip_of
from usdmotion.picturing.views import VIEWS, require_askable
from usdmotion.terminal import write_bytes

__all__ = ["VIEWS", "Looked", "Pictured", "look_at", "picture", "strip_of"]

_ENDINGS = (".png", ".svg")


def picture(
    stage: Path,
    output: Path,
    *,
    shot: Path | None = None,
    frames: Span | Sequence[float] | None = None,
    views: Sequence[str] = (),
    camera: str = "",
    compare: Path | None = None,
    ground: Told | None = None,
    say: Callable[[str], None] = lambda _: None,
) -> Pictured:
    """Draw a stage as a strip of poses: columns are frames, rows are views, before and after.

    A stage that shows results is drawn beside what they were made from. Nothing is written to it.
    The same inputs give the same bytes.

    Args:
        stage: The stage, or a layer of results.
        output: The picture to write; it ends in .png or .svg.
        shot: The shot under the layer; None finds it beside it, as `usd.files_of` says.
        frames: Which frames; None takes about six at which it is worth looking.
        views: Some of front, side, top, three-quarter; none takes the last, or the camera.
        camera: Path of the camera to look through.
        compare: A layer that goes over the shot, or a stage, to be drawn as what it is after.
        ground: The ground that a program told when the stage was solved.
        say: Is told what is being done.

    Raises:
        InputError: The stage cannot be read, what is asked for is not there, nothing is to be seen,
            or matplotlib is missing.
    """
    if output.suffix not in _ENDINGS:
        raise FileError(f"{output}: a picture ends in {' or '.join(_ENDINGS)}; name it so")
    require_askable(views, camera)
    require_matplotlib()
    looked = look_at(
        stage,
        shot=shot,
        frames=frames,
        views=views,
        camera=camera,
        compare=compare,
        ground=ground,
        say=say,
    )
    _require_writable(output, looked)
    strip = strip_of(looked)
    say("drawing")
    with drawing():
        drawn = strip_picture(strip, name=output.stem)
        write_bytes(drawn.png() if output.suffix == ".png" else drawn.svg_file(), output)
    bodies = (body for each in looked.sceneries for body in each.bodies)
    return Pictured(
        file=str(output),
        frames=tuple(looked.codes.tolist()),
        rows=tuple(row.title for row in strip.rows),
        skeletons=tuple(dict.fromkeys(body.character.path for body in bodies)),
        notes=(*looked.notes, *empty_panels(looked, strip)),
    )


def _require_writable(output: Path, looked: Looked) -> None:
    if any(os.path.realpath(output) in each.side.files for each in looked.sceneries):
        raise FileError(f"{output}: the stage is made of it, and no input is written to")
    if not output.parent.is_dir():
        raise FileError(f"{output}: there is no folder {output.parent}; make it first")

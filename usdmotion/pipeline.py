"""The verbs, as functions: what the command line does, without a word printed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say
from usdmotion.asking import Asked, Example
from usdmotion.capture import Capture
from usdmotion.errors import FileError, InputError
from usdmotion.grounding import Asked as Ground
from usdmotion.grounding import told_by
from usdmotion.guiding import guides as guides
from usdmotion.guiding import guides_beside, guides_for, require_room
from usdmotion.normalizing import normalize as normalize
from usdmotion.options import configured
from usdmotion.picturing import picture as picture
from usdmotion.planting import Wish, plant
from usdmotion.plugins import host
from usdmotion.recording import Recording
from usdmotion.report import Report
from usdmotion.report.contacts import DetectionReport
from usdmotion.report.planting import PlantingReport
from usdmotion.reporting import report, require_matplotlib
from usdmotion.resampling import capture_evenly, evenly
from usdmotion.retargeting import retarget as retarget
from usdmotion.searching import search
from usdmotion.session import Session

if TYPE_CHECKING:
    from usdmotion.usd import Inspection


def import_motion(
    source: Path,
    output: Path,
    *,
    fps: float | None = None,
    first: float = 1.0,
    unit: float | None = None,
    name: str | None = None,
    reader: str | None = None,
    options: Mapping[str, object] | None = None,
) -> Recording | Capture:
    """Make a stage of a file of motion.

    Args:
        source: The file, in any format that a reader plugin knows.
        output: The layer to write.
        fps: Samples per second of the stage; None keeps the file's.
        first: Time code of the first sample.
        unit: Metres per unit of the file; None lets the reader decide.
        name: Name of the character; None takes the reader's.
        reader: Name of the reader; None takes the first that reads files of this ending.
        options: Options of the reader.

    Returns:
        What was written, with notes about what was decided on the way: a recording of a skeleton,
        or a capture of markers with their clusters.

    Raises:
        InputError: The file is refused, or nothing reads it.
    """
    from usdmotion import usd

    _require(source)
    kind = host().reader(reader) if reader else host().reader_of(source)
    settings = dict(options or {}) | ({} if unit is None else {"unit": unit})
    recording = configured(kind, settings).read(source)
    if name is not None:
        if not name.isidentifier():
            raise InputError(f"the name '{name}' is no prim name; use letters, digits and '_'")
        recording = replace(recording, name=name)
    if isinstance(recording, Capture):
        capture = _completed(recording if fps is None else capture_evenly(recording, fps))
        usd.write_capture(capture, output, frame_rate=fps, first=first)
        return capture
    if fps is not None:
        recording = replace(recording, motion=evenly(recording.motion, fps), frame_rate=fps)
    usd.write_recording(recording, output, frame_rate=fps, first=first)
    return recording


def _completed(capture: Capture) -> Capture:
    """Return a capture with what can be told from its markers."""
    from usdmotion.clustering import find_clusters
    from usdmotion.fitting import fit

    if not capture.clusters:
        clusters, notes = find_clusters(capture.markers)
        capture = replace(capture, clusters=clusters, notes=(*capture.notes, *notes))
    fitted, notes = fit(capture)
    return replace(capture, fitted=fitted, notes=(*capture.notes, *notes))


def inspect(shot: Path) -> Inspection:
    """Return what is on a stage: skeletons, clips, edits, constraints, and every fault found.

    Raises:
        FileError: It cannot be opened.
    """
    from usdmotion import usd

    _require(shot)
    return usd.inspect(shot, host().constraints)


def detect(
    shot: Path,
    output: Path,
    *,
    joints: Sequence[str] = (),
    prims: Sequence[str] = (),
    kinds: Sequence[str] = (),
    templates: Sequence[Example] = (),
    detector: str = "",
    options: Mapping[str, object] | None = None,
    minimum: float | None = None,
    edit: str = "",
    guides: bool | Path = True,
    say: Say = lambda _: None,
) -> DetectionReport:
    """Look for contacts on a shot, and write a layer over it that has them.

    What is not asked for here is left to the MotionDetections of the stage. Where there are none,
    the ankles and balls of all known feet are looked at.

    Args:
        shot: The stage; it may be a layer that was written before, or one over it.
        output: The layer to write; the shot is its sublayer.
        joints: Joints to look at, as tokens, leaf names or H-Anim names.
        prims: Paths of animated prims to look at.
        kinds: What to look for, some of space, line, point, plane, slide.
        templates: Examples, from which the noise of the motion is learnt.
        detector: Name of the detector.
        options: Options of it, on top of those on the stage.
        minimum: Contacts that last for less are dropped [s].
        edit: Path of the MotionEdit whose skeleton is looked at.
        guides: Draw the contacts too, for people to look at; in a file of their own over the
            layer, with everything else that there is to see, where one is named.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: The detector does not keep its contract.
    """
    require_room(guides, (output,), (shot,))
    asked = Asked(
        joints=tuple(joints),
        prims=tuple(prims),
        templates=tuple(templates),
        kinds=tuple(kinds),
        detector=detector,
        options=dict(options or {}),
        minimum=minimum,
        edit=edit,
        guides=guides is True,
    )
    found = search(shot, output, asked, say=say)
    guides_beside(guides, output, say=say)
    return found


def solve(
    shot: Path,
    output: Path,
    *,
    edits: Sequence[str] = (),
    solver: str | None = None,
    options: Mapping[str, object] | None = None,
    frames: tuple[float, float] | None = None,
    cleaning: float | None = None,
    ground: Ground = None,
    compose: Path | None = None,
    mend_recruiting: bool = False,
    page: Path | None = None,
    guides: bool | Path = False,
    say: Say = lambda _: None,
) -> Report:
    """Solve the edits of a stage and write the layer that puts the answer over it.

    Args:
        shot: The stage.
        output: The layer to write.
        edits: Paths of the edits to solve; none solves all.
        solver: Name of the solver; None takes what each edit says.
        options: Options of the solver, on top of those that an edit carries for it.
        frames: First and last time code to solve; None takes what each edit says.
        cleaning: Cutoff of the filter that cleans the input first [Hz], 0 for none; None takes
            what each edit says.
        ground: What the input is put on after that: paths of prims, none for no ground; a `Ground`,
            or a function that returns heights, as `FunctionGround` has it. None takes what each
            edit says.
        compose: Where to write a stage that shows the answer over the shot; None writes none.
        mend_recruiting: Let constraints recruit what the recruiting rule asks of them.
        page: Where to write the report of it, as `reporting.report` does; None writes none.
        guides: Draw what there is to see too: in the layer itself, or in a file of their own over
            it and the shot.
        say: Is told what is being done.

    Raises:
        InputError: The stage, an edit or an option is at fault.
        PluginError: The solver does not keep its contract.
    """
    _require_places(shot, (output, compose), page, guides)
    session = Session.open(
        shot,
        edits=edits,
        solver=solver,
        options=options,
        frames=frames,
        cleaning=cleaning,
        ground=ground,
        mend_recruiting=mend_recruiting,
        say=say,
    )
    say(f"writing {output}")
    told, inputs = told_by(ground), session.inputs
    draw = guides_for(guides, shot, ground=told, inputs=inputs, say=say)
    session.write(output, compose=compose, draw=draw)
    guides_beside(guides, output, shot=shot, ground=told, inputs=inputs, say=say)
    if page is not None:
        report(output, page, shot=shot, ground=told, inputs=inputs, say=say)
    return session.report()


def clean(
    shot: Path,
    output: Path,
    *,
    joints: Sequence[str] = (),
    templates: Sequence[Example] = (),
    detector: str = "",
    options: Mapping[str, object] | None = None,
    smoothing: float | None = None,
    frames: tuple[float, float] | None = None,
    page: Path | None = None,
    guides: bool | Path = False,
    say: Say = lambda _: None,
) -> PlantingReport:
    """Find where feet stand, plant them there, and write one layer over the shot that has it all.

    Args:
        shot: The stage; it may be a layer that was written before, or one over it.
        output: The layer to write; the shot is its sublayer.
        joints: The joints that stand, as tokens, leaf names or H-Anim names; none takes ankles and
            balls of all known feet.
        templates: Examples, from which the noise of the motion is learnt.
        detector: Name of the detector.
        options: Options of it, on top of those on the stage.
        smoothing: Cutoff of the filter between enforcing and enforcing again [Hz], 0 for none;
            None takes what an edit says, or 4.
        frames: First and last time code to solve; None takes what each edit says.
        page: Where to write the report of it, as `reporting.report` does; None writes none.
        guides: Draw what there is to see too: in the layer itself, or in a file of their own over
            it and the shot.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: A detector or solver does not keep its contract.
    """
    _require_places(shot, (output,), page, guides)
    asked = Asked(
        joints=tuple(joints),
        templates=tuple(templates),
        detector=detector,
        options=dict(options or {}),
        guides=not isinstance(guides, Path),
    )
    told = plant(shot, output, asked, Wish(smoothing, frames), guides=guides, say=say)
    if page is not None:
        report(output, page, say=say)
    return told


def _require(path: Path) -> None:
    if not path.is_file():
        raise FileError(f"{path}: there is no such file")


def _require_places(
    shot: Path, layers: Sequence[Path | None], page: Path | None, guides: bool | Path
) -> None:
    """Raise if what is to be written of a shot would be in the way of something, or cannot be."""
    from usdmotion import usd

    usd.require_apart(layers, (page,))
    require_room(guides, layers, (shot,))
    if page is not None:
        require_matplotlib()

"""The closed loop: feet are found, planted and looked at again, as one layer over a shot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.answering import Say, results_of, solved_scenes
from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.guiding import write_with_guides
from usdmotion.kernels import forward
from usdmotion.motion import WorldPose
from usdmotion.plugins import host
from usdmotion.report.cautions import not_held, not_still
from usdmotion.report.planting import FootReport, KeptReport, PlantingReport, feet_of, kept_of
from usdmotion.report.verdict import EditReport
from usdmotion.searching import search_over
from usdmotion.solved import SolvedScene

if TYPE_CHECKING:
    from usdmotion.usd import Overlay, Shot


@dataclass(frozen=True)
class Wish:
    """How feet are to be planted, beside what is looked for."""

    smoothing: float | None = None
    """Cutoff of the filter between enforcing and enforcing again [Hz], 0 for none; None takes what
    an edit says, or 4."""
    frames: tuple[float, float] | None = None
    """First and last time code to solve; None takes what each edit says."""


def plant(
    shot: Path,
    output: Path,
    asked: Asked,
    wish: Wish,
    *,
    guides: bool | Path = False,
    say: Say = lambda _: None,
) -> PlantingReport:
    """Find where feet stand, enforce it, and write one layer over the shot that has it all.

    Args:
        shot: The stage.
        output: The layer to write; the shot is its sublayer.
        asked: The joints that stand, how to look for it, and examples.
        wish: How to enforce it.
        guides: Draw what there is to see too: in the layer itself, or in a file of their own over
            it and the shot. Contacts are drawn where `asked` says so.
        say: Is told what is being done.

    Raises:
        InputError: The stage, or what is asked for, is at fault.
        PluginError: A detector or solver does not keep its contract.
    """
    from usdmotion import usd

    say(f"reading {shot}")
    overlay = usd.Overlay.open(shot, output)
    try:
        detections = usd.author_feet(overlay.stage, asked.joints)
        looked = search_over(overlay, _of_feet(overlay, asked, detections), say=say)
        read = _asked_of(overlay, detections, wish)
    except SceneError as error:
        named = str(error).startswith(f"{shot}: ")
        raise error if named else SceneError(f"{shot}: {error}") from error
    answers = solved_scenes(read, say=say)
    scenes, told = answers.scenes, (*read.warnings, *answers.notes)
    edits = tuple(edit for solved in scenes for edit in solved.report().edits)
    notes = (
        *looked.notes,
        *told,
        *(note for each in scenes for note in each.notes),
        *_cautions(read, edits),
    )
    results = [result for solved in scenes for result in results_of(solved)]
    layer = overlay.stage.GetRootLayer()
    overlay.remember(**usd.put(layer, read, results, output.parent, notes))
    write_with_guides(overlay, guides, inputs=answers.inputs, say=say)
    feet, kept = _became(read, scenes, detections)
    return PlantingReport(feet, kept, edits, looked.objects, notes)


def _of_feet(overlay: Overlay, asked: Asked, detections: Sequence[str]) -> Asked:
    """Return what to ask of the joints of feet, which all have a detection now."""
    stage = overlay.stage
    joints = [
        str(stage.GetPrimAtPath(path).GetAttribute("usdmotion:joint").Get()) for path in detections
    ]
    return replace(asked, joints=tuple(dict.fromkeys(joints)))


def _asked_of(overlay: Overlay, detections: Sequence[str], wish: Wish) -> Shot:
    """Return the edits of feet as they are to be solved, with what keeps the rest of the motion."""
    from usdmotion import usd

    stage = overlay.stage
    paths = usd.edits_of(stage, detections)

    def read() -> Shot:
        return usd.read_stage(
            stage,
            overlay.shot,
            edits=paths,
            frames=wish.frames,
            cleaning=None,
            kinds=host().constraints,
        )

    before = read()
    for scene in before.scenes:
        for edit in scene.edits:
            feet = [path for path in detections if path.startswith(f"{edit.path}/")]
            usd.author_passes(stage, edit.path, wish.smoothing)
            usd.author_keeping(stage, edit, scene.character(edit.skeleton), feet)
    return read()


def _cautions(read: Shot, edits: Sequence[EditReport]) -> Iterator[str]:
    """Yield what to look at: contacts that are not held, and those that hold what moves."""
    for edit in edits:
        yield from not_held(edit)
    for scene in read.scenes:
        for each in scene.edits:
            yield from not_still(scene, each)


def _became(
    read: Shot, scenes: Sequence[SolvedScene], detections: Sequence[str]
) -> tuple[tuple[FootReport, ...], tuple[KeptReport, ...]]:
    """Return what became of the feet of all scenes, and of the rest of their motions."""
    feet: list[FootReport] = []
    kept: list[KeptReport] = []
    for scene, solved in zip(read.scenes, scenes, strict=True):
        pose = _pose(solved)
        for edit in scene.edits:
            own = [path for path in detections if path.startswith(f"{edit.path}/")]
            feet += feet_of(scene, edit, pose, own)
            kept.append(kept_of(scene, edit, pose))
    return tuple(feet), tuple(kept)


def _pose(solved: SolvedScene) -> WorldPose:
    cast, solution = solved.scene.cast, solved.solution
    return forward(cast.parents, solution.translations, solution.rotations)

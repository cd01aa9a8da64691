"""A layer of results, and the shot that it belongs over."""

import os
from collections.abc import Sequence
from pathlib import Path

from pxr import Usd

from usdmotion.constraints import Constraint
from usdmotion.errors import FileError, SceneError
from usdmotion.outcome import Outcome
from usdmotion.usd.outcomes import has_edits, outcomes_of, recorded_edits
from usdmotion.usd.provenance import recorded
from usdmotion.usd.stages import open_stage, read_facts, require_composed
from usdmotion.usd.writing import composed

_SHOTS = (".usda", ".usd", ".usdc", ".usdz")
"""How the file of a shot may end."""


def read_outcomes(
    path: Path, *, shot: Path | None = None, kinds: Sequence[type[Constraint]]
) -> tuple[Outcome, ...]:
    """Return what became of the edits of a stage, or of those whose results a layer holds.

    A layer of results is put over its shot, in memory. Without `shot` that is the file beside it
    after which it is named: `walk.usda` for `walk.edit.usda`. Where several are, it is the one that
    says what the layer was made from, by the hash of it.

    Args:
        path: A stage on which results are, or a layer that `write` wrote.
        shot: The shot under the layer.
        kinds: The constraint kinds that prims can be read as.

    Raises:
        FileError: A file cannot be opened.
        SceneError: There is no result, or no shot, or they do not fit.
    """
    files, edits = _files(path, shot, kinds)
    if len(files) > 1:
        return outcomes_of(stacked(files), files[-1], kinds, edits)
    stage = open_stage(path)
    try:
        require_composed(stage)
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    return outcomes_of(stage, path, kinds)


def files_of(
    path: Path, *, shot: Path | None = None, kinds: Sequence[type[Constraint]]
) -> tuple[Path, ...]:
    """Return the files that show a stage, or a layer of results over its shot, as `read_outcomes`.

    Args:
        path: A stage, or a layer that `write` wrote.
        shot: The shot under the layer.
        kinds: The constraint kinds that prims can be read as.

    Returns:
        The stage; or the layer, and the shot under it.

    Raises:
        FileError: A file cannot be opened.
        SceneError: There is no shot, or it does not fit.
    """
    return _files(path, shot, kinds)[0]


def _files(
    path: Path, shot: Path | None, kinds: Sequence[type[Constraint]]
) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Return the files, and the paths of the edits whose results a layer over a shot holds."""
    stage = open_stage(path)
    edits = recorded_edits(recorded(stage.GetRootLayer()))
    if shot is not None:
        _require_shot(path, shot, edits)
        return (path, shot), edits
    if not edits or has_edits(stage, edits):
        return (path,), ()
    return (path, _shot_beside(path, edits, kinds)), edits


def _shot_beside(path: Path, edits: Sequence[str], kinds: Sequence[type[Constraint]]) -> Path:
    """Return the shot that a layer is named after."""
    name = path.stem.removesuffix(".edit")
    beside = [path.with_name(name + suffix) for suffix in _SHOTS]
    there = [each for each in beside if each != path and each.is_file()]
    shots = [each for each in there if has_edits(open_stage(each), edits)]
    fresh = [each for each in shots if len(shots) > 1 and _is_fresh(path, each, edits, kinds)]
    if fresh or len(shots) == 1:
        return (fresh or shots)[0]
    what = "which of those beside it is" if shots else "no file beside it is named as"
    raise SceneError(
        f"{path}: it holds results of <{edits[0]}> and has to be put over the shot that it was "
        f"made from, but {what} that shot; name it with --shot FILE"
    )


def _is_fresh(
    path: Path, shot: Path, edits: Sequence[str], kinds: Sequence[type[Constraint]]
) -> bool:
    """Tell whether a layer was made from what a shot is now."""
    found = outcomes_of(stacked((path, shot)), shot, kinds, edits)
    return not any(record.stale for each in found for record in each.records)


def _require_shot(path: Path, shot: Path, edits: Sequence[str]) -> None:
    if not edits:
        raise FileError(
            f"{path}: it is no layer that `usdmotion solve` wrote; without --shot a stage that "
            "has results on it will do"
        )
    if not has_edits(open_stage(shot), edits):
        raise SceneError(
            f"{shot}: it has not the edits of {path}, {', '.join(edits)}; name the shot that the "
            "layer was made from"
        )


def stacked(files: Sequence[Path]) -> Usd.Stage:
    """Return a stage that shows some files, the strongest first, and is read like the last."""
    stage = open_stage(files[-1])
    if len(files) == 1:
        return stage
    paths = [os.path.realpath(each) for each in files]
    return Usd.Stage.Open(composed(read_facts(stage), paths))

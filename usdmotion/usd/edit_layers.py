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
from usdmotion.usd.stages import composition_faults, open_stage, read_facts, refuse
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
    stage = open_stage(path)
    edits = recorded_edits(recorded(stage.GetRootLayer()))
    if shot is not None:
        return _over(path, shot, edits, kinds)
    if not edits or has_edits(stage, edits):
        try:
            refuse(composition_faults(stage))
        except SceneError as error:
            raise SceneError(f"{path}: {error}") from error
        return outcomes_of(stage, path, kinds)
    return _over_its_own(path, edits, kinds)


def _over_its_own(
    path: Path, edits: Sequence[str], kinds: Sequence[type[Constraint]]
) -> tuple[Outcome, ...]:
    """Return the outcomes over the shot that a layer is named after."""
    name = path.stem.removesuffix(".edit")
    beside = [path.with_name(name + suffix) for suffix in _SHOTS]
    there = [each for each in beside if each != path and each.is_file()]
    shots = [each for each in there if has_edits(open_stage(each), edits)]
    found = [_over(path, each, edits, kinds) for each in shots]
    fresh = [each for each in found if not any(r.stale for o in each for r in o.records)]
    if fresh or len(found) == 1:
        return (fresh or found)[0]
    what = "which of those beside it is" if found else "no file beside it is named as"
    raise SceneError(
        f"{path}: it holds results of <{edits[0]}> and has to be put over the shot that it was "
        f"made from, but {what} that shot; name it with --shot FILE"
    )


def _over(
    path: Path, shot: Path, edits: Sequence[str], kinds: Sequence[type[Constraint]]
) -> tuple[Outcome, ...]:
    if not edits:
        raise FileError(
            f"{path}: it is no layer that `usdmotion solve` wrote; without --shot a stage that "
            "has results on it will do"
        )
    beneath = open_stage(shot)
    if not has_edits(beneath, edits):
        raise SceneError(
            f"{shot}: it has not the edits of {path}, {', '.join(edits)}; name the shot that the "
            "layer was made from"
        )
    paths = [os.path.realpath(each) for each in (path, shot)]
    root = composed(read_facts(beneath), paths)
    return outcomes_of(Usd.Stage.Open(root), shot, kinds, edits)

"""The results that stand on a stage, read back as motions beside what they were made from."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Sdf, Usd

from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.grounding import PROGRAM
from usdmotion.motion import Motion
from usdmotion.outcome import Outcome, Record
from usdmotion.scene import Edit, Scene
from usdmotion.usd.characters import read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.origins import depends_on
from usdmotion.usd.provenance import input_hash, recorded, records
from usdmotion.usd.reading import read_stage
from usdmotion.usd.relations import bound_animation, is_a, value
from usdmotion.usd.shot import Shot, Take


@dataclass(frozen=True, eq=False)
class _Found:
    """One result on a stage."""

    animation: Usd.Prim
    edit: str
    record: str
    """Which record of which layer tells of it, "" for none."""
    said: Mapping[str, Any]
    """What that says."""
    offset: Sdf.LayerOffset
    """From times of the layer that tells of it to those of the stage."""


def outcomes_of(
    stage: Usd.Stage, path: Path, kinds: Sequence[type[Constraint]], edits: Sequence[str] = ()
) -> tuple[Outcome, ...]:
    """Return what became of the edits of a stage.

    Edits whose results were written together are read together, as they were when they were solved.

    Args:
        stage: A stage on which edits and their results are.
        path: How to call it in an error.
        kinds: The constraint kinds that prims can be read as.
        edits: Paths of the edits that are wanted; none wants all that have a result.

    Raises:
        SceneError: There is no result, or it does not fit its edit.
    """
    found = {each.edit: each for each in _results(stage) if not edits or each.edit in edits}
    try:
        if not found:
            raise SceneError("there is no result of a MotionEdit; solve it first")
        for each in found.values():
            _require_edit(stage, each)
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    outcomes = []
    for group in _groups(list(found.values())):
        said = group[0].said
        frames = tuple(group[0].offset * float(code) for code in said.get("frames", ()))
        shot = read_stage(
            stage,
            path,
            edits=[each.edit for each in group],
            frames=(frames[0], frames[1]) if len(frames) == 2 else None,
            cleaning=float(said["cleaning"]) if "cleaning" in said else None,
            ground=_ground(said),
            kinds=kinds,
        )
        notes = tuple(str(note) for note in said.get("notes", ()))
        told = PROGRAM in said.get("ground", ())
        outcomes += [_outcome(shot, scene, found, notes, told=told) for scene in shot.scenes]
    return tuple(outcomes)


def solved_edits(stage: Usd.Stage) -> tuple[str, ...]:
    """Return the paths of the edits on a stage that are switched on and have a result there."""
    found = dict.fromkeys(each.edit for each in _results(stage))
    prims = (stage.GetPrimAtPath(edit) for edit in found if has_edits(stage, [edit]))
    return tuple(str(prim.GetPath()) for prim in prims if prim.IsActive())


def recorded_edits(said: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the paths of the edits whose results a layer says that it holds."""
    return tuple(str(edit) for each in records(said) for edit in each.get("hashes", {}))


def has_edits(stage: Usd.Stage, edits: Sequence[str]) -> bool:
    """Tell whether all of some edits are on a stage."""
    return all(is_a(stage.GetPrimAtPath(edit), "UsdMotionEdit") for edit in edits)


def _results(stage: Usd.Stage) -> Iterator[_Found]:
    for prim in stage.Traverse():
        relationship = prim.GetRelationship("usdmotion:result:edit")
        if is_a(prim, "UsdSkelAnimation") and relationship:
            for edit in map(str, relationship.GetTargets()):
                yield _found(prim, edit)


def _found(animation: Usd.Prim, edit: str) -> _Found:
    for spec, offset in animation.GetPrimStackWithLayerOffsets():
        for number, said in enumerate(records(recorded(spec.layer))):
            if edit in said.get("hashes", {}):
                record = f"{number} {spec.layer.identifier}"
                return _Found(animation, edit, record, said, offset)
    return _Found(animation, edit, "", {}, Sdf.LayerOffset())


def _ground(said: Mapping[str, Any]) -> list[str] | None:
    """Return the paths of the ground that was asked for, over what the edits say."""
    paths = said.get("ground")
    return None if paths is None else [str(path) for path in paths if path != PROGRAM]


def _require_edit(stage: Usd.Stage, found: _Found) -> None:
    if not has_edits(stage, [found.edit]):
        raise SceneError(
            f"<{found.animation.GetPath()}> is a result of <{found.edit}>, which is not on the "
            "stage; put the layer over the shot that it was made from"
        )


def _groups(found: Sequence[_Found]) -> list[list[_Found]]:
    """Return results together that were made so; those of which nothing tells one by one."""
    groups: dict[str, list[_Found]] = {}
    for each in found:
        groups.setdefault(each.record or each.edit, []).append(each)
    return list(groups.values())


def _outcome(
    shot: Shot, scene: Scene, found: Mapping[str, _Found], notes: tuple[str, ...], *, told: bool
) -> Outcome:
    takes = {take.edit: take for take in shot.takes}
    return Outcome(
        scene=scene,
        motions={
            edit.skeleton: _motion(shot, scene, edit, found[edit.path]) for edit in scene.edits
        },
        records=tuple(
            _record(shot, takes[edit.path], edit, found[edit.path]) for edit in scene.edits
        ),
        notes=notes,
        told=told,
    )


def _motion(shot: Shot, scene: Scene, edit: Edit, found: _Found) -> Motion:
    skeleton = found.animation.GetStage().GetPrimAtPath(edit.skeleton)
    try:
        sitting = read_character(skeleton, found.animation, scene.time_codes, shot.facts)
    except SceneError as error:
        raise SceneError(f"{shot.path}: {error}") from error
    return sitting.character.motion


def _record(shot: Shot, take: Take, edit: Edit, found: _Found) -> Record:
    animation = found.animation
    skeleton = animation.GetStage().GetPrimAtPath(edit.skeleton)
    bound = bound_animation(skeleton)
    return Record(
        edit=edit.path,
        solver=str(value(animation, "usdmotion:result:solver", "")),
        version=str(value(animation, "usdmotion:result:version", "")),
        options=dict(found.said.get("options", {}).get(edit.path, {})),
        input_hash=str(value(animation, "usdmotion:result:inputHash", "")),
        hash_now=input_hash(shot, take, _first(animation)),
        shown=bound is not None
        and depends_on(bound, animation.GetStage().GetPrimAtPath(edit.path)),
    )


def _first(animation: Usd.Prim) -> float | None:
    """Return the time code of the first sample of a result, None where it does not move."""
    codes = own_times(animation)
    return float(codes[0]) if len(codes) else None

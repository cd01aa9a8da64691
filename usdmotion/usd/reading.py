"""The reader: a stage becomes scenes of plain values."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.errors import SceneError
from usdmotion.scene import Edit, Scene
from usdmotion.usd.bindings import holder_of
from usdmotion.usd.characters import Sitting, read_character
from usdmotion.usd.clips import merged
from usdmotion.usd.concerns import warnings
from usdmotion.usd.constraints import other_skeletons, read_constraints
from usdmotion.usd.edits import (
    DEFAULT_SOLVER,
    Request,
    animation_to_bind,
    find_edits,
    options_of,
    refuse_rivals,
    request,
    result_path,
)
from usdmotion.usd.grounds import read_ground
from usdmotion.usd.relations import bound_animation, value
from usdmotion.usd.shot import Facts, Shot, Take
from usdmotion.usd.sources import folder_of, read_extras
from usdmotion.usd.stages import open_stage, read_facts, require_composed, used_files


def read(
    path: Path,
    *,
    edits: Sequence[str] = (),
    frames: tuple[float, float] | None = None,
    cleaning: float | None = None,
    ground: Sequence[str] | None = None,
    kinds: Sequence[type[Constraint]],
) -> Shot:
    """Return the scenes of a stage.

    Args:
        path: A file of USD.
        edits: Paths of the MotionEdits that are wanted; none wants all.
        frames: First and last time code, over what the edits say.
        cleaning: Cutoff of the filter of the input [Hz], over what the edits say.
        ground: Paths of the prims that the input is put on, over what the edits say.
        kinds: The constraint kinds that prims can be read as.

    Raises:
        FileError: The file cannot be opened.
        SceneError: Something on the stage cannot be solved, or had to be guessed.
    """
    stage = open_stage(path)
    return read_stage(
        stage, path, edits=edits, frames=frames, cleaning=cleaning, ground=ground, kinds=kinds
    )


def read_stage(
    stage: Usd.Stage,
    path: Path,
    *,
    edits: Sequence[str],
    frames: tuple[float, float] | None,
    cleaning: float | None,
    ground: Sequence[str] | None = None,
    kinds: Sequence[type[Constraint]],
) -> Shot:
    """Return the scenes of a stage that is open, as `read` does; errors name the path."""
    try:
        require_composed(stage)
        facts = read_facts(stage)
        requests = [
            request(edit, frames, facts, cleaning=cleaning, ground=ground)
            for edit in find_edits(stage, edits)
        ]
        refuse_rivals(requests)
        read_groups = [_read_group(group, kinds, facts) for group in couple(requests)]
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    return Shot(
        path=path,
        facts=facts,
        layers=used_files(stage),
        scenes=tuple(scene for scene, _ in read_groups),
        takes=tuple(take for _, takes in read_groups for take in takes),
        warnings=warnings((each.edit for each in requests), _players(requests)),
        frames=frames,
        cleaning=cleaning,
        ground=None if ground is None else tuple(ground),
    )


def couple(requests: Sequence[Request]) -> list[list[Request]]:
    """Return requests in groups: together where one is relative to a joint that another moves."""
    spaces = {each.path: other_skeletons(each.edit) for each in requests}

    def meet(one: Request, other: Request) -> bool:
        skeletons = (str(each.skeleton.GetPath()) for each in (one, other))
        return next(skeletons) in spaces[other.path] or next(skeletons) in spaces[one.path]

    groups: list[list[Request]] = []
    for new in requests:
        met = [group for group in groups if any(meet(new, other) for other in group)]
        groups = [group for group in groups if group not in met]
        groups.append([*(each for group in met for each in group), new])
    order = {each.path: index for index, each in enumerate(requests)}
    sorted_groups = [sorted(group, key=lambda each: order[each.path]) for group in groups]
    return sorted(sorted_groups, key=lambda group: order[group[0].path])


def _read_group(
    requests: Sequence[Request], kinds: Sequence[type[Constraint]], facts: Facts
) -> tuple[Scene, list[Take]]:
    time_codes = merged([each.time_codes for each in requests])
    sittings = {
        str(skeleton.GetPath()): read_character(skeleton, animation, time_codes, facts)
        for skeleton, animation in _players(requests)
    }
    edits = tuple(_edit(each, kinds, sittings, time_codes, facts) for each in requests)
    scene = Scene(
        characters=tuple(sitting.character for sitting in sittings.values()),
        edits=edits,
        time_codes=time_codes,
        up=facts.up,
    )
    takes = [_take(each, sittings[str(each.skeleton.GetPath())]) for each in requests]
    return scene, takes


def _players(requests: Sequence[Request]) -> list[tuple[Usd.Prim, Usd.Prim | None]]:
    """Return the skeletons that take part and what moves each, the edited ones first."""
    players: dict[str, tuple[Usd.Prim, Usd.Prim | None]] = {
        str(each.skeleton.GetPath()): (each.skeleton, each.source) for each in requests
    }
    for each in requests:
        for path, skeleton in other_skeletons(each.edit).items():
            players.setdefault(path, (skeleton, bound_animation(skeleton)))
    return list(players.values())


def _edit(
    each: Request,
    kinds: Sequence[type[Constraint]],
    sittings: Mapping[str, Sitting],
    time_codes: Floats,
    facts: Facts,
) -> Edit:
    skeleton = str(each.skeleton.GetPath())
    return Edit(
        path=each.path,
        skeleton=skeleton,
        constraints=read_constraints(each.edit, skeleton, kinds, sittings, time_codes, facts),
        solver=str(value(each.edit, "usdmotion:solver", "")) or DEFAULT_SOLVER,
        options=options_of(each.edit),
        smoothing=max(float(value(each.edit, "usdmotion:smoothing", 0.0)), 0.0),
        cleaning=each.cleaning,
        ground=read_ground(each.ground, time_codes, facts),
        passes=max(int(value(each.edit, "usdmotion:passes", 1)), 1),
    )


def _take(each: Request, sitting: Sitting) -> Take:
    return Take(
        edit=each.path,
        result=result_path(each.edit),
        holder=holder_of(each.skeleton),
        bound=animation_to_bind(each.edit, each.skeleton),
        source=str(each.source.GetPath()),
        joints=sitting.clip,
        columns=sitting.columns,
        own=sitting.own,
        solved=sitting.solved,
        units=sitting.scaling.of_parents,
        rest=sitting.joints.rest,
        extras=read_extras(each.source),
        folder=folder_of(each.source),
    )

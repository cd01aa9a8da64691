"""Edits and constraints of any kind, authored on a stage from plain values."""

from collections.abc import Mapping, Sequence

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.usd.attribute_authoring import author_fields, define, time_code_array
from usdmotion.usd.clips import own_times
from usdmotion.usd.frame_authoring import author_relations, author_space, in_units
from usdmotion.usd.goal_authoring import author_goal
from usdmotion.usd.origins import source_of
from usdmotion.usd.relations import edit_of, floats, skeleton_of, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts
from usdmotion.usd.times import solved_times

_OPTION_TYPES = {
    bool: Sdf.ValueTypeNames.Bool,
    int: Sdf.ValueTypeNames.Int,
    float: Sdf.ValueTypeNames.Double,
    str: Sdf.ValueTypeNames.Token,
}


def author_edit(
    stage: Usd.Stage,
    path: str,
    *,
    skeleton: str = "",
    source: str = "",
    solver: str = "",
    frames: tuple[float, float] | None = None,
    sample_rate: float = 0.0,
    smoothing: float = 0.0,
    passes: int = 1,
    ground: Sequence[str] = (),
    options: Mapping[str, bool | int | float | str] | None = None,
) -> None:
    """Author a MotionEdit, or change the one that is there.

    Args:
        stage: Where, in its edit target.
        path: Path of the prim.
        skeleton: Path of the Skeleton; "" is the nearest ancestor.
        source: Path of the SkelAnimation to start from; "" is the one that is bound.
        solver: Registered name; "" is the default one.
        frames: First and last time code to solve; None is all of the source.
        sample_rate: Samples per second of the result; 0 is the source's own times.
        smoothing: Cutoff of the filter between two passes [Hz]; 0 is off.
        passes: How often the constraints are enforced; with smoothing at least twice.
        ground: Paths of the prims that the input is put on; none leaves it where it is.
        options: Options of the solver.
    """
    prim = define(stage, path, "MotionEdit")
    for name, target in (("skeleton", skeleton), ("source", source)):
        if target:
            prim.CreateRelationship(f"usdmotion:{name}", custom=False).SetTargets([target])
    if ground:
        prim.CreateRelationship("usdmotion:ground", custom=False).SetTargets(list(ground))
    if solver:
        prim.GetAttribute("usdmotion:solver").Set(solver)
    if frames is not None:
        prim.GetAttribute("usdmotion:range").Set(time_code_array(frames))
    if sample_rate:
        prim.GetAttribute("usdmotion:sampleRate").Set(float(sample_rate))
    if smoothing:
        prim.GetAttribute("usdmotion:smoothing").Set(float(smoothing))
    if passes != 1:
        prim.GetAttribute("usdmotion:passes").Set(passes)
    author_options(prim, options or {})


def author_options(prim: Usd.Prim, options: Mapping[str, bool | int | float | str]) -> None:
    """Give a prim the options of a solver."""
    for name, chosen in options.items():
        kind = _OPTION_TYPES[type(chosen)]
        prim.CreateAttribute(f"usdmotion:option:{name}", kind, custom=True).Set(chosen)


def author(
    stage: Usd.Stage,
    path: str,
    constraint: Constraint,
    *,
    time_codes: Sequence[float] | Floats | None = None,
) -> None:
    """Author a constraint of any kind with its goals; what is at its default is not written.

    Args:
        stage: Where, in its edit target.
        path: Path of the prim, under a MotionEdit; the constraint's own path says nothing here.
        constraint: What to author, in metres and seconds.
        time_codes: Time code of each frame of what is animated; the first is where seconds start.
            None starts where the edit does and has nothing animated.

    Raises:
        SceneError: Something is animated and nobody says when, or cannot be told on a stage.
    """
    facts = read_facts(stage)
    codes = _first_code(stage, path, facts) if time_codes is None else np.array(time_codes, float)
    prim = define(stage, path, constraint.schema)
    author_space(constraint, prim)
    author_relations(constraint, prim)
    author_fields(prim, in_units(constraint, prim, edit_of(prim), codes, facts), codes, facts)
    for index, goal in enumerate(constraint.goals):
        name = goal.path.rsplit("/", 1)[-1] or f"Goal{index + 1}"
        author_goal(define(stage, f"{path}/{name}", "MotionGoal"), goal, codes, facts)


def _first_code(stage: Usd.Stage, path: str, facts: Facts) -> Floats:
    """Return the time code at which the edit that a constraint is part of will be solved first."""
    edit = edit_of(stage.GetPrimAtPath(Sdf.Path(path).GetParentPath()))
    skeleton = skeleton_of(edit) if edit else None
    if edit is None or skeleton is None:
        return np.array([facts.start or 0.0])
    own = own_times(source_of(edit, skeleton))
    span = floats(value(edit, "usdmotion:range", ()))
    rate = float(value(edit, "usdmotion:sampleRate", 0.0))
    ends = (span[0], span[1]) if span else None
    return solved_times(own, ends, rate, facts, f"<{edit.GetPath()}>")[:1]

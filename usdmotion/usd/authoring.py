"""Edits and constraints of any kind, authored on a stage from plain values."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.usd.attribute_authoring import author_fields, define, time_code_array
from usdmotion.usd.goal_authoring import author_goal
from usdmotion.usd.scaling import joint_units
from usdmotion.usd.stages import read_facts

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
        options: Options of the solver.
    """
    prim = define(stage, path, "MotionEdit")
    for name, target in (("skeleton", skeleton), ("source", source)):
        if target:
            prim.CreateRelationship(f"usdmotion:{name}", custom=False).SetTargets([target])
    if solver:
        prim.GetAttribute("usdmotion:solver").Set(solver)
    if frames is not None:
        prim.GetAttribute("usdmotion:range").Set(time_code_array(frames))
    if sample_rate:
        prim.GetAttribute("usdmotion:sampleRate").Set(float(sample_rate))
    for name, value in (options or {}).items():
        kind = _OPTION_TYPES[type(value)]
        prim.CreateAttribute(f"usdmotion:option:{name}", kind, custom=True).Set(value)


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
            None starts at the stage's start and has nothing animated.

    Raises:
        SceneError: Something is animated and nobody says when, or cannot be told on a stage.
    """
    facts = read_facts(stage)
    codes = np.asarray([facts.start or 0.0] if time_codes is None else time_codes, dtype=np.float64)
    if np.any(constraint.point):
        units = joint_units(stage, constraint.skeleton, constraint.joint, codes, facts)
        point = np.squeeze(constraint.point / units * facts.meters_per_unit)
        constraint = replace(constraint, point=point)
    prim = define(stage, path, constraint.schema)
    author_fields(prim, constraint, codes, facts)
    for index, goal in enumerate(constraint.goals):
        name = goal.path.rsplit("/", 1)[-1] or f"Goal{index + 1}"
        author_goal(define(stage, f"{path}/{name}", "MotionGoal"), goal, codes, facts)

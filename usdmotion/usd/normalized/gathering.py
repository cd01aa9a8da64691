"""The constraints of an edit, ready to leave their body: in the world, in joints, or in props."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, Space, attributes
from usdmotion.kernels import multiply, rotate
from usdmotion.travelling import Left, StaysBehind, Traveller
from usdmotion.usd.attributes import collapse
from usdmotion.usd.characters import Sitting
from usdmotion.usd.constraints import constraint_prims, goal_prims, read_constraint
from usdmotion.usd.relations import target, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import local_matrices, rigid, world_matrices

_SAME = 1e-9


def gather(
    edit: Usd.Prim,
    skeleton: str,
    kinds: Sequence[type[Constraint]],
    sittings: Mapping[str, Sitting],
    time_codes: Floats,
    facts: Facts,
) -> tuple[tuple[Traveller, ...], tuple[Left, ...]]:
    """Return the constraints of an edit, still on their body, and those that cannot leave it.

    What is on at other times only has nothing to do with the motion, and is neither.

    Args:
        edit: The MotionEdit.
        skeleton: Path of the Skeleton that it solves.
        kinds: What prims can be read as.
        sittings: The characters that it is about by the paths of their skeletons.
        time_codes: The frames.
        facts: Units and rates of the stage.

    Raises:
        SceneError: A constraint says what cannot be.
    """
    known = {kind.schema for kind in kinds}
    found, left = [], []
    for prim in constraint_prims(edit):
        name = str(prim.GetPath().MakeRelativePath(edit.GetPath()))
        if str(prim.GetTypeName()) not in known:
            left.append(Left(name, f"nothing installed here knows a {prim.GetTypeName()}"))
            continue
        constraint = read_constraint(prim, edit, skeleton, kinds, sittings, time_codes, facts)
        span = constraint.span((time_codes - time_codes[0]) / facts.time_codes_per_second)
        if span.start >= span.stop:
            continue
        try:
            found.append(_traveller(name, prim, edit, constraint, time_codes, facts))
        except StaysBehind as why:
            left.append(Left(name, str(why)))
    return tuple(found), tuple(left)


def _traveller(
    name: str,
    prim: Usd.Prim,
    edit: Usd.Prim,
    constraint: Constraint,
    time_codes: Floats,
    facts: Facts,
) -> Traveller:
    props: dict[str, str] = {}
    if hasattr(constraint, "space"):
        prop = _prop(prim, edit, time_codes)
        if prop is not None:
            props[""] = str(prop.GetPath())
        else:
            constraint = _in_world(constraint)
    goals = []
    for goal, held in zip(constraint.goals, goal_prims(prim), strict=True):
        prop = _prop(held, edit, time_codes) if goal.mode != "offset" else None
        if prop is not None:
            props[held.GetName()] = str(prop.GetPath())
            goal = _in_prop(goal, held, prop, time_codes, facts)
        goals.append(replace(goal, path=held.GetName()))
    constraint = replace(constraint, path="", goals=tuple(goals))
    return Traveller(name, constraint, props)


def _prop(prim: Usd.Prim, edit: Usd.Prim, time_codes: Floats) -> Usd.Prim | None:
    """Return the prim in whose frame something is given, None where that is a joint or the world.

    What is in the edit itself goes where that goes, and so does what stands where the world is.
    """
    if value(prim, "usdmotion:spaceJoint", ""):
        return None
    named = target(prim, "usdmotion:space")
    if named is None or named.GetPath().HasPrefix(edit.GetPath()):
        return None
    matrices = world_matrices(named, time_codes)
    return None if np.abs(matrices - np.eye(4)).max() <= _SAME else named


def _in_world(constraint: Any) -> Constraint:
    """Return a constraint whose space is the world, unless that is a joint.

    Raises:
        StaysBehind: Its space moves, and its places are the same for the whole shot.
    """
    space: Space = constraint.space
    if space.joint is not None:
        return constraint  # type: ignore[no-any-return]
    if space.translation.ndim > 1 or space.rotation.ndim > 1:
        raise StaysBehind("it is held in the frame of prims above it, which move")
    changed: dict[str, Any] = {"space": Space()}
    for each in attributes(type(constraint)):
        held = np.asarray(getattr(constraint, each.field)) if each.frame == "space" else None
        if held is None or not held.size:
            continue
        if held.shape[-1] == 4:
            changed[each.field] = multiply(space.rotation, held)
        else:
            at = space.translation if each.unit == "length" else 0.0
            changed[each.field] = rotate(space.rotation, held) + at
    return replace(constraint, **changed)  # type: ignore[no-any-return]


def _in_prop(goal: Goal, prim: Usd.Prim, prop: Usd.Prim, time_codes: Floats, facts: Facts) -> Goal:
    """Return a goal in the frame of a prop, in metres there."""
    places, turns, _ = rigid(local_matrices(prim, time_codes), f"<{prim.GetPath()}>")
    _, _, scales = rigid(world_matrices(prop, time_codes), f"<{prop.GetPath()}>")
    metres = places * scales * facts.meters_per_unit
    return replace(
        goal,
        translation=collapse(metres),
        rotation=collapse(turns),
        axes=np.array([0.0, 0.0, 0.0, 1.0]),
    )

"""The way back: lengths in metres as a constraint's prim gives them in frames of its own."""

from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Attribute, Constraint, Space, attributes, relations
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.usd.relations import target
from usdmotion.usd.scaling import joint_units
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import parent_matrices, rigid, world_matrices

_SAME = 1e-6


def in_units(
    constraint: Constraint,
    prim: Usd.Prim,
    edit: Usd.Prim | None,
    codes: Floats,
    facts: Facts,
    *,
    prop: Floats | None = None,
) -> Constraint:
    """Return a constraint whose lengths, over the stage's unit, are what its prim should say.

    Args:
        constraint: In metres; its space is the world, or a joint.
        prim: The prim that is to say it, in the prim that its space names already, if any.
        edit: Its MotionEdit.
        codes: Time code of each frame.
        facts: Units and rates of the stage.
        prop: Scale of the prop in whose frame its places are, in metres there, shape (3,); None is
            the space of the constraint.

    Raises:
        SceneError: A frame moves or changes its scale, and a value is one for the whole shot.
    """
    changed: dict[str, Any] = {}
    for each in attributes(type(constraint)):
        given = np.asarray(getattr(constraint, each.field)) if each.frame else None
        if given is None or not given.size or (each.unit != "length" and each.frame != "space"):
            continue
        if each.frame == "space" and prop is not None:
            changed[each.field] = given / prop if each.unit == "length" else given
        elif each.frame == "space":
            changed[each.field] = _in_space(constraint, each, given, prim, codes, facts)
        elif not np.any(given):
            continue
        elif each.frame == "edit":
            axes = world_matrices(edit or prim.GetParent(), codes)[:, :3, :3]
            turned = (np.atleast_2d(given)[:, None] @ np.linalg.inv(axes))[:, 0]
            changed[each.field] = turned if len(turned) > 1 else turned[0]
        else:
            changed[each.field] = _in_joints(constraint, each, given, prim, codes, facts)
    return replace(constraint, **changed) if changed else constraint


def author_space(constraint: Constraint, prim: Usd.Prim) -> None:
    """Name the joint that the space of a constraint is, if it is one.

    Raises:
        SceneError: It is a frame that only a prim can stand for.
    """
    space = getattr(constraint, "space", None)
    if space is None or _is_world(space):
        return
    if space.joint is None:
        raise SceneError(
            f"<{prim.GetPath()}> gives places in a frame that is not the world's; author it under "
            "a prim that has it, or name one in usdmotion:space"
        )
    skeleton, token = space.joint
    attribute = prim.GetAttribute("usdmotion:spaceJoint")
    if not attribute:
        raise SceneError(
            f"<{prim.GetPath()}> gives places in the frame of a joint, which a "
            f"{prim.GetTypeName()} cannot; name a prim in usdmotion:space"
        )
    prim.GetRelationship("usdmotion:space").SetTargets([skeleton])
    attribute.Set(token)


def author_relations(constraint: Constraint, prim: Usd.Prim) -> None:
    """Name the prims that a constraint is about.

    Raises:
        SceneError: One has no path.
    """
    for each in relations(type(constraint)):
        named = getattr(constraint, each.field)
        if not named:
            continue
        path = named if isinstance(named, str) else named.path
        if not path:
            raise SceneError(
                f"<{prim.GetPath()}> is to name a prim in {each.name} whose path nobody says; "
                "author that prim and give its path"
            )
        prim.GetRelationship(each.name).SetTargets([path])


def _is_world(space: Space) -> bool:
    here = np.array_equal(space.rotation, Space().rotation) and not np.any(space.translation)
    return space.joint is None and here


def _in_space(
    constraint: Any, each: Attribute, given: Floats, prim: Usd.Prim, codes: Floats, facts: Facts
) -> Floats:
    """Return points, a direction or an orientation in the space of a constraint."""
    space: Space = constraint.space
    if space.joint is not None:
        if each.unit != "length":
            return given
        units = joint_units(prim.GetStage(), *space.joint, codes, facts)
        return np.asarray(given / _still(units, prim) * facts.meters_per_unit)
    if not _is_world(space):
        return given
    named = target(prim, "usdmotion:space")
    matrices = world_matrices(named, codes) if named else parent_matrices(prim, codes)
    origin, axes, scales = rigid(_still(matrices, prim)[None], f"<{(named or prim).GetPath()}>")
    back = conjugate(axes[0])
    if each.unit != "length":
        return multiply(back, given) if given.shape == (4,) else rotate(back, given)
    return np.asarray(rotate(back, given - origin[0] * facts.meters_per_unit) / scales[0])


def _in_joints(
    constraint: Constraint,
    each: Attribute,
    points: Floats,
    prim: Usd.Prim,
    codes: Floats,
    facts: Facts,
) -> Floats:
    tokens = getattr(constraint, each.frame)
    skeleton = getattr(constraint, each.skeleton) or constraint.skeleton
    one = isinstance(tokens, str)
    units = [
        _still(joint_units(prim.GetStage(), skeleton, token, codes, facts), prim)
        for token in ([tokens] if one else tokens)
    ]
    factors = units[0] if one else np.array(units)
    return np.asarray(points / factors * facts.meters_per_unit)


def _still(values: Floats, prim: Usd.Prim) -> Floats:
    if np.ptp(values, axis=0).max() > _SAME * np.abs(values).max():
        raise SceneError(
            f"<{prim.GetPath()}> gives places in a frame that moves or changes its scale, and they "
            "are the same for the whole shot; give them in a frame that does not"
        )
    return np.asarray(values[0])

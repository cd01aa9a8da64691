"""Lengths that a constraint gives in a frame of its own: a joint's, its space's, its edit's."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Attribute, Constraint, Space, attributes
from usdmotion.errors import SceneError
from usdmotion.usd.attributes import collapse
from usdmotion.usd.characters import Sitting
from usdmotion.usd.goals import space_skeleton
from usdmotion.usd.relations import target, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import parent_matrices, rigid, world_matrices


def in_metres(
    constraint: Constraint,
    prim: Usd.Prim,
    edit: Usd.Prim,
    sittings: Mapping[str, Sitting],
    time_codes: Floats,
    facts: Facts,
) -> Constraint:
    """Return a constraint with its space, and with all its lengths in metres.

    Args:
        constraint: As its prim says, lengths as if every frame had the stage's units.
        prim: The prim.
        edit: Its MotionEdit.
        sittings: The characters of the scene by the paths of their skeletons.
        time_codes: The frames.
        facts: Units and rates of the stage.

    Raises:
        SceneError: It names a joint that is not there, or a frame whose scale changes.
    """
    changed: dict[str, Any] = {}
    in_space = np.ones((1, 3))
    if hasattr(constraint, "space"):
        changed["space"], in_space = _space(prim, sittings, time_codes, facts)
    for each in attributes(type(constraint)):
        given = getattr(constraint, each.field)
        if not each.frame or each.unit != "length" or not np.any(given):
            continue
        if each.frame == "space":
            changed[each.field] = given * _steady(in_space, prim)
        elif each.frame == "edit":
            axes = world_matrices(edit, time_codes)[:, :3, :3]
            changed[each.field] = collapse((np.atleast_2d(given)[:, None] @ axes)[:, 0])
        else:
            sitting = sittings[getattr(constraint, each.skeleton) or constraint.skeleton]
            changed[each.field] = _in_joints(constraint, each, sitting, facts)
    return replace(constraint, **changed) if changed else constraint


def _space(
    prim: Usd.Prim, sittings: Mapping[str, Sitting], time_codes: Floats, facts: Facts
) -> tuple[Space, Floats]:
    """Return the space of a constraint, and its scale next to that of the stage."""
    skeleton = space_skeleton(prim)
    if skeleton is not None:
        sitting = sittings[str(skeleton.GetPath())]
        token = str(value(prim, "usdmotion:spaceJoint"))
        joint = _joint(sitting, token, prim)
        scales = sitting.scaling.of_joints[:, joint] / facts.meters_per_unit
        return Space(joint=(sitting.character.path, token)), scales
    named = target(prim, "usdmotion:space")
    matrices = (
        parent_matrices(prim, time_codes) if named is None else world_matrices(named, time_codes)
    )
    name = f"<{(named or prim).GetPath()}>"
    translations, rotations, scales = rigid(matrices, name)
    place = collapse(translations * facts.meters_per_unit)
    return Space(translation=place, rotation=collapse(rotations)), scales


def _in_joints(constraint: Constraint, each: Attribute, sitting: Sitting, facts: Facts) -> Floats:
    """Return points in the frames of joints that may be scaled, one for all or one for each."""
    given = getattr(constraint, each.field)
    tokens = getattr(constraint, each.frame)
    prim = sitting.character.path
    if isinstance(tokens, str):
        index = sitting.character.skeleton.index.get(tokens)
        if index is None:
            return np.asarray(given)  # whoever uses the joint says that it is not there
        scales = sitting.scaling.of_joints[:, index] / facts.meters_per_unit
        return np.asarray(collapse(given * scales))
    index_of = sitting.character.skeleton.index
    known = [index_of[token] for token in tokens if token in index_of]
    if len(known) != len(tokens) or len(tokens) != len(given):
        return np.asarray(given)  # whoever uses them says what is wrong
    scales = sitting.scaling.of_joints[:, known] / facts.meters_per_unit
    if np.ptp(scales, axis=0).max(initial=0.0) > 1e-9:
        raise SceneError(
            f"<{constraint.path}> holds points of joints of <{prim}> whose scale changes over "
            "time; hold joints that are not scaled"
        )
    return np.asarray(given * scales[0])


def _joint(sitting: Sitting, token: str, prim: Usd.Prim) -> int:
    index = sitting.character.skeleton.index.get(token)
    if index is None:
        raise SceneError(
            f"<{prim.GetPath()}> is in the frame of the joint '{token}', which "
            f"<{sitting.character.path}> does not have; name one of its joints"
        )
    return index


def _steady(scales: Floats, prim: Usd.Prim) -> Floats:
    if np.ptp(scales, axis=0).max() > 1e-6 * np.abs(scales).max():
        raise SceneError(
            f"<{prim.GetPath()}> gives places in a space whose scale changes over time; name one "
            "whose scale does not"
        )
    return np.asarray(scales[0])

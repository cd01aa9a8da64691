"""Goals, authored as prims whose transform is where the effector is wanted."""

from collections.abc import Callable

import numpy as np
from pxr import Gf, Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.constraints import Goal
from usdmotion.errors import SceneError
from usdmotion.usd.attribute_authoring import author_fields, set_frames
from usdmotion.usd.scaling import joint_units
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import parent_matrices

_IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])
_SAME = 1e-9


def author_goal(prim: Usd.Prim, goal: Goal, time_codes: Floats, facts: Facts) -> None:
    """Give a MotionGoal prim its attributes and its transform.

    Args:
        prim: The prim.
        goal: Where and how the effector is wanted, in the world or in a joint.
        time_codes: Time code of each frame.
        facts: Units and rates of the stage.

    Raises:
        SceneError: It is in a space that only a prim can stand for.
    """
    author_fields(prim, goal, time_codes, facts)
    if goal.joint is not None:
        skeleton, token = goal.joint
        units = joint_units(prim.GetStage(), skeleton, token, time_codes, facts)
        prim.GetRelationship("usdmotion:space").SetTargets([skeleton])
        prim.GetAttribute("usdmotion:spaceJoint").Set(token)
        author_transform(prim, goal.translation / units, goal.rotation, time_codes)
        return
    xform = UsdGeom.Xformable(prim)
    matrices = parent_matrices(prim, time_codes)
    if np.abs(matrices - np.eye(4)).max() > _SAME:
        xform.SetResetXformStack(True)
    if np.abs(goal.axes - _IDENTITY).max() > _SAME:
        raise SceneError(
            f"<{prim.GetPath()}> is given in axes that are not the world's; author it under a "
            "prim that has them, or name one in usdmotion:space"
        )
    author_transform(prim, goal.translation / facts.meters_per_unit, goal.rotation, time_codes)


def author_transform(
    prim: Usd.Prim, translation: Floats, rotation: Floats, time_codes: Floats
) -> None:
    """Give a prim a translation in stage units and a rotation, on each frame where it moves."""
    xform = UsdGeom.Xformable(prim)
    reset = xform.GetResetXformStack()
    xform.ClearXformOpOrder()
    move = xform.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).GetAttr()
    turn = xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).GetAttr()
    xform.SetResetXformStack(reset)
    _set(move, translation, time_codes, _vector)
    _set(turn, rotation, time_codes, _quaternion)


def _set(
    attribute: Usd.Attribute,
    value: Floats,
    time_codes: Floats,
    convert: Callable[[Floats], object],
) -> None:
    value = np.squeeze(value)
    if value.ndim > 1:
        set_frames(attribute, value, time_codes, convert)
    else:
        attribute.Set(convert(value))


def _vector(value: Floats) -> Gf.Vec3d:
    return Gf.Vec3d(*value.tolist())


def _quaternion(value: Floats) -> Gf.Quatd:
    x, y, z, w = value.tolist()
    return Gf.Quatd(w, x, y, z)

"""Skeletons and animations that cannot be read without guessing."""

from collections.abc import Iterator

import numpy as np
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion.usd.faults.fault import Fault, error, warning
from usdmotion.usd.relations import (
    ARRAYS,
    bound_animation,
    joints_of,
    names_target,
    skeleton_of,
    target,
    value,
)


def find_unreadable_skeletons(prim: Usd.Prim) -> Iterator[Fault]:
    """Find skeletons whose joints are no tree, or whose transforms are not one for each joint."""
    joints = joints_of(prim)
    if not joints:
        yield error(prim, "NoJoints", "has no joints; set its joints attribute")
        return
    yield from _find_duplicates(prim, joints)
    is_tree, _ = UsdSkel.Topology(list(joints)).Validate()
    if not is_tree and len(set(joints)) == len(joints):
        yield error(
            prim, "WrongTopology", "lists a joint before its parent; put parents before children"
        )
    for name in ("restTransforms", "bindTransforms"):
        count = len(value(prim, name, ()))
        if count not in (0, len(joints)):
            yield error(
                prim,
                "TransformCount",
                f"has {count} {name} for {len(joints)} joints; give one for each, or none",
            )
    yield from _find_uneven_scale(prim)


def find_unusable_bindings(prim: Usd.Prim) -> Iterator[Fault]:
    """Find skeletons that no animation moves, or one that has none of their joints."""
    animation = bound_animation(prim)
    if animation is None:
        yield warning(
            prim,
            "NoAnimation",
            "has no animation bound, so it rests; apply SkelBindingAPI, set skel:animationSource",
        )
        return
    ours, theirs = joints_of(prim), joints_of(animation)
    if ours and theirs and not set(ours) & set(theirs):
        yield error(
            prim,
            "AnimationJoints",
            f"is bound to <{animation.GetPath()}>, which has none of its joints; bind another, or "
            "rename the joints of the animation",
        )


def find_unsolvable_edits(prim: Usd.Prim) -> Iterator[Fault]:
    """Find edits of no skeleton, and edits of one that nothing moves."""
    skeleton = skeleton_of(prim)
    if skeleton is None:
        if not names_target(prim, "usdmotion:skeleton"):  # a wrong one is named by another check
            yield error(
                prim,
                "UnknownSkeleton",
                "solves no Skeleton; set usdmotion:skeleton or put the edit under one",
            )
    elif target(prim, "usdmotion:source") is None and bound_animation(skeleton) is None:
        yield error(
            prim,
            "NoAnimation",
            f"has no motion to start from, as <{skeleton.GetPath()}> has no animation bound; bind "
            "one or set usdmotion:source",
        )


def find_resting_animations(prim: Usd.Prim) -> Iterator[Fault]:
    """Find animations of which USD shows nothing but the rest pose."""
    missing = [name for name in ARRAYS if not prim.GetAttribute(name).HasAuthoredValue()]
    if missing:
        yield warning(
            prim,
            "MissingTransforms",
            f"has no {' and no '.join(missing)}, so USD shows the rest pose; author all three",
        )


def find_unreadable_animations(prim: Usd.Prim) -> Iterator[Fault]:
    """Find animations without joints, or whose transforms are not one for each joint."""
    joints = joints_of(prim)
    if not joints:
        yield error(prim, "NoJoints", "has no joints; set its joints attribute")
        return
    yield from _find_duplicates(prim, joints)
    for name in ARRAYS:
        attribute = prim.GetAttribute(name)
        if not attribute.HasAuthoredValue():
            continue
        for time in attribute.GetTimeSamples() or [Usd.TimeCode.Default()]:
            count = len(attribute.Get(time) or ())
            if count != len(joints):
                yield error(
                    prim,
                    "TransformCount",
                    f"has {count} {name} at {_time(time)} for {len(joints)} joints; give one for "
                    "each at every time",
                )
                break


def _time(time: Usd.TimeCode | float) -> str:
    return "its default" if isinstance(time, Usd.TimeCode) else f"{time:g}"


def _find_duplicates(prim: Usd.Prim, joints: tuple[str, ...]) -> Iterator[Fault]:
    for joint in sorted({joint for joint in joints if joints.count(joint) > 1}):
        yield error(
            prim, "DuplicateJoint", f"lists the joint '{joint}' more than once; make tokens unique"
        )


def _find_uneven_scale(prim: Usd.Prim) -> Iterator[Fault]:
    """Find a skeleton that its parents stretch more along one axis than another."""
    xform = UsdGeom.Xformable(prim)
    for time in (Usd.TimeCode.Default(), Usd.TimeCode.EarliestTime()):
        rows = np.array(xform.ComputeLocalToWorldTransform(time))[:3, :3]
        square = rows @ rows.T
        even = np.eye(3) * (np.trace(square) / 3.0)
        if not np.allclose(square, even, atol=1e-4 * np.trace(square)):
            yield error(
                prim,
                "UnevenScale",
                "is scaled unevenly or sheared by a transform above it; make the scale uniform",
            )
            return

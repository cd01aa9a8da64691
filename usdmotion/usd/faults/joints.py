"""Joint tokens and body parts that are not there."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.usd.faults.fault import Fault, error, warning
from usdmotion.usd.relations import (
    edit_of,
    is_a,
    joints_of,
    names_target,
    skeleton_of,
    suggestion,
    target,
    travels,
    value,
)

TOKENS = {
    "usdmotion:joint": "usdmotion:skeleton",
    "usdmotion:recruits": "usdmotion:skeleton",
    "usdmotion:supports": "usdmotion:skeleton",
    "usdmotion:otherJoint": "usdmotion:otherSkeleton",
    "usdmotion:spaceJoint": "usdmotion:space",
}
"""Attributes that hold joint tokens, and the relationship that names the Skeleton they are of."""

HOLDS_A_JOINT = (
    "UsdMotionPositionConstraint",
    "UsdMotionOrientationConstraint",
    "UsdMotionAimConstraint",
    "UsdMotionDistanceConstraint",
    "UsdMotionRegionConstraint",
    "UsdMotionTrajectoryConstraint",
    "UsdMotionContactConstraint",
)
"""Kinds that mean nothing without a joint."""


def find_unknown_joints(prim: Usd.Prim) -> Iterator[Fault]:
    """Find joint tokens of edits, goals and detections that their Skeleton does not have."""
    if travels(prim):
        return  # its joints are parts of any body
    for name, relationship in TOKENS.items():
        written = value(prim, name, ())
        tokens = [written] if isinstance(written, str) else list(written)
        tokens = [str(token) for token in tokens if token]
        if not tokens:
            continue
        skeleton = _skeleton(prim, relationship)
        if skeleton is None:
            yield error(
                prim,
                "UnknownSkeleton",
                f"names the joint '{tokens[0]}' in {name}, but of no Skeleton; set {relationship}",
            )
            continue
        known = joints_of(skeleton)
        for token in tokens:
            # A skeleton without any joints is a fault of its own, and said once.
            if known and token not in known:
                yield error(
                    prim,
                    "UnknownJoint",
                    f"names the joint '{token}' in {name}, which <{skeleton.GetPath()}> does not "
                    f"have; {suggestion(token, known)}",
                )


def find_missing_effectors(prim: Usd.Prim) -> Iterator[Fault]:
    """Find constraints that hold nothing, or that nothing solves."""
    has_object = names_target(prim, "usdmotion:object")
    if travels(prim):
        return
    if edit_of(prim) is None:
        # The contacts of a detection outside an edit are data, not constraints.
        if not is_a(prim.GetParent(), "UsdMotionDetection"):
            yield warning(prim, "NoEdit", "is under no MotionEdit; nothing solves it, so move it")
    elif any(is_a(prim, kind) for kind in HOLDS_A_JOINT):
        if not value(prim, "usdmotion:joint", "") and not has_object:
            yield error(prim, "MissingJoint", "holds no joint; set usdmotion:joint")


def find_unknown_parts(prim: Usd.Prim) -> Iterator[Fault]:
    """Find body parts that have no H-Anim name, or that two joints claim to be."""
    definition = prim.GetPrimDefinition()
    known = tuple(definition.GetPropertyMetadata("usdmotion:parts", "allowedTokens") or ())
    seen: dict[str, int] = {}
    for index, part in enumerate(value(prim, "usdmotion:parts", ())):
        if part and part not in known:
            yield error(
                prim,
                "UnknownPart",
                f"calls joint {index} '{part}' in usdmotion:parts, which is not an H-Anim joint; "
                f"{suggestion(part, known[1:])}",
            )
        elif part and part in seen:
            yield error(
                prim,
                "DuplicatePart",
                f"says in usdmotion:parts that joints {seen[part]} and {index} are both '{part}'; "
                'leave one of them ""',
            )
        seen.setdefault(part, index)


def _skeleton(prim: Usd.Prim, relationship: str) -> Usd.Prim | None:
    if relationship == "usdmotion:skeleton":
        return skeleton_of(prim)
    named = target(prim, relationship)
    if named is not None:
        return named if is_a(named, "UsdSkelSkeleton") else None
    # A distance is between joints of one skeleton unless it says otherwise; a space is the world's.
    return skeleton_of(prim) if relationship == "usdmotion:otherSkeleton" else None

"""Constraints of a lower rank that may move what a higher one may not."""

from collections.abc import Iterator

from pxr import Usd, UsdSkel

from usdmotion.errors import SceneError
from usdmotion.recruiting import Claim, Parents, chain, violations
from usdmotion.usd.faults.fault import Fault, warning
from usdmotion.usd.origins import source_of
from usdmotion.usd.relations import (
    constraints_of,
    is_a,
    joints_of,
    skeleton_of,
    target,
    value,
)
from usdmotion.usd.roots import root_of


def find_broken_recruiting(prim: Usd.Prim) -> Iterator[Fault]:
    """Find constraints of an edit that may move a joint under one of higher rank that may not."""
    parents, claims = claims_of(prim)
    for broken in violations(parents, claims):
        joints = ", ".join(f"'{joint}'" for joint in broken.joints)
        low = prim.GetStage().GetPrimAtPath(broken.low)
        yield warning(
            low,
            "RecruitingRule",
            f"may move {joints} under <{broken.high}>, which is of a higher rank and does not "
            f"recruit them; add them to its usdmotion:recruits, or take them from this one",
        )


def claims_of(edit: Usd.Prim) -> tuple[Parents, list[Claim]]:
    """Return the joints of the Skeleton of an edit, and what its constraints claim of them.

    Both are empty where the joints are no tree; another check says so.
    """
    skeleton = skeleton_of(edit)
    if skeleton is None or not _is_tree(joints_of(skeleton)):
        return {}, []
    parents = _parents(joints_of(skeleton))
    root = _root(edit, skeleton)
    return parents, [
        _claim(constraint, skeleton, parents, root) for constraint in constraints_of(edit)
    ]


def _is_tree(joints: tuple[str, ...]) -> bool:
    return bool(joints) and bool(UsdSkel.Topology(list(joints)).Validate()[0])


def _parents(joints: tuple[str, ...]) -> Parents:
    indices = UsdSkel.Topology(list(joints)).GetParentIndices()
    return {
        joint: joints[index] if index >= 0 else None
        for joint, index in zip(joints, indices, strict=True)
    }


def _root(edit: Usd.Prim, skeleton: Usd.Prim) -> str:
    try:
        source = source_of(edit, skeleton)
    except SceneError:  # other checks say so
        source = None
    return joints_of(skeleton)[root_of(skeleton, source)]


def _claim(constraint: Usd.Prim, skeleton: Usd.Prim, parents: Parents, root: str) -> Claim:
    ends = {str(value(constraint, "usdmotion:joint", ""))}
    if (target(constraint, "usdmotion:otherSkeleton") or skeleton) == skeleton:
        ends.add(str(value(constraint, "usdmotion:otherJoint", "")))
    ends &= set(parents)
    if is_a(constraint, "UsdMotionCenterOfMassConstraint"):
        ends = set(parents)
    default = {joint for end in ends for joint in chain(parents, end, root)}
    recruits = {str(joint) for joint in value(constraint, "usdmotion:recruits", ())}
    return Claim(
        name=str(constraint.GetPath()),
        priority=int(value(constraint, "usdmotion:priority", 1)),
        effectors=frozenset(ends | (_frames(constraint, skeleton) & set(parents))),
        recruits=frozenset((recruits or default) & set(parents)),
    )


def _frames(constraint: Usd.Prim, skeleton: Usd.Prim) -> set[str]:
    """Return the joints of this skeleton in whose frame the constraint has its targets."""
    goals = [child for child in constraint.GetChildren() if is_a(child, "UsdMotionGoal")]
    return {
        str(value(prim, "usdmotion:spaceJoint", ""))
        for prim in [constraint, *goals]
        if target(prim, "usdmotion:space") == skeleton
    }

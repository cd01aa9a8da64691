"""Effectors that rank above the balance: who reaches so gets what he asked for, and falls over."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from pxr import Usd, UsdSkel

from usdmotion.humanoid import PartMap, recognize
from usdmotion.humanoid.parts import LEG
from usdmotion.usd.constraints import constraint_prims
from usdmotion.usd.relations import is_a, joints_of, skeleton_of, value
from usdmotion.usd.roots import in_rest, parts_of

_BALANCE = "UsdMotionCenterOfMassConstraint"
_TURNS = ("UsdMotionOrientationConstraint", "UsdMotionAimConstraint")
"""Kinds that ask for no place."""


@dataclass(frozen=True, slots=True)
class Note:
    """Something that is as it may be, and that one should know."""

    path: str
    """Path of the prim."""
    sentence: str
    """What it leads to, and what would do."""


def falls(edit: Usd.Prim) -> Iterator[Note]:
    """Yield a note on each constraint of an edit that pulls the body out of its balance.

    It holds a point of a joint that carries no weight and ranks above a centre of mass. What
    carries weight are legs and pelvis where it is known which joints these are; else what the
    centre of mass has as supports, with what is above and below those.
    """
    constraints = list(constraint_prims(edit))
    balances = [prim for prim in constraints if is_a(prim, _BALANCE)]
    skeleton = skeleton_of(edit)
    if not balances or skeleton is None:
        return
    lowest = max(balances, key=_priority)
    carries = _carrying(skeleton, balances)
    for prim in constraints:
        joint = str(value(prim, "usdmotion:joint", ""))
        reaches = not is_a(prim, _BALANCE) and not any(is_a(prim, kind) for kind in _TURNS)
        if reaches and joint and joint not in carries and _priority(prim) < _priority(lowest):
            yield Note(
                str(prim.GetPath()),
                f"<{prim.GetPath()}> ranks above <{lowest.GetPath()}>: the body reaches as far as "
                "it is asked to and falls over; give the centre of mass the smaller "
                "usdmotion:priority if it is to stay in balance",
            )


def _priority(prim: Usd.Prim) -> int:
    return int(value(prim, "usdmotion:priority", 1))


def _carrying(skeleton: Usd.Prim, balances: list[Usd.Prim]) -> set[str]:
    """Return the joints that carry weight."""
    tokens = joints_of(skeleton)
    parents = np.array(UsdSkel.Topology(list(tokens)).GetParentIndices(), dtype=np.int64)
    supports = {str(each) for prim in balances for each in value(prim, "usdmotion:supports", ())}
    shape = in_rest(skeleton, parents)
    if shape is None:
        return set(tokens)  # a fault says what is wrong with it
    parts = recognize(shape, parts_of(skeleton, len(tokens)))
    if parts is not None:
        supports |= {tokens[joint] for joint in _ankles(parts)}
    held = {shape.index[token] for token in supports if token in shape.index}
    above = {joint for support in held for joint in shape.chain(support)}
    below = {joint for joint in range(len(tokens)) if held & set(shape.chain(joint))}
    return {tokens[joint] for joint in above | below}


def _ankles(parts: PartMap) -> list[int]:
    found = (parts.joint(f"{side}_{LEG[2]}") for side in "lr")
    return [joint for joint in found if joint is not None]

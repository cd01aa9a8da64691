"""Effectors that rank above the balance: who reaches so gets what he asked for, and falls over."""

from collections.abc import Iterator

import numpy as np
from pxr import Usd, UsdSkel

from usdmotion.humanoid import PartMap, recognize
from usdmotion.humanoid.parts import LEG
from usdmotion.usd.faults.fault import Fault, note
from usdmotion.usd.relations import constraints_of, is_a, joints_of, skeleton_of, value
from usdmotion.usd.roots import in_rest, parts_of

_BALANCE = "UsdMotionCenterOfMassConstraint"
_TURNS = ("UsdMotionOrientationConstraint", "UsdMotionAimConstraint")
"""Kinds that ask for no place."""


def find_falls(prim: Usd.Prim) -> Iterator[Fault]:
    """Find constraints of an edit that rank above its balance, and pull the body out of it."""
    # They hold a point of a joint that carries no weight. What carries weight are legs and pelvis
    # where it is known which joints these are; else what the centre of mass has as supports, with
    # what is above and below those.
    constraints = list(constraints_of(prim))
    balances = [each for each in constraints if is_a(each, _BALANCE)]
    skeleton = skeleton_of(prim)
    if not balances or skeleton is None:
        return
    lowest = max(balances, key=_priority)
    carries = _carrying(skeleton, balances)
    for each in constraints:
        joint = str(value(each, "usdmotion:joint", ""))
        reaches = not any(is_a(each, kind) for kind in (_BALANCE, *_TURNS))
        if reaches and joint and joint not in carries and _priority(each) < _priority(lowest):
            yield note(
                each,
                "RanksAboveBalance",
                f"ranks above <{lowest.GetPath()}>: the body reaches as far as it is asked to and "
                "falls over; give the centre of mass the smaller usdmotion:priority if it is to "
                "stay in balance",
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

"""Guessing which joint is which, and refusing what is not sure."""

from collections.abc import Sequence

import numpy as np

from usdmotion.errors import SceneError
from usdmotion.humanoid.digits import find_digits
from usdmotion.humanoid.limbs import find_limb
from usdmotion.humanoid.names import Name, read_names
from usdmotion.humanoid.part_map import PartMap
from usdmotion.humanoid.parts import PARTS, SPINE, finger, toe
from usdmotion.humanoid.trunk import find_trunk
from usdmotion.humanoid.words import ARM_LIMB, HEAD, INHUMAN, INHUMAN_HEAD, LEG_LIMB
from usdmotion.motion import Skeleton

_COMPACT = {part.replace("_", ""): part for part in PARTS}
_PAIRS = (("shoulder", "elbow"), ("elbow", "radiocarpal"), ("hip", "knee"), ("knee", "talocrural"))
_ALIKE = 2.0
"""How many times as long as its twin a limb may be, before it is not a twin."""
_CURE = "author usdmotion:parts on it"


def guess(
    skeleton: Skeleton,
    *,
    names: Sequence[str] = (),
    given: Sequence[str] = (),
    who: str = "the skeleton",
) -> PartMap:
    """Return which joint is which part of a human body.

    Names say the sides and the joints of arms, legs and head; the hierarchy says the trunk and
    has to confirm them. H-Anim names are taken as they are where there is a `humanoid_root`.

    Args:
        skeleton: Its joints and its rest pose, any pose and facing anywhere.
        names: Original names of the joints, where the tokens are not these.
        given: What is known already (`usdmotion:parts`), parallel to the joints; "" is to be
            guessed. It wins.
        who: How to call the skeleton in an error.

    Raises:
        SceneError: Parts that every human body has are missing, or several joints could be them.
    """
    said = PartMap.given(given, len(skeleton.joints), who=who)
    read = read_names(names or skeleton.joints)
    known = said.parts if any(said.parts) else _spoken(read)
    if not any(known):
        _refuse_animals(skeleton, read, who)
    found, unclear = _find(skeleton, read, known)
    parts = list(known)
    for part, joint in found.items():
        parts[joint] = parts[joint] or part
    guessed = PartMap(tuple(parts))
    _refuse_missing(guessed, unclear, who)
    if said.missing:
        _refuse_unlike(skeleton, guessed, who)
    return guessed


def recognize(skeleton: Skeleton, given: Sequence[str] = ()) -> PartMap | None:
    """Return what `guess` returns, None where it is not sure."""
    try:
        return guess(skeleton, given=given)
    except SceneError:
        return None


def pelvis(skeleton: Skeleton, given: Sequence[str] = ()) -> int | None:
    """Return the joint that carries legs and trunk, None where that is not sure.

    Args:
        skeleton: Its joints.
        given: What is known already (`usdmotion:parts`), parallel to the joints; it wins.
    """
    try:
        said = PartMap.given(given, len(skeleton.joints)).pelvis
    except SceneError:
        return None
    if said is not None:
        return said
    found = recognize(skeleton, given)
    return None if found is None else found.pelvis


def _spoken(names: Sequence[Name]) -> tuple[str, ...]:
    """Return the parts that names are, where they are names of H-Anim."""
    parts = [_COMPACT.get(name.compact, "") for name in names]
    if "humanoid_root" not in parts:
        return ("",) * len(parts)
    return tuple(part if parts.count(part) == 1 else "" for part in parts)


def _find(
    skeleton: Skeleton, names: Sequence[Name], given: Sequence[str]
) -> tuple[dict[str, int], list[str]]:
    """Return the joint of each part, and the parts that several joints could be."""
    limbs = [
        find_limb(skeleton, names, given, side, limb)
        for side in "lr"
        for limb in (ARM_LIMB, LEG_LIMB)
    ]
    found = {part: joint for limb in limbs for part, joint in limb.joints.items()}
    trunk = find_trunk(skeleton, names, given, found)
    unclear = [*(part for limb in limbs for part in limb.unclear), *trunk.unclear]
    found |= trunk.joints
    for side in "lr":
        wrist, ankle = found.get(f"{side}_radiocarpal"), found.get(f"{side}_talocrural")
        digits = {} if wrist is None else find_digits(skeleton, names, wrist, finger)
        if ankle is not None and f"{side}_metatarsophalangeal" not in found:
            digits |= find_digits(skeleton, names, ankle, toe)
        found |= {f"{side}_{part}": joint for part, joint in digits.items()}
    return {part: joint for part, joint in found.items() if part not in given}, unclear


def _refuse_animals(skeleton: Skeleton, names: Sequence[Name], who: str) -> None:
    for joint, name in enumerate(names):
        on_head = any(names[above].core in HEAD for above in skeleton.chain(joint)[1:])
        if (INHUMAN_HEAD if on_head else INHUMAN) & set(name.words):
            raise SceneError(
                f"{who} is not taken for a human body because of its joint "
                f"'{skeleton.joints[joint]}'; {_CURE} if it is one"
            )


def _refuse_missing(parts: PartMap, unclear: Sequence[str], who: str) -> None:
    missing = [part for part in _causes(parts) if part not in unclear]
    if not parts.missing:
        return
    if not any(parts.parts) and not unclear:
        raise SceneError(f"no joint of {who} can be told to be part of a human body; {_CURE}")
    faults = []
    if missing:
        faults.append(f"no joint of {who} can be told to be {', '.join(missing)}")
    if unclear:
        faults.append(f"several joints of {who} could be {', '.join(unclear)}")
    raise SceneError(f"{', and '.join(faults)}; {_CURE}")


def _causes(parts: PartMap) -> list[str]:
    """Return the missing parts without those that would be known if the others were."""
    missing = set(parts.missing)
    if missing & {"skullbase", "l_hip", "r_hip"}:
        missing -= {"humanoid_root", SPINE[0]}
    elif missing & {"l_shoulder", "r_shoulder"}:
        missing -= {SPINE[0]}
    return [part for part in parts.missing if part in missing]


def _refuse_unlike(skeleton: Skeleton, parts: PartMap, who: str) -> None:
    """Refuse a body whose left and right do not confirm each other."""
    for upper, lower in _PAIRS:
        left, right = (_length(skeleton, parts, f"{s}_{upper}", f"{s}_{lower}") for s in "lr")
        if not 0.0 < max(left, right) <= _ALIKE * min(left, right):
            raise SceneError(
                f"{who} has {left:.3g} m from l_{upper} to l_{lower} and {right:.3g} m on the "
                f"right, which is no human body; {_CURE}"
            )


def _length(skeleton: Skeleton, parts: PartMap, upper: str, lower: str) -> float:
    top, end = parts.joint(upper), parts.joint(lower)
    assert top is not None and end is not None
    chain = skeleton.chain(end)
    if top not in chain:
        return 0.0
    return float(
        np.linalg.norm(skeleton.rest_translations[list(chain[: chain.index(top)])], axis=1).sum()
    )

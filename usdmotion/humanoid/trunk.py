"""Pelvis, back, neck and head: the way from where the legs meet to the head."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from usdmotion.humanoid.names import Name
from usdmotion.humanoid.parts import NECK, SPINE
from usdmotion.humanoid.words import HEAD, PELVIS
from usdmotion.humanoid.words import NECK as NECK_WORDS
from usdmotion.motion import Skeleton


@dataclass(frozen=True)
class FoundTrunk:
    """The trunk, as far as it is clear."""

    joints: Mapping[str, int]
    """The joint of each part."""
    unclear: tuple[str, ...]
    """Parts that several joints could be."""


def find_trunk(
    skeleton: Skeleton, names: Sequence[Name], given: Sequence[str], limbs: Mapping[str, int]
) -> FoundTrunk:
    """Return which joints are pelvis, vertebrae and head.

    The hierarchy decides: the pelvis is where both legs and the head meet, the back reaches up to
    where both arms and the head meet, and the neck from there to the head. Only the head is known
    by its name, and a pelvis above that place.
    """
    heads = _heads(skeleton, names, given)
    hips = [limbs[part] for part in ("l_hip", "r_hip") if part in limbs]
    if len(heads) != 1:
        return FoundTrunk({}, ("skullbase",) if heads else ())
    (head,) = heads
    found = {"skullbase": head}
    root = None if len(hips) != 2 else _pelvis(skeleton, names, given, [*hips, head])
    if root is None:
        return FoundTrunk(found, ())
    found["humanoid_root"] = root
    legs = meeting(skeleton, hips)
    if legs is not None and root in skeleton.chain(legs) and legs not in skeleton.chain(head):
        found["sacroiliac"] = legs
    arms = [limbs[part] for part in ("l_shoulder", "r_shoulder") if part in limbs]
    chest = meeting(skeleton, [*arms, head]) if len(arms) == 2 else None
    way = list(reversed(skeleton.chain(head)))
    if chest is None or root not in way or way.index(chest) <= way.index(root):
        return FoundTrunk(found, ())
    back = way[way.index(root) + 1 : way.index(chest) + 1]
    neck = way[way.index(chest) + 1 : -1]
    return FoundTrunk({**found, **_spread(SPINE, back, given), **_spread(NECK, neck, given)}, ())


def meeting(skeleton: Skeleton, joints: Sequence[int]) -> int | None:
    """Return the lowest joint that carries all of some joints, None where there is none."""
    chains = [skeleton.chain(joint) for joint in joints]
    return next((step for step in chains[0] if all(step in chain for chain in chains)), None)


def _pelvis(
    skeleton: Skeleton, names: Sequence[Name], given: Sequence[str], ends: Sequence[int]
) -> int | None:
    if "humanoid_root" in given:
        return given.index("humanoid_root")
    root = meeting(skeleton, ends)
    if root is None:
        return None
    named = (step for step in skeleton.chain(root) if names[step].core in PELVIS)
    # A rig may hang the legs on the first vertebra: a pelvis above it is the pelvis all the same.
    return next((step for step in named if not names[step].side), root)


def _heads(skeleton: Skeleton, names: Sequence[Name], given: Sequence[str]) -> list[int]:
    """Return the joints that are named head, the topmost of each chain."""
    if "skullbase" in given:
        return [given.index("skullbase")]
    open_ = [joint for joint, part in enumerate(given) if not part and not names[joint].side]
    heads = [joint for joint in open_ if names[joint].core in HEAD]
    topmost = [joint for joint in heads if not set(skeleton.chain(joint)[1:]) & set(heads)]
    if topmost:
        return topmost
    # Of a row of necks without a head, the last one carries it.
    row = [joint for joint in open_ if names[joint].core in NECK_WORDS]
    is_row = len(row) > 1 and set(row) <= set(skeleton.chain(row[-1]))
    return [row[-1]] if is_row and row[-1] not in skeleton.parents else []


def _spread(order: Sequence[str], joints: Sequence[int], given: Sequence[str]) -> dict[str, int]:
    """Give the vertebrae of a column, as evenly as may be, to some joints in a row."""
    found: dict[str, int] = {}
    first = 0
    for place, joint in enumerate(joints):
        if given[joint]:
            first = order.index(given[joint]) + 1 if given[joint] in order else first
            continue
        later = [order.index(given[above]) for above in joints[place:] if given[above] in order]
        last = min(later, default=len(order))
        index = max(first, min(len(order) * place // len(joints), last - 1))
        if index < last and order[index] not in given:
            found[order[index]] = joint
            first = index + 1
    return found

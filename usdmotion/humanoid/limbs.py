"""Arms and legs: chains of joints whose names say what they are, taken together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from usdmotion.humanoid.names import Name
from usdmotion.humanoid.words import Limb
from usdmotion.motion import Skeleton

_SURE = 100.0
"""How much it counts that somebody has said what a joint is."""


@dataclass(frozen=True)
class FoundLimb:
    """A limb of one side."""

    joints: Mapping[str, int]
    """The joint of each part that is clear, by the part's name with its side."""
    unclear: tuple[str, ...]
    """Needed parts that several joints could be."""


@dataclass(frozen=True)
class _Reading:
    """What one chain of joints can be at best."""

    weight: float
    joints: Mapping[str, int]


def find_limb(
    skeleton: Skeleton, names: Sequence[Name], given: Sequence[str], side: str, limb: Limb
) -> FoundLimb:
    """Return which joints are an arm or a leg.

    Args:
        skeleton: Its joints.
        names: What their names say.
        given: What somebody has said they are.
        side: "l" or "r".
        limb: The arm or the leg.
    """
    labels = _labels(skeleton, names, given, side, limb)
    inner = {above for joint in labels for above in skeleton.chain(joint)[1:]}
    readings = [
        _read([step for step in reversed(skeleton.chain(end)) if step in labels], labels, limb)
        for end in labels
        if end not in inner
    ]
    if not readings:
        return FoundLimb({}, ())
    best = max(reading.weight for reading in readings)
    complete = [each for each in readings if all(part in each.joints for part in limb.needed)]
    best_ones = [each for each in readings if each.weight == best]
    unclear = _differing(complete or best_ones, limb.needed)
    loose = {*unclear, *_differing(best_ones, limb.chain)}
    clear = {part: joint for part, joint in best_ones[0].joints.items() if part not in loose}
    return FoundLimb(
        {f"{side}_{part}": joint for part, joint in clear.items()},
        tuple(f"{side}_{part}" for part in unclear),
    )


def _differing(readings: Sequence[_Reading], parts: Sequence[str]) -> list[str]:
    return [part for part in parts if len({each.joints.get(part) for each in readings}) > 1]


def _labels(
    skeleton: Skeleton, names: Sequence[Name], given: Sequence[str], side: str, limb: Limb
) -> dict[int, dict[str, float]]:
    """Return what each joint may be, and how much that counts."""
    sides = inherited_sides(skeleton, names)
    labels: dict[int, dict[str, float]] = {}
    for joint, name in enumerate(names):
        said = given[joint].partition("_")
        if said[0] == side and said[2] in limb.chain:
            labels[joint] = {said[2]: _SURE}
        elif not given[joint] and sides[joint] == side and not name.is_digit:
            meanings = limb.words.get(name.core, {})
            left = {part: m for part, m in meanings.items() if f"{side}_{part}" not in given}
            labels |= {joint: left} if left else {}
    row = [joint for joint in labels if names[joint].core == limb.series]
    if len(row) == len(labels) and len(row) in limb.series_means:
        return {joint: dict.fromkeys(limb.series_means[len(row)], 1.0) for joint in row}
    return labels


def inherited_sides(skeleton: Skeleton, names: Sequence[Name]) -> list[str]:
    """Return the side of each joint: what its name says, else what is said above it."""
    sides: list[str] = []
    for joint, name in enumerate(names):
        parent = int(skeleton.parents[joint])
        sides.append(name.side or (sides[parent] if parent >= 0 else ""))
    return sides


def _read(steps: list[int], labels: Mapping[int, Mapping[str, float]], limb: Limb) -> _Reading:
    """Return what a chain is at best: parts in their order, of two equals the upper joint."""

    @cache
    def best(step: int, first: int) -> tuple[float, tuple[tuple[str, int], ...]]:
        if step == len(steps):
            return 0.0, ()
        choice: tuple[float, tuple[tuple[str, int], ...]] | None = None
        for index, part in enumerate(limb.chain[first:], start=first):
            if part in labels[steps[step]]:
                weight, rest = best(step + 1, index + 1)
                weight += labels[steps[step]][part]
                if choice is None or weight > choice[0]:
                    choice = weight, ((part, steps[step]), *rest)
        skipped = best(step + 1, first)
        return skipped if choice is None or skipped[0] > choice[0] else choice

    weight, joints = best(0, 0)
    return _Reading(weight, dict(joints))

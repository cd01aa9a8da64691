"""Who may move what: the rule that keeps a lower rank from disturbing a higher one.

2003, section 3.1: for a constraint a of higher rank than b, `Rec(b) ∩ C ⊂ Rec(a)`, where C are the
joints that can move both. Where b moves a joint under a that a may not move itself, a cannot take
the movement back, and the order of the ranks is broken without a word.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

Parents = Mapping[str, str | None]
"""The parent of every joint of one skeleton, None for a top joint; parents come first."""


@dataclass(frozen=True, slots=True)
class Claim:
    """What one constraint moves and depends on, as joint tokens of one skeleton."""

    name: str
    """How the constraint is called in a report, such as its path."""
    priority: int
    """Rank; 1 is enforced first."""
    effectors: frozenset[str]
    """Joints that carry its effectors, and those of this skeleton that carry its moving target."""
    recruits: frozenset[str]
    """Joints that it may move."""


@dataclass(frozen=True, slots=True)
class Violation:
    """One pair of constraints that breaks the rule."""

    high: str
    """Name of the constraint of the higher rank, which would be disturbed."""
    low: str
    """Name of the constraint of the lower rank, which would disturb it."""
    joints: tuple[str, ...]
    """Joints that the higher one has to recruit as well, in the order of the skeleton."""


def chain(parents: Parents, joint: str, root: str | None = None) -> tuple[str, ...]:
    """Return a joint and its ancestors, from the joint up to the root of the solve, or to the top.

    A joint that is not below the root keeps its whole chain.
    """
    found: list[str] = []
    step: str | None = joint
    while step is not None:
        found.append(step)
        if step == root:
            break
        step = parents[step]
    return tuple(found)


def movers(parents: Parents, effectors: Iterable[str]) -> frozenset[str]:
    """Return the joints that can move any of the effectors: themselves and all their ancestors."""
    return frozenset(joint for effector in effectors for joint in chain(parents, effector))


def violations(parents: Parents, claims: Sequence[Claim]) -> list[Violation]:
    """List the pairs that break the rule, the most important constraint first."""
    moves = {claim.name: movers(parents, claim.effectors) for claim in claims}
    ranked = sorted(claims, key=lambda claim: claim.priority)
    found = []
    for index, high in enumerate(ranked):
        for low in ranked[index + 1 :]:
            shared = moves[high.name] & moves[low.name]
            missing = (low.recruits & shared) - high.recruits
            if high.priority < low.priority and missing:
                joints = tuple(joint for joint in parents if joint in missing)
                found.append(Violation(high.name, low.name, joints))
    return found


def allowed(parents: Parents, claims: Sequence[Claim], low: Claim) -> frozenset[str]:
    """Return the joints that a claim may recruit under some others without breaking the rule."""
    moves = movers(parents, low.effectors)
    recruits = low.recruits
    for high in claims:
        if high.priority < low.priority:
            recruits -= (moves & movers(parents, high.effectors)) - high.recruits
    return recruits


def mend(parents: Parents, claims: Sequence[Claim]) -> list[Claim]:
    """Return the claims with the fewest joints added that make them keep the rule."""
    moves = {claim.name: movers(parents, claim.effectors) for claim in claims}
    mended: dict[str, Claim] = {}
    # From the lowest rank up: what is added to one is then asked of all that rank above it.
    for high in sorted(claims, key=lambda claim: -claim.priority):
        recruits = high.recruits
        for low in mended.values():
            if low.priority > high.priority:
                recruits |= low.recruits & moves[high.name] & moves[low.name]
        mended[high.name] = replace(high, recruits=recruits)
    return [mended[claim.name] for claim in claims]

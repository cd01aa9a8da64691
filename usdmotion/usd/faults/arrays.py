"""Arrays that are not as long as what they run parallel to."""

from collections.abc import Iterator

import numpy as np
from pxr import Usd

from usdmotion.usd.faults.fault import Fault, error
from usdmotion.usd.relations import joints_of, mistyped, value

PARALLEL_TO_JOINTS = (
    "parts",
    "masses",
    "massCenters",
    "limitsMin",
    "limitsMax",
    "stiffness",
    "priorities",
)
"""Arrays of MotionSkeletonAPI, without their namespace."""

PARALLEL = {
    "usdmotion:points": "usdmotion:keys",
    "usdmotion:releases": "usdmotion:keys",
    "usdmotion:tension": "usdmotion:keys",
    "usdmotion:continuity": "usdmotion:keys",
    "usdmotion:bias": "usdmotion:keys",
    "usdmotion:supportPoints": "usdmotion:supports",
    "usdmotion:limbFrames": "usdmotion:limbs",
    "usdmotion:limbLengths": "usdmotion:limbs",
    "usdmotion:segmentRotations": "usdmotion:segments",
    "usdmotion:carrierShares": "usdmotion:carriers",
    "usdmotion:offsets": "usdmotion:offsetJoints",
    "usdmotion:extraRotations": "usdmotion:extraJoints",
}
"""Arrays of other prims and what each runs parallel to."""

MANDATORY = ("usdmotion:points", "usdmotion:limbFrames", "usdmotion:limbLengths")
"""Arrays that mean something only in full; of the others none may be authored at all."""


def find_wrong_body_arrays(prim: Usd.Prim) -> Iterator[Fault]:
    """Find body parts, masses and limits that are not one for each joint of the Skeleton."""
    count = len(joints_of(prim))
    for name in PARALLEL_TO_JOINTS:
        length = len(value(prim, f"usdmotion:{name}", ()))
        if count and length not in (0, count):
            yield error(
                prim,
                "ArrayLength",
                f"has {length} values in usdmotion:{name} for {count} joints; give one for each",
            )
    yield from _find_crossed_limits(prim)


def find_wrong_arrays(prim: Usd.Prim) -> Iterator[Fault]:
    """Find arrays that are not as long as the keys or names they run parallel to."""
    for name, other in PARALLEL.items():
        attribute = prim.GetAttribute(name)
        if not attribute or mistyped(attribute):
            continue
        count = len(value(prim, other, ()))
        allowed = (count,) if name in MANDATORY else (0, count)
        # One time code stands for the value of an attribute that has no samples.
        for time in attribute.GetTimeSamples() or [Usd.TimeCode.Default()]:
            length = len(attribute.Get(time) or ())
            if length not in allowed:
                yield error(
                    prim,
                    "ArrayLength",
                    f"has {length} values in {name} for {count} in {other}; give one for each",
                )
                break


def _find_crossed_limits(prim: Usd.Prim) -> Iterator[Fault]:
    lower = np.asarray(value(prim, "usdmotion:limitsMin", ()), dtype=np.float64)
    upper = np.asarray(value(prim, "usdmotion:limitsMax", ()), dtype=np.float64)
    if lower.shape != upper.shape or lower.size == 0:
        return
    joints = joints_of(prim)
    for index in np.flatnonzero((lower > upper).any(axis=1)):
        joint = joints[index] if index < len(joints) else index
        yield error(
            prim,
            "LimitsCrossed",
            f"has a usdmotion:limitsMin above usdmotion:limitsMax at joint '{joint}'; swap them",
        )

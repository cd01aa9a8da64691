"""What of a normalized motion has a place on a body."""

from usdmotion.humanoid import NECK, SPINE
from usdmotion.report.retargeting import MappedReport
from usdmotion.s4d import Morphology, NormalizedMotion
from usdmotion.s4d.bodies.places import MIDDLES, ROOT, TOPS


def mapped_of(motion: NormalizedMotion, body: Morphology) -> MappedReport:
    """Return what of a motion has a place on a body, and what has none."""
    moving = (ROOT, *TOPS, *MIDDLES, *motion.segments)
    own = tuple(part for part in body.parts.parts if part)
    there = tuple(part for part in own if part in moving)
    lone = [part for part in (*moving, *own) if (part in moving) != (part in own)]
    shared = tuple(part for part in lone if _row(part) & {_leaf_row(each) for each in there})
    tokens = body.skeleton.joints
    leaves = [token.rsplit("/", 1)[-1] for token in tokens]
    carried = tuple(
        token
        for token in motion.extra_joints
        if token in tokens or leaves.count(token.rsplit("/", 1)[-1]) == 1
    )
    taken = {token.rsplit("/", 1)[-1] for token in carried}
    return MappedReport(
        parts=there,
        shared_out=shared,
        missing=tuple(part for part in lone if part in moving and part not in shared),
        carried=carried,
        left=tuple(token for token in motion.extra_joints if token not in carried),
        at_rest=tuple(
            token
            for token, leaf, part in zip(tokens, leaves, body.parts.parts, strict=True)
            if part not in moving and part not in shared and leaf not in taken
        ),
    )


def _leaf_row(part: str) -> str:
    return next(iter(_row(part)), "")


def _row(part: str) -> set[str]:
    """Return the row that a vertebra or the joint of a digit is in; nothing of others."""
    if part in SPINE:
        return {"spine"}
    if part in NECK:
        return {"neck"}
    digit = part.rsplit("_", 1)[-1]
    return (
        {f"{part[0]}{'toe' if 'tars' in part else 'finger'}{digit}"} if digit.isdigit() else set()
    )

"""What carries the root: ankles, knees, wrists, elbows (2005, section 11)."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.s4d.measures import Measures

_THICKNESS = {"knee": 0.06, "radiocarpal": 0.04, "elbow": 0.045}
"""Height of a joint over the ground that its limb lies on, over leg length."""


def heights_of(
    measures: Measures, carriers: tuple[str, ...], shares: Floats
) -> tuple[Floats, Floats]:
    """Return how high the joints that carry are, and how far the root is from them, in shares.

    Args:
        measures: Of the body, on N frames.
        carriers: H-Anim names; none is the ankles.
        shares: How much each carries, shape (F, C).

    Returns:
        Heights and lengths [m], each of shape (F or N,).
    """
    if not carriers:
        return measures.ankle_height, measures.leg
    each = [_carrier(measures, part) for part in carriers]
    heights, lengths = (np.array(side).T for side in zip(*each, strict=True))
    return (shares * heights).sum(axis=1), (shares * lengths).sum(axis=1)


def _carrier(measures: Measures, part: str) -> tuple[Floats, Floats]:
    side, _, joint = part.partition("_")
    arm, leg = (0, 1) if side == "l" else (2, 3)
    upper_arm, forearm = measures.limbs[:, arm].T
    thigh, shank = measures.limbs[:, leg].T
    if joint == "talocrural":
        return measures.ankle_height, thigh + shank
    height = _THICKNESS[joint] * measures.leg
    if joint == "knee":
        return height, thigh
    return height, measures.trunk + upper_arm + (forearm if joint == "radiocarpal" else 0.0)

"""How high the root is: as it was, as the ground carries it, as legs reach (2005, figure 9)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.s4d.standing.clearance import covering
from usdmotion.s4d.standing.legs import Leg, Pose
from usdmotion.s4d.turns import across

_BEFORE, _GENTLY = 0.04, 0.08
"""How long before and after legs are too short the root is as low already, and still; and how long
before and after that it begins to give way, and ends [s]."""


@dataclass(frozen=True, eq=False)
class Heights:
    """Heights of the middle of the hip joints along the up axis [m], shape (frame_count,) each."""

    original: Floats
    """In the motion as it was."""
    wished: Floats
    """That, and how much higher the feet stand now."""
    carried: Floats
    """h1: that, lower for a moment before and after legs do not reach it."""
    left: Floats
    """h2: the highest at which the left leg reaches its ankle."""
    right: Floats
    """h3: the highest at which the right one does."""
    root: Floats
    """The lowest of the three."""

    def __post_init__(self) -> None:
        count = len(self.original)
        for name in ("original", "wished", "carried", "left", "right", "root"):
            object.__setattr__(self, name, seal(getattr(self, name), count, name=name))


def heights_of(
    pose: Pose,
    legs: Sequence[Leg],
    ankles: Sequence[Floats],
    carried: Floats,
    times: Floats,
    up: Floats,
) -> Heights:
    """Return the heights of the root.

    Args:
        pose: The motion as it was.
        legs: Left and right.
        ankles: Where their ankles are to be [m], shape (frame_count, 3) each.
        carried: By how much the body goes along with its feet [m], shape (frame_count, 3).
        times: Seconds, shape (frame_count,).
        up: The direction away from the ground, shape (3,).
    """
    hips = [pose.positions[:, leg.hip] for leg in legs]
    original = np.mean(hips, axis=0) @ up
    along = across(carried, up)
    highest = []
    for leg, hip, ankle in zip(legs, hips, ankles, strict=True):
        aside = np.linalg.norm(across(ankle - hip - along, up), axis=1)
        room = np.sqrt(np.maximum(leg.reach(pose) ** 2 - aside**2, 0.0))
        highest.append(original + (ankle - hip) @ up + room)
    left, right = highest
    wished = original + carried @ up
    # What legs will soon not let it do, or have just not let it do, it does not quite do either.
    short = np.maximum(wished - np.minimum(left, right), 0.0)
    h1 = wished - covering(short, times, _BEFORE, _GENTLY)
    root = np.minimum(h1, np.minimum(left, right))
    return Heights(original, wished, h1, left, right, root)

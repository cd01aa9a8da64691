"""2004, section 4: a walker leans into a wind, his centre of mass ahead of where it would be."""

from pathlib import Path

import numpy as np

from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.curves import ease
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, feet, seconds, write_walk

LEAN = np.array((0.0, -0.015, 0.1))
"""How far the centre of mass is displaced in full wind [m]: ahead, and a little down."""
FRAMES = (25.0, 61.0, 97.0, 133.0)
"""The wind rises, blows, falls, is gone."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    planted = feet(walking, priority=1)
    wind = ease(walking.motion.times, tuple(map(seconds, FRAMES)))
    lean = CenterOfMassConstraint(
        path="Lean",
        skeleton=SKELETON,
        priority=2,
        supports=tuple(each.joint for each in planted),
        support_points=np.array([each.point for each in planted]),
        displacement=wind[:, None] * LEAN,
    )
    write_walk(output, walking, "AgainstTheWind", [*planted, lean])


PICTURE = Figure(
    "2004, section 4: the centre of mass is ahead of where it would be",
    frames=(25.0, 43.0, 61.0, 79.0, 97.0, 115.0),
    views=("side",),
)

"""2004, figure 4: footplants on the whole clip, and an ankle that has to rise in spite of them."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, feet, seconds, token, write_walk

HIGHER = np.array((0.0, 0.15, 0.0))
"""How far the left ankle is to be above where it would have been [m]."""
FRAMES = (66.0, 78.0, 81.0, 96.0)
"""It leaves its trajectory, is up there, leaves, is back: a step that stays in the air."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    write_walk(output, walking, "Stepping", asked(walking))


def asked(walking: Walk) -> Sequence[Constraint]:
    """Return the footplants (2) and the ankle (1)."""
    ankle = PositionConstraint(
        path="LeftAnkle",
        skeleton=SKELETON,
        joint=token(walking, "LeftFoot"),
        priority=1,
        goals=(
            Goal(
                path="Higher",
                mode="offset",
                translation=HIGHER,
                times=tuple(map(seconds, FRAMES)),
            ),
        ),
    )
    return [*feet(walking, priority=2), ankle]


def build_weighted(output: Path) -> None:
    """Write the stage in which all of them have one priority, and equal weights."""
    walking = walk()
    alike = [replace(each, priority=1) for each in asked(walking)]
    write_walk(output, walking, "SteppingWeighted", alike)


PICTURE = Figure(
    "2004, figure 4: an ankle rises against footplants, by priority and by weight",
    frames=(63.0, 70.0, 78.0, 88.0, 97.0),
    views=("side",),
    answers=(Answer("priorities"), Answer("weights", build=build_weighted)),
)

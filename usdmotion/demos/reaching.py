"""2004, figure 3: a walker reaches for a point, keeps his feet where they were, and his balance."""

from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure, Plot
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.plots.swaying import sway
from usdmotion.demos.walker import SKELETON, balance, feet, seconds, token, write_walk

TARGET = np.array((0.65, 0.90, 4.25))
"""Where the left wrist is to be [m]: beside the path, lower than the shoulder, an arm away."""
FRAMES = (56.0, 72.0, 80.0, 96.0)
"""It leaves its trajectory, is there, leaves, is back: 40 frames, as in the paper."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    *planted, over_them = held(walking)
    write_walk(output, walking, "Reaching", [*planted, wrist(walking, TARGET), over_them])


def held(walking: Walk) -> list[Constraint]:
    """Return the feet on their trajectories (1) and the balance over them (3)."""
    planted = feet(walking, priority=1)
    return [*planted, balance(planted, priority=3)]


def wrist(walking: Walk, target: Floats) -> PositionConstraint:
    """Return the left wrist at a point for a while (2)."""
    return PositionConstraint(
        path="LeftWrist",
        skeleton=SKELETON,
        joint=token(walking, "LeftHand"),
        priority=2,
        goals=(Goal(path="Reach", translation=target, times=tuple(map(seconds, FRAMES))),),
    )


PICTURE = Figure(
    "2004, figure 3: a wrist is taken to a point, in balance and without",
    frames=(56.0, 66.0, 76.0, 86.0, 96.0),
    answers=(Answer(), Answer("without balance", without=("Balance",))),
)
MORE_PICTURES = {
    "reaching_balance": Plot(
        "2004, figure 1: the centre of mass of the walk, and the middle of its supports", sway
    )
}

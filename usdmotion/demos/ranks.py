"""2004, section 6: priorities are ranks. The two variants of the edit ask for the same.

Feet, a wrist and an elbow cannot all have what they want, so that it shows who comes first.
"""

from pathlib import Path

import numpy as np

from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, feet, token, write_walk


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk(seconds=2.0)
    variants = {
        "far_apart": conflict(walking, (2, 10, 15)),
        "one_two_three": conflict(walking, (1, 2, 3)),
    }
    write_walk(output, walking, "Ranks", [], variants)


def conflict(walking: Walk, ranks: tuple[int, int, int]) -> list[Constraint]:
    """Return feet, a wrist and an elbow of these ranks that cannot all be met."""
    high, middle, low = ranks

    def wants(name: str, joint: str, priority: int, outward: float) -> PositionConstraint:
        goal = Goal(mode="offset", translation=np.array([outward, 0.1, 0.4]))
        return PositionConstraint(
            path=name,
            skeleton=SKELETON,
            joint=token(walking, joint),
            priority=priority,
            goals=(goal,),
        )

    return [
        wants("Wrist", "LeftHand", middle, 0.5),
        *feet(walking, priority=high),
        wants("Elbow", "LeftForeArm", low, -0.3),
    ]


PICTURE = Figure(
    "2004, section 6: priorities 2, 10, 15 and 1, 2, 3 are the same",
    frames=(1.0, 13.0, 25.0, 37.0, 49.0),
    answers=(
        Answer("2, 10, 15", variant="far_apart"),
        Answer("1, 2, 3", variant="one_two_three"),
    ),
)

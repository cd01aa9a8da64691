"""2005, figure 12: a far thing is taken, with the balance kept and without; another is too far."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.performances import reach
from usdmotion.demos.walker import SKELETON, balance, feet, seconds, token, write_walk

FAR = np.array((-0.15, 0.85, 0.70))
"""Where the right wrist is to be [m]: out of the arm's reach, and low."""
TOO_FAR = np.array((-0.25, 1.1, 1.1))
"""A place at which it cannot be [m]."""
FRAMES = (7.0, 35.0, 45.0, 79.0)
"""It leaves its trajectory, is there, leaves, is back."""


def build(output: Path) -> None:
    """Write the stage."""
    reaching = reach()
    standing = feet(reaching, priority=1)
    over_them = balance(standing, priority=2)
    asked: dict[str, Sequence[Constraint]] = {
        "balanced": [*standing, over_them, wrist(reaching, FAR)],
        "unbalanced": [*standing, wrist(reaching, FAR)],
        "unreachable": [*standing, over_them, wrist(reaching, TOO_FAR)],
    }
    write_walk(output, reaching, "Grasp", [], asked, solver="ccd")


def wrist(reaching: Walk, place: Floats) -> PositionConstraint:
    """Return the right wrist at a place for a while (3), by all of the arm and the trunk."""
    return PositionConstraint(
        path="RightWrist",
        skeleton=SKELETON,
        joint=token(reaching, "RightHand"),
        priority=3,
        goals=(Goal(path="Thing", translation=place, times=tuple(map(seconds, FRAMES))),),
    )


PICTURE = Figure(
    "2005, figure 12: a far thing is taken, in balance and without; another is too far",
    frames=(14.0, 25.0, 40.0, 54.0, 66.0),
    views=("side",),
    answers=tuple(Answer(name, variant=name) for name in ("balanced", "unbalanced", "unreachable")),
)

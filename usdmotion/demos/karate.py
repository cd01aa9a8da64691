"""2004, figures 5 and 6: a kick higher than it was, on a foot that stands and in balance."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.kick import kick
from usdmotion.demos.walker import SKELETON, balance, feet, seconds, token, write_walk

AHEAD = (-0.03, 0.85)
"""Where the kicking ankle is to be: to the left, and ahead [m]."""
UNREACHABLE = 1.9
"""A height at which it cannot be [m]."""
HEIGHTS = (0.8, 0.9, 1.05, 1.2)
"""Heights at which it can be [m]."""
FRAMES = (21.0, 34.0, 35.0, 54.0)
"""It leaves its trajectory, is there, leaves, is back."""


def build(output: Path, *, height: float = UNREACHABLE) -> None:
    """Write the stage.

    Args:
        output: The layer to write.
        height: Where the kicking ankle is to be [m].
    """
    kicking = kick()
    write_walk(output, kicking, "Karate", asked(kicking, height))


def build_weighted(output: Path) -> None:
    """Write the stage in which all have one priority, and equal weights."""
    kicking = kick()
    alike = [replace(each, priority=1) for each in asked(kicking, UNREACHABLE)]
    write_walk(output, kicking, "KarateWeighted", alike)


def asked(kicking: Walk, height: float) -> Sequence[Constraint]:
    """Return the planted foot (1), the balance (2) and the kicking ankle (3)."""
    standing = planted(kicking)
    x, z = AHEAD
    high = Goal(
        path="High", translation=np.array((x, height, z)), times=tuple(map(seconds, FRAMES))
    )
    ankle = PositionConstraint(
        path="RightAnkle",
        skeleton=SKELETON,
        joint=token(kicking, "RightFoot"),
        priority=3,
        # All of the body, as for the balance, so that the trunk can make up for the leg.
        recruits=kicking.skeleton.joints,
        goals=(high,),
    )
    return [*standing, balance(standing, priority=2), ankle]


def planted(kicking: Walk) -> list[PositionConstraint]:
    """Return the constraints that hold the foot that stands, above all."""
    left = [each for each in feet(kicking, priority=1) if each.path.startswith("Left")]
    # Heel and ball leave the foot free to roll about their line; the ankle does not.
    return [*left, replace(left[0], path="LeftAnkle", point=np.zeros(3))]


PICTURE = Figure(
    "2004, figure 5: a kick that cannot get there, on a foot that stands and in balance",
    frames=(17.0, 24.0, 29.0, 34.0, 44.0, 54.0),
    answers=(
        Answer("priorities"),
        Answer("no balance", without=("Balance",)),
        Answer("weights", build=build_weighted),
    ),
)
MORE_PICTURES = {
    "karate_heights": Figure(
        "2004, figure 6: kicks to other heights",
        frames=(27.0, 34.0, 44.0),
        answers=tuple(
            Answer(f"{height:g} m", build=partial(build, height=height)) for height in HEIGHTS
        ),
    )
}

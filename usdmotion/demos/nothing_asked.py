"""What a walk already does is asked of it: the walk comes back as it was."""

from pathlib import Path

from usdmotion.constraints import (
    CenterOfMassConstraint,
    DistanceConstraint,
    OrientationConstraint,
    PositionConstraint,
)
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, feet, token, write_walk


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk(seconds=2.0)
    wrist = PositionConstraint(
        path="Wrist", skeleton=SKELETON, joint=token(walking, "LeftHand"), priority=2
    )
    head = OrientationConstraint(
        path="Head", skeleton=SKELETON, joint=token(walking, "Head"), priority=3
    )
    hands = DistanceConstraint(
        path="Hands",
        skeleton=SKELETON,
        joint=token(walking, "LeftHand"),
        other_joint=token(walking, "RightHand"),
        distance=0.1,
        bound="atLeast",
        priority=4,
    )
    balance = CenterOfMassConstraint(path="Balance", skeleton=SKELETON, priority=5)
    write_walk(
        output, walking, "NothingAsked", [*feet(walking, priority=1), wrist, head, hands, balance]
    )


PICTURE = Figure(
    "What a walk already does is asked of it, and nothing changes",
    frames=(1.0, 13.0, 25.0, 37.0, 49.0),
)

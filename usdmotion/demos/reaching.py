"""2004, figure 3: a walker reaches for a point and keeps his feet where they were."""

from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, feet, seconds, token, write_walk

TARGET = np.array((0.70, 0.80, 4.25))
"""Where the left wrist is to be [m]: beside the path, lower than the shoulder, an arm away."""
FRAMES = (56.0, 72.0, 80.0, 96.0)
"""It leaves its trajectory, is there, leaves, is back: 40 frames, as in the paper."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    wrist = PositionConstraint(
        path="LeftWrist",
        skeleton=SKELETON,
        joint=token(walking, "LeftHand"),
        priority=2,
        goals=(Goal(path="Reach", translation=TARGET, times=tuple(map(seconds, FRAMES))),),
    )
    write_walk(output, walking, "Reaching", [*feet(walking, priority=1), wrist])

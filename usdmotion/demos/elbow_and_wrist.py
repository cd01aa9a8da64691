"""2003, figure 1: an elbow has its place, and the wrist then does what it still can."""

from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk

ELBOW = np.array((0.15, 0.12, 0.15))
"""How far the left elbow is to be from where it would have been [m]: aside, up, ahead."""
WRIST = np.array((0.30, 0.55, 0.50))
"""The same for the wrist [m]; it is farther from the elbow than the forearm is long."""
FRAMES = (25.0, 61.0, 85.0, 121.0)
"""They leave their trajectories, are there, leave, are back."""
RECRUITED = ("LeftShoulder", "LeftArm", "LeftForeArm")


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    times = tuple(map(seconds, FRAMES))
    constraints = [
        PositionConstraint(
            path=f"Left{name}",
            skeleton=SKELETON,
            joint=token(walking, f"Left{joint}"),
            priority=priority,
            recruits=tuple(token(walking, part) for part in RECRUITED),
            goals=(Goal(path="Raised", mode="offset", translation=place, times=times),),
        )
        for name, joint, place, priority in (
            ("Elbow", "ForeArm", ELBOW, 1),
            ("Wrist", "Hand", WRIST, 2),
        )
    ]
    write_walk(output, walking, "ElbowAndWrist", constraints)


PICTURE = Figure(
    "2003, figure 1: an elbow has its place, and the wrist does what it still can",
    frames=(25.0, 43.0, 61.0, 73.0, 85.0, 103.0),
)

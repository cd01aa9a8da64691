"""2003, figure 7: wrists and elbows at places in the thorax's frame, while the body walks."""

from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk

SHOULDER = np.array((0.1785, 0.0816, 0.0))
"""Where the left shoulder joint is in the frame of the upper thorax [m]."""
ELBOW = SHOULDER + 0.3162 * np.array((0.86, 0.28, 0.4266))
"""Where the left elbow is to be there [m], an upper arm away; the right one mirrored."""
WRIST = ELBOW + 0.2482 * np.array((-0.2, 0.7, 0.6856))
"""The same for the wrists [m], a forearm further."""
FRAMES = (13.0, 55.0, 91.0, 133.0)
"""They leave their trajectories, are there, leave, are back."""
ARM = ("Arm", "ForeArm")


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    thorax = (SKELETON, token(walking, "Spine2"))
    times = tuple(map(seconds, FRAMES))
    raised = [
        PositionConstraint(
            path=f"{side}{name}",
            skeleton=SKELETON,
            joint=token(walking, f"{side}{joint}"),
            priority=priority,
            recruits=tuple(token(walking, f"{side}{part}") for part in ARM),
            goals=(Goal(path="Raised", translation=place * mirror, joint=thorax, times=times),),
        )
        for side, mirror in (("Left", (1.0, 1.0, 1.0)), ("Right", (-1.0, 1.0, 1.0)))
        for name, joint, place, priority in (
            ("Elbow", "ForeArm", ELBOW, 1),
            ("Wrist", "Hand", WRIST, 2),
        )
    ]
    write_walk(output, walking, "RaisedArms", raised)


PICTURE = Figure(
    "2003, figure 7: wrists and elbows at places in the frame of the thorax",
    frames=(13.0, 31.0, 49.0, 67.0, 85.0, 109.0),
    views=("front",),
)

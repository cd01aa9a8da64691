"""2005, figure 13: a wrist has its place (1), and the elbow turns about it to its own (2)."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.performances import reach
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk

WRIST = np.array((-0.30, 1.25, 0.36))
"""Where the right wrist is to be [m]."""
ELBOWS = {
    "reachable": np.array((-0.43908, 1.22897, 0.15551)),
    "unreachable": np.array((-0.62, 1.45, 0.10)),
}
"""Where the elbow is to be in each variant of the edit [m]; the wrist allows it a circle."""
FRAMES = (28.0, 40.0, 51.0, 63.0)
"""They leave their trajectories, are there, leave, are back."""


def build(output: Path) -> None:
    """Write the stage."""
    reaching = reach()
    asked = {name: both(reaching, elbow) for name, elbow in ELBOWS.items()}
    write_walk(output, reaching, "WristAndElbow", [], asked, solver="ccd")


def both(reaching: Walk, elbow: Floats) -> Sequence[Constraint]:
    """Return wrist (1) and elbow (2), of an arm on a shoulder that stays where it is."""
    upper, fore, hand = (token(reaching, f"Right{name}") for name in ("Arm", "ForeArm", "Hand"))
    times = tuple(map(seconds, FRAMES))
    return [
        PositionConstraint(
            path=name,
            skeleton=SKELETON,
            joint=joint,
            priority=priority,
            recruits=recruits,
            goals=(Goal(path="Place", translation=place, times=times),),
        )
        for name, joint, priority, recruits, place in (
            ("RightWrist", hand, 1, (upper, fore), WRIST),
            ("RightElbow", fore, 2, (upper, fore), elbow),
        )
    ]


PICTURE = Figure(
    "2005, figure 13: both are met, or the wrist and as much of the elbow as there can be",
    frames=(23.0, 34.0, 45.0, 57.0),
    answers=tuple(Answer(name, variant=name) for name in ELBOWS),
)

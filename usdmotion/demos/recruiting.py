"""2003, section 3.1: a wrist moves the pelvis under feet that may move their legs alone.

The stage breaks the recruiting rule on purpose: `inspect` and `solve` name who, and
`--mend-recruiting` lets the feet recruit what the rule asks for.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import SKELETON, feet, token, write_walk

AWAY = np.array((1.5, 0.0, 0.0))
"""How far the wrist is to be from where it would have been: more than the arm allows [m]."""
LEG = ("UpLeg", "Leg", "Foot")


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk(seconds=2.0)
    planted = [
        replace(each, recruits=tuple(token(walking, f"{each.path[:-4]}{part}") for part in LEG))
        for each in feet(walking, priority=1)
        if each.path.endswith("Heel")
    ]
    wrist = PositionConstraint(
        path="Wrist",
        skeleton=SKELETON,
        joint=token(walking, "LeftHand"),
        priority=2,
        goals=(Goal(mode="offset", translation=AWAY),),
    )
    write_walk(output, walking, "Recruiting", [*planted, wrist])


PICTURE = Figure(
    "2003, figure 2: a wrist that moves the pelvis, over feet that may not, and mended",
    frames=(1.0, 13.0, 25.0, 37.0, 49.0),
    answers=(
        Answer("broken"),
        Answer("mended", steps=("usdmotion solve {stage} --mend-recruiting",)),
    ),
)

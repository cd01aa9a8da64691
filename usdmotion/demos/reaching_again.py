"""2004, section 6: the wrist's goal is moved after a first solve, and only what it reaches changes.

The edit has a variant for each place of the goal. What an editor does with them, without a stage
in between, is a `Session`.
"""

from pathlib import Path

import numpy as np

from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.reaching import TARGET, held, wrist
from usdmotion.demos.walker import write_walk

MOVED = TARGET + np.array((-0.1, 0.15, 0.2))
"""Where the goal is the second time [m]."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    variants = {
        "first": [wrist(walking, TARGET)],
        "moved": [wrist(walking, MOVED)],
    }
    write_walk(output, walking, "ReachingAgain", held(walking), variants)


PICTURE = Figure(
    "2004, section 6: the goal is moved after a first solve",
    frames=(56.0, 66.0, 76.0, 86.0, 96.0),
    answers=(Answer("first", variant="first"), Answer("moved", variant="moved")),
)

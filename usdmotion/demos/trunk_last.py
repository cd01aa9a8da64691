"""2005, section 9: what the arm can reach it reaches alone; the trunk does what the arm cannot."""

from pathlib import Path

import numpy as np

from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.grasp import wrist
from usdmotion.demos.performances import reach
from usdmotion.demos.walker import write_walk

PLACES = {
    "within": np.array((-0.10, 1.30, 0.45)),
    "beyond": np.array((-0.15, 1.20, 0.66)),
}
"""Where the right wrist is to be in each variant of the edit [m]."""


def build(output: Path) -> None:
    """Write the stage."""
    reaching = reach()
    asked = {name: [wrist(reaching, place)] for name, place in PLACES.items()}
    write_walk(output, reaching, "TrunkLast", [], asked, solver="ccd")


PICTURE = Figure(
    "2005, section 9: what the arm reaches it reaches alone; the trunk does the rest",
    frames=(14.0, 25.0, 40.0, 54.0, 66.0),
    views=("side",),
    answers=tuple(Answer(name, variant=name) for name in PLACES),
)

"""2005, section 5: one motion of two hands holds nothing, or boxes of three sizes."""

from pathlib import Path

from usdmotion.arrays import Floats
from usdmotion.constraints import DistanceConstraint
from usdmotion.demos.body import solids
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.performances import carry
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk

WIDTHS = {"clapped": 0.0, "small": 0.12, "middle": 0.30, "large": 0.50}
"""How far apart the hands are to be in each variant of the edit [m]."""
FRAMES = (13.0, 25.0, 68.0, 80.0)
"""They come to the box, hold it, and let go of it."""
_PALM = 0.45
"""Where the middle of the palm is between the wrist and the tips of the fingers."""


def build(output: Path) -> None:
    """Write the stage."""
    carrying = carry()
    held = {name: [apart(carrying, width)] for name, width in WIDTHS.items()}
    write_walk(output, carrying, "TwoHands", [], held, solver="ccd")


def palm(carrying: Walk, side: str) -> Floats:
    """Return the middle of a palm in the frame of the hand [m], shape (3,)."""
    return _PALM * solids()[carrying.joint(f"{side}Hand")].end


def apart(carrying: Walk, width: float) -> DistanceConstraint:
    """Return the palms so far apart [m]; the arms see to it."""
    left, right = (
        tuple(token(carrying, f"{side}{name}") for name in ("Arm", "ForeArm", "Hand"))
        for side in ("Left", "Right")
    )
    return DistanceConstraint(
        path="Box",
        skeleton=SKELETON,
        joint=left[-1],
        point=palm(carrying, "Left"),
        recruits=(*left, *right),
        times=tuple(map(seconds, FRAMES)),
        other_joint=right[-1],
        other_point=palm(carrying, "Right"),
        distance=width,
    )


PICTURE = Figure(
    "2005, section 5: one motion of two hands holds nothing, or boxes of three sizes",
    frames=(25.0, 46.0, 63.0),
    views=("front",),
    answers=tuple(Answer(name.replace("_", " "), variant=name) for name in WIDTHS),
)

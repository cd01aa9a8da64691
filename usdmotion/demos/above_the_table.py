"""2005, figure 6: somebody talks, hands on his thighs, and then with his hands above a table."""

from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Region, RegionConstraint
from usdmotion.demos.body import solids
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.performances import talk
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk
from usdmotion.kernels import Shape, from_vector

TOP = 0.72
"""Height of the table's top [m]."""
WRIST, FINGERS = 0.03, 0.015
"""How high the middle of a wrist, and the tips of the fingers, have to be above it [m]."""
FRAMES = (13.0, 25.0, 80.0, 92.0)
"""The hands come up, have to stay above, and may go."""
_UP = from_vector(np.array((-0.5 * np.pi, 0.0, 0.0)))
_TABLE = Region(
    path="/Walker/Table",
    shape=Shape.BOX,
    extent=np.array((0.6, 0.02, 0.3)),
    translation=np.array((0.0, TOP - 0.02, 0.44)),
)


def build(output: Path) -> None:
    """Write the stage."""
    talking = talk()
    hands = [each for side in ("Left", "Right") for each in _above(talking, side)]
    write_walk(output, talking, "AboveTheTable", hands, props=[_TABLE], solver="ccd")


def fingers(talking: Walk, side: str) -> Floats:
    """Return the tips of the fingers in the frame of a hand [m], shape (3,)."""
    return solids()[talking.joint(f"{side}Hand")].end


def _above(talking: Walk, side: str) -> list[RegionConstraint]:
    """Return the wrist above the table (1), and the fingers too (2), by the hand alone."""
    arm = tuple(token(talking, f"{side}{name}") for name in ("Arm", "ForeArm", "Hand"))

    def above(name: str, height: float, point: Floats, priority: int) -> RegionConstraint:
        # A plane's outside is where its axis points, and that is its z.
        below = Region(
            path=f"/Walker/Above{name}",
            shape=Shape.HALF_SPACE,
            translation=np.array((0.0, TOP + height, 0.0)),
            rotation=_UP,
        )
        return RegionConstraint(
            path=f"{side}{name}",
            skeleton=SKELETON,
            joint=arm[-1],
            point=point,
            priority=priority,
            recruits=arm if priority == 1 else arm[-1:],
            times=tuple(map(seconds, FRAMES)),
            region=below,
        )

    return [
        above("Wrist", WRIST, np.zeros(3), 1),
        above("Fingers", FINGERS, fingers(talking, side), 2),
    ]


PICTURE = Figure(
    "2005, figure 6: who talks with hands on thighs does so with hands above a table",
    frames=(1.0, 25.0, 41.0, 52.0, 69.0),
)

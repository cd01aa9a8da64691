"""2003, figures 4 and 5: a fixed goal, an offset goal, and goals that overlap."""

from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.figures import Figure, Plot
from usdmotion.demos.gait import walk
from usdmotion.demos.plots.goals import goals
from usdmotion.demos.walker import SKELETON, feet, seconds, token, write_walk

POINT = np.array((-0.45, 1.15, 2.35))
"""Where the right wrist is to be for a while [m]."""
RAISE = np.array((0.0, 0.25, 0.1))
"""How far the left wrist is to be from where it would have been [m]."""
OUTWARD = np.array((0.2, 0.1, 0.0))
"""The same for the goal that overlaps it [m]."""


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()

    def times(*frames: float) -> tuple[float, ...]:
        return tuple(map(seconds, frames))

    point = Goal(path="Point", translation=POINT, times=times(25, 41, 49, 65))
    raised = Goal(path="Raise", mode="offset", translation=RAISE, times=times(25, 41, 73, 97))
    outward = Goal(
        path="Outward", mode="offset", translation=OUTWARD, times=times(65, 85, 109, 129)
    )
    wrists = [
        PositionConstraint(
            path=f"{side}Wrist",
            skeleton=SKELETON,
            joint=token(walking, f"{side}Hand"),
            priority=2,
            goals=goals,
        )
        for side, goals in (("Right", (point,)), ("Left", (raised, outward)))
    ]
    write_walk(output, walking, "Goals", [*feet(walking, priority=1), *wrists])


PICTURE = Figure(
    "2003, figures 4 and 5: a place (right), offsets that overlap (left)",
    frames=(25.0, 33.0, 45.0, 57.0, 75.0, 97.0, 129.0),
)
MORE_PICTURES = {
    "goals_activity": Plot(
        "2003, figures 4 and 5: the activity of goals, and where wrists are taken",
        goals,
        solved=True,
    )
}

"""2006, figures 8 to 10: residuals at and far from the origin, and gaps that are bridged."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.demos.plots.reading import Steps, search_of
from usdmotion.drawing.style import AFTER, BEFORE, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

JOINT = "LeftToeBase"
FAR = np.array((0.0, 0.0, -17.0))
"""Where the paper puts the same walk [m]."""
FRAMES, DISTANCE = 10.0, 0.1
"""F_max and d_max of figure 10 [frames, m]."""


def far(stage: Path) -> "Figure":
    """Return the residuals of a walk from the origin and of one towards it, both ways."""
    search = search_of(stage, JOINT)
    codes = 1.0 + 24.0 * search.times[:-1]
    drawn = figure(2.6, 7.4)
    world, local = drawn.subplots(1, 2, sharex=True)
    for offset, color, label in (
        (np.zeros(3), AFTER, "from 0 m on"),
        (FAR, BEFORE, "from −17 m on"),
    ):
        steps = Steps.of(search, offset)
        world.plot(codes, steps.world, color=color, label=label)
        local.plot(codes, steps.local, color=color, label=label, ls="-" if color == AFTER else ":")
    world.set(title="in the world's frame", xlabel="time code", ylabel="residual [m]")
    local.set(title="in the object's own", xlabel="time code")
    for axes in (world, local):
        axes.margins(y=0.2)
        axes.legend(loc="upper right", ncols=2)
    return drawn


def tolerance(_: Path) -> "Figure":
    """Return how many frames are bridged between contacts that are so far apart (figure 10)."""
    apart = np.linspace(0.0, 1.2 * DISTANCE, 1201)
    bridged = np.floor(FRAMES * np.exp(-apart * np.log(FRAMES) / DISTANCE) + 1e-9)
    drawn = figure(2.2, 4.4)
    axes = drawn.subplots()
    axes.step(100.0 * apart, np.where(apart <= DISTANCE, bridged, 0.0), color=AFTER)
    axes.set(xlabel="distance of two contacts [cm]", ylabel="frames")
    return drawn

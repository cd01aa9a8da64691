"""2004, figure 1: the centre of mass of a walk beside the middle of its supports."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.demos.plots.reading import shown_on
from usdmotion.drawing.style import AFTER, SUPPORT, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def sway(stage: Path) -> "Figure":
    """Return the trajectories from above, and how far they are from each other."""
    (shown,) = shown_on(stage)
    (mark,) = (edit.balance for edit in shown.edits if edit.balance is not None)
    seconds = shown.scene.characters[0].motion.times
    middle = mark.supports.mean(axis=1)
    apart = mark.before - middle
    drawn = figure(3.0, 7.4)
    above, between = drawn.subplots(1, 2, width_ratios=(1.5, 1.0))
    above.plot(middle[:, 2], middle[:, 0], color=SUPPORT, label="middle of heels and balls")
    above.plot(mark.before[:, 2], mark.before[:, 0], color=AFTER, label="centre of mass")
    above.set(title="from above", xlabel="ahead [m]", ylabel="to the left [m]")
    above.set_ylim(*(np.array((-1.0, 1.0)) * max(0.15, 1.3 * np.abs(middle[:, 0]).max())))
    above.legend(loc="upper right", ncols=2)
    between.plot(seconds, 1e3 * apart[:, 2], color=AFTER, label="ahead")
    between.plot(seconds, 1e3 * apart[:, 0], color=SUPPORT, label="to the left")
    between.set(title="from the one to the other", xlabel="seconds", ylabel="mm")
    between.margins(y=0.15)
    between.legend(loc="upper right", ncols=2)
    return drawn

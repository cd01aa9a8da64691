"""2003, figures 4 and 5: the activity of goals, and where they take an effector."""

from pathlib import Path
from typing import TYPE_CHECKING

from usdmotion.demos.plots.reading import shown_on
from usdmotion.drawing.style import AFTER, BEFORE, GOAL, SUPPORT, figure
from usdmotion.showing import Course, ShownScene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def goals(stage: Path) -> "Figure":
    """Return, for each wrist, the activity of its goals above how high it is."""
    (shown,) = shown_on(stage)
    (edit,) = shown.edits
    wrists = [each for each in edit.courses if each.name.endswith("Wrist")]
    drawn = figure(3.6, 7.4)
    axes = drawn.subplots(2, len(wrists), sharex=True, height_ratios=(1.0, 1.6), squeeze=False)
    for (above, below), wrist in zip(axes.T, wrists, strict=True):
        _activity(above, shown, wrist)
        _height(below, shown, wrist)
    axes[0][0].set_ylabel("activity")
    axes[1][0].set_ylabel("height [m]")
    return drawn


def _activity(axes: "Axes", shown: ShownScene, wrist: Course) -> None:
    codes, colors = shown.scene.time_codes, iter((GOAL, SUPPORT))
    own = [each for each in shown.edits[0].goals if each.path.startswith(f"{wrist.path}/")]
    for goal in own:
        label = goal.path.rsplit("/", 1)[-1]
        axes.fill_between(codes, goal.activity, color=(color := next(colors)), alpha=0.3)
        axes.plot(codes, goal.activity, color=color, label=label)
    axes.set(title=wrist.name, ylim=(0.0, 1.4))
    axes.legend(loc="upper right", ncols=2)


def _height(axes: "Axes", shown: ShownScene, wrist: Course) -> None:
    codes = shown.scene.time_codes
    up = int(shown.scene.up.argmax())
    axes.plot(codes, wrist.before[:, up], color=BEFORE, label="before")
    if wrist.after is not None:
        axes.plot(codes, wrist.after[:, up], color=AFTER, label="after")
    axes.set_xlabel("time code")
    axes.legend(loc="upper right")

"""Where the motion was changed: how far each joint is turned from the input, over time."""

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Ints
from usdmotion.drawing.style import (
    AFTER,
    PALE,
    Picture,
    figure,
    thinned,
    time_axis,
)
from usdmotion.report.findings import EditFindings, Findings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap

_SEEN = 0.1
"""A joint that is never turned by more than this is not shown [degrees]."""
_MOST = 28
"""Joints that are shown: those that are turned most."""
_COLUMNS = 400
"""More columns than this cannot be seen."""


def changes(findings: Findings, edit: EditFindings) -> Picture | None:
    """Return the picture of what an edit has changed, None where it has changed nothing."""
    largest = edit.turned.max(axis=0)
    shown = np.argsort(-largest, kind="stable")[:_MOST]
    shown = np.sort(shown[largest[shown] > _SEEN])
    moved = 1e3 * edit.moved[:, edit.character.root]
    if len(shown) == 0 and moved.max() < 1e-2:
        return None
    tall = 0.19 * max(len(shown), 2) + 0.35 if len(shown) else 0.0
    drawn = figure(tall + 1.55)
    if len(shown):
        turned, root = drawn.subplots(2, 1, sharex=True, height_ratios=(tall, 0.95))
        _turned(turned, findings, edit, shown)
    else:
        root = drawn.subplots()
    codes = findings.scene.time_codes
    root.plot(*thinned(codes, moved), color=AFTER)
    root.set_ylim(0.0, 1.1 * max(float(moved.max()), 1.0))
    root.set_ylabel("mm")
    root.set_title("Root moved from the input")
    time_axis(root, codes)
    return Picture(
        "changes",
        "What was changed to get there: how far each joint is turned from the input in its "
        "parent's frame, dark is far; and how far the root is from where it was. Joints that are "
        f"not shown are never turned by more than {_SEEN:g}°.",
        drawn,
    )


def _turned(axes: "Axes", findings: Findings, edit: EditFindings, shown: Ints) -> None:
    codes = findings.scene.time_codes
    image = axes.imshow(
        _columns(edit.turned[:, shown]).T,
        aspect="auto",
        interpolation="nearest",
        cmap=_from_white(),
        vmin=0.0,
        extent=(float(codes[0]), float(codes[-1]) + (len(codes) == 1), len(shown) - 0.5, -0.5),
    )
    names = [edit.character.skeleton.joints[joint].rsplit("/", 1)[-1] for joint in shown]
    axes.set_yticks(range(len(shown)), names)
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False)
    axes.set_title("Turned from the input")
    bar = axes.figure.colorbar(image, ax=axes, pad=0.01, fraction=0.03)
    bar.set_label("degrees")
    bar.outline.set_visible(False)
    time_axis(axes, codes, label=False)


def _from_white() -> "Colormap":
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("turned", ("#f7f9fb", PALE, AFTER, "#06243d"))


def _columns(values: np.ndarray) -> np.ndarray:
    """Return the largest value of each stretch of time, where there are more than can be seen."""
    if len(values) <= _COLUMNS:
        return values
    edges = np.linspace(0, len(values), _COLUMNS + 1).astype(np.int64)[:-1]
    return np.asarray(np.maximum.reduceat(values, edges, axis=0))

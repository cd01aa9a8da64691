"""How smooth the motion is: jerk of the root over time, and of all joints, in against out."""

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.drawing.style import (
    AFTER,
    BEFORE,
    LINE,
    Picture,
    figure,
    thinned,
    time_axis,
)
from usdmotion.report.findings import EditFindings, Findings, Smoothness

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST = 12
"""Joints that are listed: those of which the jerk has changed most."""


def smoothness(findings: Findings, edit: EditFindings) -> Picture | None:
    """Return the picture of the jerk of an edit's character, None of a motion too short."""
    found = edit.smoothness
    if found is None:
        return None
    drawn = figure(3.6)
    root, joints = drawn.subplots(1, 2, width_ratios=(1.25, 1.0))
    _root(root, findings, found)
    _joints(joints, found)
    return Picture(
        "jerk",
        "How hard the motion is jerked (third derivative of positions in the world), grey in the "
        "input and blue in the result: the root over time, and the joints whose mean has changed "
        "most.",
        drawn,
    )


def _root(axes: "Axes", findings: Findings, found: Smoothness) -> None:
    before, after = found.before[:, found.root], found.after[:, found.root]
    axes.plot(*thinned(found.time_codes, before), color=BEFORE, linewidth=2.4, label="input")
    axes.plot(*thinned(found.time_codes, after), color=AFTER, label="result")
    axes.set_ylim(0.0, 1.1 * max(float(before.max()), float(after.max()), 1e-3))
    axes.set_ylabel("m/s³")
    axes.set_title(f"Root: {found.joints[found.root].rsplit('/', 1)[-1]}")
    axes.legend(loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.12))
    time_axis(axes, findings.scene.time_codes)


def _joints(axes: "Axes", found: Smoothness) -> None:
    before, after = found.rms
    order = np.argsort(-np.abs(after - before), kind="stable")[:_MOST]
    order = order[np.argsort(-after[order], kind="stable")]
    rows = np.arange(len(order))
    axes.hlines(rows, before[order], after[order], color=LINE, linewidth=3.0, zorder=1)
    axes.plot(before[order], rows, "o", color=BEFORE, markersize=7.0, zorder=2)
    axes.plot(after[order], rows, "o", color=AFTER, markersize=5.0, zorder=3)
    axes.set_yticks(rows, [found.joints[joint].rsplit("/", 1)[-1] for joint in order])
    axes.set_ylim(len(order) - 0.4, -0.6)
    axes.set_xlim(left=0.0)
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("mean over time (rms) [m/s³]")
    axes.set_title("Joints")

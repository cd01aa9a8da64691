"""The centre of mass over its supports: from above, and over time."""

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import facing
from usdmotion.drawing.style import (
    AFTER,
    BEFORE,
    INK,
    SUPPORT,
    Picture,
    figure,
    thinned,
    time_axis,
)
from usdmotion.report.balance import Balance
from usdmotion.report.findings import EditFindings, Findings

if TYPE_CHECKING:
    from matplotlib.axes import Axes


_LEAST = 0.4
"""Narrower than this the view from above does not become [m]."""
_LONG = 2.2
"""A way that is so many times as long as wide gets the whole width of the page."""


def balance(findings: Findings, edit: EditFindings) -> Picture | None:
    """Return the picture of the balance of an edit's character, None where there is none."""
    found = edit.balance
    if found is None:
        return None
    camera = _above(findings, edit, findings.joints(edit.edit.skeleton))
    wide, deep = np.maximum(np.ptp(camera.flat(found.after), axis=0), _LEAST)
    if wide > _LONG * deep:
        drawn = figure(2.6 + 9.0 * (deep + 0.3) / wide)
        rows = (9.0 * (deep + 0.3) / wide, 2.0)
        top, over_time = drawn.subplots(2, 1, height_ratios=rows)
    else:
        drawn = figure(3.6)
        top, over_time = drawn.subplots(1, 2, width_ratios=(1.0, 1.25))
    _from_above(top, findings, edit, found, camera)
    _over_time(over_time, findings, found)
    return Picture(
        "balance",
        "The centre of mass, grey in the input and blue in the result. From above: green are "
        "the places where feet stand in the result, the dotted line is the middle of the supports, "
        "the black line the frame on which it is farthest from that. "
        "Over time: how far it is from that middle along the ground. The masses are "
        f"{'authored' if found.masses_from == 'authored' else f'from {found.masses_from}'}.",
        drawn,
    )


def _from_above(
    axes: "Axes", findings: Findings, edit: EditFindings, found: Balance, camera: Camera
) -> None:
    start = found.before[0]

    def flat(points: Floats) -> Floats:
        return camera.flat(points - start)

    for footing in edit.footings:
        for first, end in footing.stances:
            place = flat(footing.after[first:end].mean(axis=0))
            axes.plot(*place, "o", color=SUPPORT, alpha=0.75, markersize=5.0, mew=0.0)
    x, y = flat(found.support_after).T
    axes.plot(x, y, color=SUPPORT, linewidth=1.1, linestyle=":")
    axes.plot(*flat(found.before).T, color=BEFORE, linewidth=2.4)
    axes.plot(*flat(found.after).T, color=AFTER)
    worst = int(found.away(findings.scene.up)[1].argmax())
    ends = np.stack([flat(found.support_after)[worst], flat(found.after)[worst]])
    axes.plot(*ends.T, color=INK, linewidth=1.0)
    axes.plot(*ends[1], "o", color=INK, markersize=3.5)
    axes.annotate(
        f"{findings.scene.time_codes[worst]:g}",
        ends[1],
        xytext=(5, 5),
        textcoords="offset points",
        fontsize=8.0,
    )
    low, high = axes.dataLim.get_points()
    lack = np.maximum(0.5 * (_LEAST - (high - low)), 0.05)
    axes.set_xlim(low[0] - lack[0], high[0] + lack[0])
    axes.set_ylim(low[1] - lack[1], high[1] + lack[1])
    axes.set_aspect("equal", anchor="W")
    axes.set_xlabel("m")
    axes.set_title("From above")


def _above(findings: Findings, edit: EditFindings, joints: slice) -> Camera:
    """Return a camera that looks straight down, with the way that the body goes to the right."""
    up = findings.scene.up
    root = findings.before[0][:, joints][:, edit.character.root]
    way = root[-1] - root[0]
    way = way - (way @ up) * up
    if np.linalg.norm(way) < 0.5:
        way = facing(edit.character, findings.before[0][0, joints], up)
    right = way / np.linalg.norm(way)
    return Camera(right, np.cross(up, right), up)


def _over_time(axes: "Axes", findings: Findings, found: Balance) -> None:
    codes = findings.scene.time_codes
    before, after = (1e3 * each for each in found.away(findings.scene.up))
    axes.plot(*thinned(codes, before), color=BEFORE, linewidth=2.4, label="input")
    axes.plot(*thinned(codes, after), color=AFTER, label="result")
    axes.set_ylim(0.0, 1.1 * max(float(before.max()), float(after.max()), 1.0))
    axes.set_ylabel("mm")
    axes.set_title("From the middle of its supports")
    axes.legend(loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.13))
    time_axis(axes, codes)

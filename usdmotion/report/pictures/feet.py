"""When feet stand, and how far they slide there."""

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.style import (
    AFTER,
    BEFORE,
    SOFT,
    SUPPORT,
    Picture,
    figure,
    stretches,
    thinned,
    time_axis,
)
from usdmotion.quality import LOW, SHORTEST, SLOW
from usdmotion.report.feet import Footing
from usdmotion.report.findings import EditFindings, Findings
from usdmotion.report.wording import amount

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LEAST = 2.0
"""Height of an axis on which nothing slides [mm]."""
_BAR = 0.16
"""Height of the bars under it, of that."""


def feet(findings: Findings, edit: EditFindings) -> Picture | None:
    """Return the picture of the standing feet of an edit's character, None where none stands."""
    if not edit.footings:
        return None
    codes = findings.scene.time_codes
    drawn = figure(0.85 * len(edit.footings) + 0.5)
    rows = drawn.subplots(len(edit.footings), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    slid = [(f.slid_before.max(), f.slid_after.max()) for f in edit.footings]
    top = max(1.15e3 * float(np.max(slid)), _LEAST)
    for axes, footing in zip(rows, edit.footings, strict=True):
        _row(axes, codes, footing, top)
        time_axis(axes, codes, label=axes is rows[-1])
    return Picture(
        "feet",
        "How far each point of a foot is, along the ground, from the middle of where it stands: "
        "grey in the input, blue in the result. It stands where it is green, which only the input "
        "says: where a contact holds it; else where it is slower than "
        f"{SLOW:g} lengths of a leg per second for {SHORTEST:g} s, its ankle less than {LOW:g} "
        "lengths of a leg above the lower one.",
        drawn,
    )


def _row(axes: "Axes", codes: Floats, footing: Footing, top: float) -> None:
    axes.broken_barh(
        stretches(codes, footing.stands),
        (-_BAR * top, 0.75 * _BAR * top),
        facecolor=SUPPORT,
        alpha=0.75,
        linewidth=0.0,
    )
    for slid, color, width in (
        (footing.slid_before, BEFORE, 2.4),
        (footing.slid_after, AFTER, 1.6),
    ):
        shown = np.where(footing.stands, 1e3 * slid, np.nan)
        axes.plot(*thinned(codes, shown), color=color, linewidth=width)
    before, after = float(footing.slid_before.max()), float(footing.slid_after.max())
    axes.set_title(footing.name)
    axes.set_title(
        f"largest slide: {amount(before, 'm')} in the input, {amount(after, 'm')} in the result",
        loc="right",
        weight="normal",
        color=SOFT,
        fontsize=8.5,
    )
    axes.set_ylim(-_BAR * top, top)
    axes.locator_params(axis="y", nbins=3)
    axes.set_ylabel("mm")

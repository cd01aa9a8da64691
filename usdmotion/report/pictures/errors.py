"""The error of each constraint over time, with its activity and what counts as met."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.style import (
    AFTER,
    INK,
    MISSED,
    PALE,
    SOFT,
    Picture,
    figure,
    thinned,
    time_axis,
)
from usdmotion.report.findings import EditFindings, Findings, Trace
from usdmotion.report.wording import amount

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MET, _MISSED = 0.68, 1.3
"""Height of a constraint that is met, and of one that is not [inches]."""
_MOST = 12
"""More constraints than this make another picture."""


def errors(findings: Findings, edit: EditFindings) -> list[Picture]:
    """Return the pictures of what is left of each constraint, in rank order."""
    traces = edit.traces
    parts = [traces[first : first + _MOST] for first in range(0, len(traces), _MOST)]
    return [
        _picture(findings, part, f"errors{index + 1 if len(parts) > 1 else ''}")
        for index, part in enumerate(parts)
    ]


def _picture(findings: Findings, traces: Sequence[Trace], name: str) -> Picture:
    codes = findings.scene.time_codes
    tall = [_MET if trace.verdict.met else _MISSED for trace in traces]
    drawn = figure(sum(tall) + 0.5)
    rows = drawn.subplots(len(traces), 1, sharex=True, squeeze=False, height_ratios=tall)[:, 0]
    for axes, trace in zip(rows, traces, strict=True):
        _row(axes, codes, trace)
        time_axis(axes, codes, label=axes is rows[-1])
    return Picture(
        name,
        "What is left of each constraint. The pale area is its activity, which fills the height "
        "where it is fully on; the dashed line is what counts as met; orange is where it is judged "
        "and missed; the thin line is where it is not judged.",
        drawn,
    )


def _row(axes: "Axes", codes: Floats, trace: Trace) -> None:
    scale = 1e3 if trace.verdict.unit == "m" else 1.0
    unit = "mm" if trace.verdict.unit == "m" else "°"
    held = scale * trace.errors
    judged = np.where(trace.plateau, held, 0.0)
    limit = scale * trace.tolerance
    top = max(1.12 * float(judged.max(initial=0.0)), 1.6 * limit)
    x, activity = thinned(codes, np.asarray(trace.activity, dtype=np.float64))
    axes.fill_between(x, 0.0, top * activity, color=PALE, alpha=0.55, linewidth=0.0, zorder=1)
    axes.axhline(limit, color=INK, linewidth=0.9, linestyle=(0, (4, 3)), zorder=2)
    everywhere = np.where(trace.on, np.minimum(held, 1.5 * top), np.nan)
    axes.plot(*thinned(codes, everywhere), color=SOFT, linewidth=0.8, zorder=3)
    axes.plot(*thinned(codes, np.where(trace.plateau, held, np.nan)), color=AFTER, zorder=4)
    over = np.where(trace.missed, held, np.nan)
    axes.plot(*thinned(codes, over), color=MISSED, linewidth=2.2, zorder=5)
    if trace.verdict.worst_time is not None and not trace.verdict.met:
        worst = scale * trace.verdict.max
        axes.plot(trace.verdict.worst_time, worst, "o", color=MISSED, markersize=4.5, zorder=6)
    axes.set_ylim(0.0, top)
    axes.locator_params(axis="y", nbins=3 if trace.verdict.met else 5)
    axes.set_ylabel(unit)
    axes.set_title(f"{trace.verdict.priority}  {trace.name}")
    axes.set_title(_said(trace), loc="right", weight="normal", color=_color(trace), fontsize=8.5)


def _said(trace: Trace) -> str:
    verdict = trace.verdict
    if verdict.worst_time is None:
        return "never fully on"
    word = "met" if verdict.met else "missed"
    return f"{word} · largest {amount(verdict.max, verdict.unit)} at {verdict.worst_time:g}"


def _color(trace: Trace) -> str:
    return SOFT if trace.verdict.met else MISSED

"""At a glance: the motion as postures along time, and under them what was met when."""

from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.bodies import Kind, draw_body
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import Mannequin, facing
from usdmotion.drawing.style import (
    AFTER,
    INK,
    LINE,
    MISSED,
    PALE,
    SOFT,
    WIDTH,
    Picture,
    figure,
    stretches,
    time_axis,
)
from usdmotion.motion import WorldPose
from usdmotion.quality import along_ground, ground_height
from usdmotion.report.findings import EditFindings, Findings, Trace

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STRIP = 2.0
"""Height of the postures [inches]."""
_LANE = 0.21
_GAP = 0.12
_LEFT, _RIGHT, _FOOT = 1.55, 0.55, 0.5
"""Margins [inches]."""
_SOLES = 0.2
"""Where the feet are above the lanes [inches]."""
_POSTURES = 9
_SEEN = 1e-3
"""The input is drawn where it is farther away than this [m]."""


def overview(findings: Findings, edit: EditFindings) -> Picture:
    """Return the picture of an edit at a glance."""
    lanes = max(len(edit.traces), 1) * _LANE + _GAP * len(edit.levels)
    height = _STRIP + lanes + _FOOT
    drawn = figure(height)
    drawn.set_layout_engine("none")
    wide = 1.0 - (_LEFT + _RIGHT) / WIDTH
    left = _LEFT / WIDTH
    strip = drawn.add_axes((0.0, (lanes + _FOOT) / height, 1.0, _STRIP / height))
    _postures(strip, findings, edit)
    axes = drawn.add_axes((left, _FOOT / height, wide, lanes / height), label="lanes")
    _lanes(axes, findings, edit)
    return Picture(
        "overview",
        "The motion along time, the input grey and the result blue. Under it, for each "
        "constraint: blue where it is judged and met, orange where it is judged and missed, pale "
        "where it eases or keeps its original trajectory.",
        drawn,
    )


def _postures(axes: "Axes", findings: Findings, edit: EditFindings) -> None:
    """Draw postures at even times, each where its time is, all from one side."""
    scene, character = findings.scene, edit.character
    up, codes = scene.up, scene.time_codes
    wide = _strip(axes)
    mannequin = Mannequin.of(character)
    joints = findings.joints(edit.edit.skeleton)
    frames = np.linspace(0, len(codes) - 1, min(_POSTURES, len(codes))).round().astype(np.int64)
    before, after = findings.before[0][:, joints], findings.after[0][:, joints]
    camera = Camera.at(facing(character, before[len(before) // 2], up), up, -55.0, 8.0)
    ground = ground_height(before, up)
    highest = max(float((after @ up).max()), float((before @ up).max())) - ground
    scale = (_STRIP - _SOLES - 0.1) / max(highest * 1.12, 1e-6)
    span = max(float(np.ptp(codes)), 1e-9)
    changed = edit.moved.max(axis=1) > _SEEN
    poses: tuple[tuple[Kind, WorldPose], ...] = (
        ("before", findings.before),
        ("after", findings.after),
    )
    for frame in frames:
        here = (wide * float(codes[frame] - codes[0]) / span, _SOLES)
        origin = along_ground(before[frame, character.root], up) + ground * up
        for kind, (p, q) in poses:
            if kind == "after" or changed[frame]:
                pose = p[frame, joints] - origin, q[frame, joints]
                draw_body(axes, mannequin, camera, pose, kind=kind, scale=scale, shift=here)


def _strip(axes: "Axes") -> float:
    """Make inches the unit of the postures' axes, and return how wide time is in them."""
    wide = WIDTH - _LEFT - _RIGHT
    axes.set_xlim(-_LEFT, wide + _RIGHT)
    axes.set_ylim(0.0, _STRIP)
    axes.axis("off")
    floor = _SOLES - 0.04
    axes.plot([-0.3, wide + 0.3], [floor, floor], color=LINE, linewidth=1.0, zorder=0)
    return wide


def _lanes(axes: "Axes", findings: Findings, edit: EditFindings) -> None:
    codes = findings.scene.time_codes
    place, ticks, names = 0.0, [], []
    for rank, traces in edit.levels:
        place += _GAP
        top = place
        for trace in traces:
            _lane(axes, codes, trace, place)
            ticks.append(place + 0.5 * _LANE)
            names.append(trace.name)
            place += _LANE
        axes.annotate(
            str(rank),
            (1.0, 0.5 * (top + place)),
            xycoords=("axes fraction", "data"),
            xytext=(9, 0),
            textcoords="offset points",
            va="center",
            ha="center",
            weight="bold",
            color=INK,
        )
    axes.set_ylim(place + 0.04, 0.0)
    axes.set_yticks(ticks, [_fitted(name) for name in names])
    axes.tick_params(axis="y", length=0, labelcolor=INK)
    axes.spines["left"].set_visible(False)
    axes.grid(axis="y", visible=False)
    axes.annotate(
        "rank",
        (1.0, 0.0),
        xycoords="axes fraction",
        xytext=(9, -12),
        textcoords="offset points",
        ha="center",
        color=SOFT,
        fontsize=7.5,
    )
    time_axis(axes, codes)


def _lane(axes: "Axes", codes: Floats, trace: Trace, place: float) -> None:
    middle, thick = place + 0.5 * _LANE, 0.62 * _LANE
    axes.plot([codes[0], codes[-1]], [middle, middle], color=LINE, linewidth=1.0, zorder=1)
    met = trace.plateau & ~trace.missed
    layers = (
        (trace.on & ~trace.plateau, PALE, 0.6),
        (met, AFTER, 1.0),
        (trace.missed, MISSED, 1.35),
    )
    for order, (mask, color, tall) in enumerate(layers):
        axes.broken_barh(
            stretches(codes, mask),
            (middle - 0.5 * tall * thick, tall * thick),
            facecolor=color,
            linewidth=0.0,
            zorder=2 + order,
        )


def _fitted(name: str) -> str:
    return name if len(name) <= 26 else f"{name[:12]}…{name[-13:]}"

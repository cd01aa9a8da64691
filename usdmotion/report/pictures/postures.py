"""The posture at one frame: the input pale, the result solid, the goals marked."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.bodies import Kind, draw_body
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import Mannequin, facing
from usdmotion.drawing.style import GOAL, INK, MISSED, SUPPORT, Picture, figure
from usdmotion.quality import ground_height
from usdmotion.report.findings import Findings
from usdmotion.report.moments import Mark, Moment
from usdmotion.report.wording import amount

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NEAR = 2.5
"""Somebody farther away than this is not in the picture, in heights of the body."""
_TOLD = 4
"""So many constraints are named that are missed on one frame."""
_TALL = 4.4
"""Height of a picture [inches]."""
_LABEL_WIDE, _LABEL_TALL = 90.0, 11.0
"""About the size of a name [points]."""
_GRID = 0.5
"""Width of a square of the ground [m]."""


def posture(findings: Findings, moment: Moment, marks: Sequence[Mark], number: int) -> Picture:
    """Return the picture of one moment, from two sides."""
    scene, edit = findings.scene, moment.edit
    joints = findings.joints(edit.edit.skeleton)
    before = findings.before[0][moment.frame, joints]
    ahead = facing(edit.character, findings.after[0][moment.frame, joints], scene.up)
    side = _side(ahead, scene.up, before.mean(axis=0), moment, marks)
    drawn = figure(_TALL, 6.6)
    views = ((side * 35.0, 12.0), (side * 90.0, 4.0))
    for axes, (turn, rise) in zip(drawn.subplots(1, 2), views, strict=True):
        camera = Camera.at(ahead, scene.up, turn, rise)
        _view(axes, findings, moment, marks, camera)
    return Picture(f"frame{number}", _caption(findings, moment), drawn)


def _side(
    ahead: Floats, up: Floats, middle: Floats, moment: Moment, marks: Sequence[Mark]
) -> float:
    """Return from which side to look, 1 the left, so that the body does not hide what is missed."""
    left = np.cross(up, ahead)
    own = [mark.place for mark in marks if mark.trace is moment.trace]
    return -1.0 if own and float((own[0] - middle) @ left) < 0.0 else 1.0


def _view(
    axes: "Axes", findings: Findings, moment: Moment, marks: Sequence[Mark], camera: Camera
) -> None:
    frame, shown = moment.frame, []
    axes.set_aspect("equal")
    axes.axis("off")
    own = findings.joints(moment.edit.edit.skeleton)
    middle = findings.after[0][frame, own].mean(axis=0)
    for character in findings.scene.characters:
        joints = findings.joints(character.path)
        mannequin = Mannequin.of(character)
        reach = _NEAR * mannequin.height
        is_own = character.path == moment.edit.edit.skeleton
        if np.linalg.norm(findings.after[0][frame, joints].mean(axis=0) - middle) > reach:
            continue
        kinds: tuple[Kind, Kind] = ("before", "after" if is_own else "other")
        for kind, (p, q) in zip(kinds, (findings.before, findings.after), strict=True):
            pose = p[frame, joints], q[frame, joints]
            draw_body(axes, mannequin, camera, pose, kind=kind)
            starts, ends = mannequin.capsules(*pose)
            thick = np.repeat(mannequin.radii, 2)[:, None]
            flat = camera.flat(np.stack([starts, ends], 1).reshape(-1, 3))
            shown += [flat - thick, flat + thick]
    shown += [_mark(axes, mark, camera) for mark in marks]
    before = findings.before[0][:, own]
    _frame(axes, findings.scene.up, before, camera, np.concatenate(shown), middle)
    _names(axes, marks, camera)


def _mark(axes: "Axes", mark: Mark, camera: Camera) -> Floats:
    """Draw an effector and where it is wanted; return the points that have to be seen."""
    place = camera.flat(mark.place)
    color = MISSED if mark.missed else GOAL
    if mark.wanted is None:
        sign, large = ("x", 2.6) if mark.missed else ("o", 1.5)
        axes.plot(*place, sign, mfc="none", mec=color, ms=8.0, mew=large, zorder=8)
        return np.array([place])
    if not mark.stands_out:
        axes.plot(*place, "o", color=SUPPORT, ms=4.5, mec="white", mew=0.8, zorder=8)
        return np.array([place])
    wanted = camera.flat(mark.wanted)
    axes.plot(*np.stack([place, wanted]).T, color=color, linewidth=1.6, zorder=8)
    axes.plot(*place, "o", color=color, ms=3.2, zorder=9)
    if mark.missed:
        axes.plot(*wanted, "x", color=color, ms=10.0, mew=2.6, zorder=9)
    else:
        axes.plot(*wanted, "o", mfc="none", mec=color, ms=8.0, mew=1.5, zorder=9)
        axes.plot(*wanted, "+", color=color, ms=11.0, mew=1.5, zorder=9)
    return np.array([place, wanted])


def _names(axes: "Axes", marks: Sequence[Mark], camera: Camera) -> None:
    """Name what is missed or has a goal, each beside its mark and none over another."""
    named = [mark for mark in marks if mark.stands_out]
    places = [camera.flat(m.place if m.wanted is None else m.wanted) for m in named]
    low, high = axes.get_ylim()
    points = 72.0 * (_TALL - 0.2) / (high - low)
    taken: list[tuple[float, float]] = []
    for place, mark in sorted(zip(places, named, strict=True), key=lambda each: each[0][1]):
        x, y = points * place[0], points * place[1] + 6.0
        for other_x, other_y in taken:
            if abs(x - other_x) < _LABEL_WIDE and y - other_y < _LABEL_TALL:
                y = other_y + _LABEL_TALL
        taken.append((x, y))
        axes.annotate(
            mark.trace.name,
            (float(place[0]), float(place[1])),
            xytext=(9.0, y - points * float(place[1])),
            textcoords="offset points",
            color=INK,
            fontsize=8.5,
            weight="bold",
            bbox={"facecolor": "white", "alpha": 0.75, "linewidth": 0.0, "pad": 0.6},
            zorder=10,
        )


def _frame(
    axes: "Axes", up: Floats, before: Floats, camera: Camera, shown: Floats, middle: Floats
) -> None:
    """Set the limits of a view, and draw the ground that it sees."""
    low, high = shown.min(axis=0), shown.max(axis=0)
    ground = ground_height(before, up)
    center = middle - (middle @ up - ground) * up
    low[1] = min(low[1], float(camera.flat(center)[1]))
    pad = 0.06 * float((high - low).max())
    axes.set_xlim(low[0] - pad, high[0] + pad)
    axes.set_ylim(low[1] - pad, high[1] + pad)
    first = camera.right
    second = np.cross(up, first)
    reach = _GRID * np.ceil(max(float(high[0] - low[0]) / _GRID, 2.0))
    lines = np.arange(-reach, reach + 1e-9, _GRID)
    for line in lines:
        for along, across in ((first, second), (second, first)):
            ends = center + np.outer((-reach, reach), along) + line * across
            axes.plot(*camera.flat(ends).T, color="#e6eaee", linewidth=0.8, zorder=0)


def _caption(findings: Findings, moment: Moment) -> str:
    code = findings.scene.time_codes[moment.frame]
    if moment.trace is None:
        joint = int(moment.edit.moved[moment.frame].argmax())
        name = moment.edit.character.skeleton.joints[joint].rsplit("/", 1)[-1]
        moved = amount(float(moment.edit.moved[moment.frame, joint]), "m")
        return f"Frame {code:g}, where most was changed: {name} is {moved} from where it was."
    missed = [trace for trace in moment.edit.traces if trace.missed[moment.frame]]
    missed.sort(key=lambda trace: (trace is not moment.trace, -trace.errors[moment.frame]))
    told = [
        f"{trace.name} {amount(float(trace.errors[moment.frame]), trace.verdict.unit)}"
        for trace in missed[:_TOLD]
    ]
    more = f" and {len(missed) - _TOLD} more" if len(missed) > _TOLD else ""
    return f"Frame {code:g}, missed by: {', '.join(told)}{more}."

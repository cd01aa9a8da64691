"""Signs for places, and what is written beside them: nothing over anything else."""

from collections.abc import Sequence
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.eyes import Window
from usdmotion.drawing.polygons import rgb
from usdmotion.drawing.strips import Spot
from usdmotion.drawing.style import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

_TEXT = 6.5
"""Size of what is written [points]."""
_WIDE, _TALL = 0.66, 1.2
"""About the size of a letter, over the size of the text."""
_SIGN = 5.0
_NUMBER = 1.5
"""How far a number is from its place [points]."""
_HALVES = {"held": 2.0}
"""Half of the size of signs [points], of one that is not named here the first."""
_FAINT, _CROWDED = 0.5, 0.1
"""What is paler is left out where more than this part of it would be over something else."""
_SIDES = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1, 1), (-1, 1), (1, -1), (-1, -1))
"""To which sides something may be written, the best first."""
_ABOVE = ((0.0, 1.0), (-1, 1), (1, 1), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (1, -1), (-1, -1))
"""The same of numbers, which have no sign."""
_STEPS = (0.0, 6.0, 14.0)
"""How much farther away it may be written, the best first [points]."""
_OVER = 50.0
"""Order of what is drawn above all that is solid."""


def draw_spots(
    sheet: "Axes", spots: Sequence[Spot], places: Floats, panel: Window, fineness: float
) -> None:
    """Draw signs, and what is said of them.

    Args:
        sheet: Where, in points of print.
        spots: What is drawn.
        places: Where each is on the sheet, shape (count, 2).
        panel: Beyond which nothing is best written.
        fineness: How large signs are, over what they are at most.
    """
    taken = []
    for spot, place in zip(spots, places, strict=True):
        if spot.sign != "number":
            _sign(sheet, spot, place, fineness)
            half = fineness * _HALVES.get(spot.sign, _SIGN)
            taken.append(_box(place, np.zeros(2), np.array((half, half))))
    # What is missed is named first, where there is most room, and what is pale last.
    named = [index for index, spot in enumerate(spots) if spot.text]
    for index in sorted(
        named, key=lambda each: (spots[each].sign != "missed", -spots[each].opacity)
    ):
        room = _room(places[index], spots[index], taken, np.array(panel))
        if room is not None:
            taken.append(room)
            _write(sheet, spots[index], 0.5 * (room[:2] + room[2:]))


def _sign(axes: "Axes", spot: Spot, place: Floats, fine: float) -> None:
    """Draw the sign of a place."""
    color, kind, white = rgb(spot.color, spot.opacity), spot.sign, rgb("white", spot.opacity)
    if kind == "held":
        _mark(axes, place, "o", 3.4 * fine, face=color, edge=white, width=0.6 * fine)
    elif kind == "mass":
        _mark(axes, place, "o", 8.0 * fine, face=white, edge=white, width=1.6 * fine)
        _mark(axes, place, "o", 8.0 * fine, face=white, edge=color, width=0.9 * fine)
        _mark(axes, place, _quarters(), 8.0 * fine, face=color, edge=color, width=0.0)
    elif kind == "missed":
        # It has to be seen, and to be told from goals without its colour.
        large = max(fine, 0.7)
        for edge, width in ((rgb("white", spot.opacity), 4.2), (color, 2.2)):
            _mark(axes, place, "x", 8.0 * large, face="none", edge=edge, width=width * large)
    else:
        for edge, width in ((rgb("white", 0.8 * spot.opacity), 2.4), (color, 1.1)):
            _mark(axes, place, "o", 7.5 * fine, face="none", edge=edge, width=width * fine)
            _mark(axes, place, "+", 11.2 * fine, face="none", edge=edge, width=width * fine)


def _mark(
    axes: "Axes",
    place: Floats,
    sign: "str | Path",
    size: float,
    *,
    face: "Floats | str",
    edge: Floats,
    width: float,
) -> None:
    axes.plot(
        place[0],
        place[1],
        linestyle="none",
        marker=sign,
        markersize=size,
        markerfacecolor=face if isinstance(face, str) else tuple(face),
        markeredgecolor=tuple(edge),
        markeredgewidth=width,
        zorder=_OVER,
    )


def _quarters() -> "Path":
    """Return two opposite quarters of a disk, the sign of a centre of mass."""
    from matplotlib.path import Path

    return Path.make_compound_path(Path.wedge(0.0, 90.0), Path.wedge(180.0, 270.0))


def _write(sheet: "Axes", spot: Spot, middle: Floats) -> None:
    from matplotlib.patheffects import withStroke

    sheet.text(
        middle[0],
        middle[1],
        spot.text,
        ha="center",
        va="center",
        fontsize=_TEXT,
        weight="bold",
        color=tuple(rgb(spot.color if spot.sign in ("missed", "number") else INK, spot.opacity)),
        path_effects=[withStroke(linewidth=1.8, foreground="white", alpha=spot.opacity**0.5)],
        zorder=_OVER + 1.0,
    )


def _room(place: Floats, spot: Spot, taken: Sequence[Floats], panel: Floats) -> Floats | None:
    """Return the box in which something is best written; None of what is pale and has no room.

    It is the first try that is over nothing else, or over the least.
    """
    half = np.array((0.5 * _WIDE * len(spot.text), 0.5 * _TALL)) * _TEXT
    is_number = spot.sign == "number"
    away = half + (_NUMBER if is_number else _SIGN + 1.0)
    sides = _ABOVE if is_number else _SIDES
    tries = [step * np.array(side) + away * side for step, side in product(_STEPS, sides)]
    boxes = [_box(place, offset, half) for offset in tries]
    losses = [
        sum(_common(box, other) for other in taken) + 4.0 * (_area(box) - _common(box, panel))
        for box in boxes
    ]
    best = int(np.argmin(np.array(losses) + 1e-3 * np.arange(len(losses))))
    if spot.opacity < _FAINT and losses[best] > _CROWDED * _area(boxes[best]):
        return None
    return boxes[best]


def _box(place: Floats, offset: Floats, half: Floats) -> Floats:
    """Return left, bottom, right and top of a box around a place, shape (4,)."""
    middle = place + offset
    return np.concatenate([middle - half, middle + half])


def _area(box: Floats) -> float:
    return float(np.prod(np.maximum(box[2:] - box[:2], 0.0)))


def _common(one: Floats, other: Floats) -> float:
    """Return the area that two boxes share."""
    low, high = np.maximum(one[:2], other[:2]), np.minimum(one[2:], other[2:])
    return float(np.prod(np.maximum(high - low, 0.0)))

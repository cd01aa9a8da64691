"""Strips of poses as pictures."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from usdmotion.drawing.eyes import Placed, Window
from usdmotion.drawing.framing import size, widened, windows
from usdmotion.drawing.panels import draw_panel
from usdmotion.drawing.strips import Row, Strip
from usdmotion.drawing.style import INK, SOFT, Picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDE = 7.4
"""Most width of a strip [inches]."""
_TALL = {1: 3.4, 2: 3.0, 3: 2.6}
"""Most height of a row, by how many panels it has [inches]."""
_LOWEST = 2.0
"""The same of a row with more panels."""
_NARROW = 0.8
"""Least width of a panel [inches]."""
_MARGIN, _GAP, _TITLE = 0.2, 0.06, 0.17
"""Room for the titles of rows, between panels, and for the titles of panels [inches]."""
_POINTS = 72.0
"""In an inch."""


def strip_picture(strip: Strip, *, name: str = "strip") -> Picture:
    """Return the picture of a strip; draw inside `drawing()`.

    Args:
        strip: What is drawn; each row has a panel.
        name: Of the picture.
    """
    from matplotlib.figure import Figure

    shown = windows(strip.rows)
    count = max(len(row.panels) for row in strip.rows)
    margin = _MARGIN if any(row.title for row in strip.rows) else 0.0
    scales = [_scale(row, (WIDE - margin) / count - _GAP) for row in shown]
    spans = [
        (scale, *map(max, zip(*map(size, row), strict=True)))
        for scale, row in zip(scales, shown, strict=True)
    ]
    wide = max(_NARROW, *(scale * width for scale, width, _ in spans))
    heights = [scale * height for scale, _, height in spans]
    drawn = Figure(figsize=(margin + count * (wide + _GAP), sum(heights) + len(heights) * _TITLE))
    sheet, top = _sheet(drawn), drawn.get_figheight()
    for row, own, scale, height in zip(strip.rows, shown, scales, heights, strict=True):
        top -= _TITLE + height
        framed = [widened(window, wide / scale, height / scale) for window in own]
        _row(sheet, row, framed, (margin, top, wide, height))
    return Picture(name, strip.caption, drawn)


def _sheet(drawn: "Figure") -> "Axes":
    """Return axes that fill a figure, in points of print; many axes would take their time."""
    wide, tall = drawn.get_size_inches()
    sheet = drawn.add_axes((0.0, 0.0, 1.0, 1.0))
    sheet.set(xlim=(0.0, _POINTS * wide), ylim=(0.0, _POINTS * tall), autoscale_on=False)
    sheet.axis("off")
    return sheet


def _scale(row: Sequence[Window], most: float) -> float:
    """Return how many inches a metre, or whatever the unit of its windows, is in a row."""
    highest = _TALL.get(len(row), _LOWEST)
    return min(min(most / wide, highest / tall) for wide, tall in map(size, row))


def _row(sheet: "Axes", row: Row, shown: Sequence[Window], place: Window) -> None:
    """Draw a row from a place on: its left, bottom, and width and height of a panel [inches]."""
    left, bottom, wide, tall = (_POINTS * each for each in place)
    if row.title:
        told: dict[str, Any] = {"rotation": "vertical", "va": "center", "weight": "bold"}
        sheet.text(4.0, bottom + 0.5 * tall, row.title, fontsize=7.5, color=INK, **told)
    for panel, window in zip(row.panels, shown, strict=True):
        eye = Placed.at(panel.eye, window, (left, bottom), wide / size(window)[0])
        draw_panel(sheet, panel, eye)
        middle, top = left + 0.5 * wide, bottom + tall + 2.0
        sheet.text(middle, top, panel.title, ha="center", fontsize=7.0, color=SOFT)
        left += wide + _POINTS * _GAP

"""Strips of poses as pictures."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from usdmotion.drawing.eyes import Window
from usdmotion.drawing.framing import size, widened, windows
from usdmotion.drawing.panels import draw_panel
from usdmotion.drawing.strips import Row, Strip
from usdmotion.drawing.style import INK, SOFT, Picture

if TYPE_CHECKING:
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
    top = drawn.get_figheight()
    for row, own, scale, height in zip(strip.rows, shown, scales, heights, strict=True):
        top -= _TITLE + height
        framed = [widened(window, wide / scale, height / scale) for window in own]
        _row(drawn, row, framed, (margin, top, wide, height))
    return Picture(name, strip.caption, drawn)


def _scale(row: Sequence[Window], most: float) -> float:
    """Return how many inches a metre, or whatever the unit of its windows, is in a row."""
    highest = _TALL.get(len(row), _LOWEST)
    return min(min(most / wide, highest / tall) for wide, tall in map(size, row))


def _row(drawn: "Figure", row: Row, shown: Sequence[Window], place: Window) -> None:
    """Draw a row from a place on: its left, bottom, and width and height of a panel [inches]."""
    left, bottom, wide, tall = place
    whole, high = drawn.get_size_inches()
    if row.title:
        drawn.text(
            0.06 / whole,
            (bottom + 0.5 * tall) / high,
            row.title,
            rotation="vertical",
            ha="left",
            va="center",
            fontsize=7.5,
            color=INK,
            weight="bold",
        )
    for panel, window in zip(row.panels, shown, strict=False):
        axes = drawn.add_axes((left / whole, bottom / high, wide / whole, tall / high))
        draw_panel(axes, panel, window, size(window)[0] / (wide * _POINTS))
        middle = (left + 0.5 * wide) / whole
        drawn.text(
            middle,
            (bottom + tall + 0.03) / high,
            panel.title,
            ha="center",
            va="bottom",
            fontsize=7.0,
            color=SOFT,
        )
        left += wide + _GAP

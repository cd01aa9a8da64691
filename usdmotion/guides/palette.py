"""Colours that tell objects apart, also for those who see fewer of them than others."""

from collections.abc import Sequence

import numpy as np

Color = tuple[float, float, float]
"""Red, green and blue as USD holds them, linear, 0..1."""

_HEX = (
    "E69F00",
    "0072B2",
    "009E73",
    "CC79A7",
    "56B4E9",
    "F0E442",
    "AA4499",
    "332288",
    "44AA99",
    "DDCC77",
)
"""The colours of Okabe and Ito (2008), then of Tol (2021), but for those that somebody could take
for the red of what is missed; neighbours are far apart."""
MISSED: Color = (0.85, 0.02, 0.02)
"""Of what was missed, and of nothing else."""
_SAME = 1e-3


def _linear(name: str) -> Color:
    """Return the linear values of a colour of the screen (IEC 61966-2-1)."""
    screen = np.array([int(name[start : start + 2], 16) for start in (0, 2, 4)]) / 255.0
    light = np.where(screen <= 0.04045, screen / 12.92, ((screen + 0.055) / 1.055) ** 2.4)
    red, green, blue = (round(float(each), 4) for each in light)
    return red, green, blue


COLORS: tuple[Color, ...] = tuple(_linear(name) for name in _HEX)
"""In the order in which they are given away."""


def another(used: Sequence[Color]) -> Color:
    """Return the colour that is used least, of those the first."""
    counts = [sum(same(one, each) for one in used) for each in COLORS]
    return COLORS[counts.index(min(counts))]


def same(one: Color, other: Color) -> bool:
    """Tell whether two colours are one, written as precisely as USD does."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) < _SAME

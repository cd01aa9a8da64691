"""Numbers drawn by strokes, as no two viewers draw text alike."""

import numpy as np

from usdmotion.arrays import Floats

_ADVANCE = 0.85
"""From one digit to the next, over their height."""
_WIDTH = 0.6
_SIX = (
    (0.50, 1.0),
    (0.32, 0.88),
    (0.12, 0.66),
    (0.02, 0.34),
    (0.10, 0.08),
    (0.30, 0.0),
    (0.50, 0.08),
    (0.60, 0.28),
    (0.50, 0.48),
    (0.30, 0.56),
    (0.10, 0.46),
    (0.02, 0.34),
)
_STROKES = {
    "0": (
        (0.30, 1.0),
        (0.50, 0.90),
        (0.60, 0.65),
        (0.60, 0.35),
        (0.50, 0.10),
        (0.30, 0.0),
        (0.10, 0.10),
        (0.0, 0.35),
        (0.0, 0.65),
        (0.10, 0.90),
        (0.30, 1.0),
    ),
    "1": ((0.10, 0.75), (0.35, 1.0), (0.35, 0.0)),
    "2": (
        (0.02, 0.78),
        (0.12, 0.95),
        (0.30, 1.0),
        (0.50, 0.93),
        (0.58, 0.75),
        (0.50, 0.55),
        (0.0, 0.0),
        (0.60, 0.0),
    ),
    "3": (
        (0.02, 1.0),
        (0.58, 1.0),
        (0.26, 0.60),
        (0.48, 0.55),
        (0.60, 0.32),
        (0.50, 0.08),
        (0.28, 0.0),
        (0.02, 0.12),
    ),
    "4": ((0.45, 0.0), (0.45, 1.0), (0.0, 0.28), (0.60, 0.28)),
    "5": (
        (0.56, 1.0),
        (0.10, 1.0),
        (0.06, 0.56),
        (0.30, 0.62),
        (0.52, 0.52),
        (0.60, 0.30),
        (0.50, 0.08),
        (0.28, 0.0),
        (0.02, 0.12),
    ),
    "6": _SIX,
    "7": ((0.0, 1.0), (0.60, 1.0), (0.20, 0.0)),
    "8": (
        (0.30, 0.55),
        (0.10, 0.65),
        (0.08, 0.86),
        (0.30, 1.0),
        (0.52, 0.86),
        (0.50, 0.65),
        (0.30, 0.55),
        (0.06, 0.42),
        (0.02, 0.14),
        (0.30, 0.0),
        (0.58, 0.14),
        (0.54, 0.42),
        (0.30, 0.55),
    ),
    "9": tuple((_WIDTH - across, 1.0 - above) for across, above in _SIX),
}
"""One stroke a digit, in a box 0.6 wide and 1 high."""


def strokes(number: int) -> tuple[Floats, ...]:
    """Return the strokes of a number that is 1 high and stands on the middle of its foot.

    Args:
        number: Not negative.

    Returns:
        One polyline a digit, each of shape (point_count, 2): to the right, and up.
    """
    digits = str(number)
    left = -0.5 * (_ADVANCE * (len(digits) - 1) + _WIDTH)
    return tuple(
        np.add(_STROKES[digit], (left + _ADVANCE * place, 0.0))
        for place, digit in enumerate(digits)
    )

"""Feet that swing clear what is under them."""

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.ground import Ground
from usdmotion.s4d.standing.footprints import between

_MARGIN = 0.015
"""Soles swing this high above the ground, if they did above the one the motion was made on [m]."""
_AROUND = 0.05
"""How long before and after it is needed a foot is lifted [s]."""
_ENDS = 0.06
"""Within how long after it leaves the ground, and before it comes down, the lift is eased [s]."""


def lift(
    soles: Floats,
    original: Floats,
    made_on: float,
    stands: Bools,
    ground: Ground,
    times: Floats,
    up: Floats,
) -> Floats:
    """Return how much a foot is lifted so that it clears the ground [m], shape (frame_count,).

    Args:
        soles: Points of its sole as it moves from footprint to footprint [m], (frame_count, P, 3).
        original: The same points in the motion as it was.
        made_on: Height of the ground that it was made on.
        stands: When it stands, shape (frame_count,).
        ground: What is under it.
        times: Seconds, shape (frame_count,).
        up: The direction away from the ground, shape (3,).
    """
    heights, _ = ground.under(soles, times)
    wanted = np.minimum(original @ up - made_on, _MARGIN)
    missing = np.nan_to_num(wanted - (soles @ up - heights), nan=0.0).max(axis=1)
    if stands.any():
        # From where it stood a little in the ground it leaves as it was there, and comes down so.
        missing = missing - np.maximum(between(times, stands, missing), 0.0)
    missing = np.where(stands, 0.0, np.maximum(missing, 0.0))
    return covering(missing, times, _AROUND, _AROUND) * _share(stands, times)


def covering(values: Floats, times: Floats, width: float, smooth: float) -> Floats:
    """Return a smooth curve above some values that are not negative, nowhere below if it is wide.

    Args:
        values: Shape (frame_count,).
        times: Seconds, shape (frame_count,).
        width: How long before and after a value it is as high [s].
        smooth: How long before and after that it already, and still, rises [s].
    """
    if not values.any() or len(times) < 2:
        return values
    from scipy.ndimage import maximum_filter1d  # slow to import, seldom needed

    wide, half = (
        max(round(each / float(np.median(np.diff(times)))), 1) for each in (width, smooth)
    )
    highest = maximum_filter1d(values, 2 * wide + 1, mode="nearest")
    bell = np.hanning(2 * half + 3)[1:-1]
    return np.convolve(np.pad(highest, half, mode="edge"), bell / bell.sum(), mode="valid")


def _share(stands: Bools, times: Floats) -> Floats:
    """Return 1 in the middle of a swing and 0 at both ends of it, which are on the ground."""
    on, index = np.flatnonzero(stands), np.arange(len(times))
    if not len(on):
        return np.ones(len(times))
    before = np.searchsorted(on, index, side="right") - 1
    after = np.searchsorted(on, index)
    since = np.where(before >= 0, times - times[on[np.maximum(before, 0)]], np.inf)
    until = np.where(after < len(on), times[on[np.minimum(after, len(on) - 1)]] - times, np.inf)
    s = np.clip(np.minimum(since, until) / _ENDS, 0.0, 1.0)
    return np.asarray(s * s * (3.0 - 2.0 * s))

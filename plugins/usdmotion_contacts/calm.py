"""When an object rests, how fast it moves when it does not, and how much of that is noise."""

import math
from dataclasses import dataclass

import numpy as np

from usdmotion import Bools, Floats, Ints

WINDOW = 0.2
"""Over how long a drift is measured [s]: longer than a turn of the way, shorter than a step."""
SLOW = 0.1
"""What drifts by less rests, where nothing else tells [m/s]."""
STANDSTILL = 1e-3
"""Drifts slower than this are all the same: a frozen frame is no third mode [m/s]."""
TWO_MODES = 3.0
"""Ashman's D of two modes that are two: the halves of one normal distribution have 2.65."""
_SQUARES = 2.366
"""Median of the sum of three squared standard normal numbers."""
_LOW_SQUARES = 1.2125
"""Its lower quartile."""


@dataclass(frozen=True, eq=False)
class Calm:
    """How an object moves as a whole."""

    rests: Bools
    """The frames on which it does not go anywhere, shape (frame_count,)."""
    slow: float
    """What drifts by less rests [m/s]; 0 of an object that never does."""
    usual: float
    """How fast it goes when it goes [m/s], the geometric mean."""
    noise: float
    """Standard deviation along each axis of what differs from frame to frame [m]."""

    @classmethod
    def of(cls, times: Floats, translations: Floats) -> "Calm":
        """Look at an object.

        Its drift over a fifth of a second, of what is left without single outliers, is hardly
        noise: that grows no farther with time. Drifts of something that now rests and now moves
        have two modes, whose logarithms are parted where the classes are farthest from each other
        (Otsu 1979). With one mode only it rests throughout or never, as slow as `SLOW` or faster.

        Args:
            times: Ascending [s], shape (frame_count,).
            translations: World positions of its origin [m], shape (frame_count, 3).
        """
        drifts = np.maximum(_drifts(times, _without_spikes(translations)), STANDSTILL)
        slow, usual = _parted(np.log(drifts))
        rests = np.asarray(drifts <= slow)
        return cls(rests, slow, usual, _noise(translations, rests))


def _without_spikes(places: Floats) -> Floats:
    """Return the running median of three along each axis, (F, 3) to (F, 3)."""
    if len(places) < 3:
        return places
    before, here, after = places[:-2], places[1:-1], places[2:]
    low, high = np.minimum(before, here), np.maximum(before, here)
    inner = np.maximum(low, np.minimum(high, after))
    return np.concatenate([inner[:1], inner, inner[-1:]])


def _drifts(times: Floats, places: Floats) -> Floats:
    """Return the speeds of the straight ways that fit best around each frame [m/s], (F,)."""
    half = 0.5 * WINDOW
    if len(times) > 1:
        half = max(half, float(np.median(np.diff(times)))) + 1e-6
    first = np.searchsorted(times, times - half).astype(np.int64)
    end = np.searchsorted(times, times + half, side="right").astype(np.int64)
    count = (end - first)[:, None]
    seconds, metres = (times - times[0])[:, None], places - places[0]
    t, tt, x, tx = (
        _sums(each, first, end) for each in (seconds, seconds**2, metres, seconds * metres)
    )
    spread = tt - t * t / count
    slopes = np.divide(tx - t * x / count, spread, out=np.zeros_like(x), where=spread > 1e-12)
    return np.asarray(np.linalg.norm(slopes, axis=1))


def _sums(values: Floats, first: Ints, end: Ints) -> Floats:
    totals = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    return np.asarray(totals[end] - totals[first])


def _parted(logarithms: Floats) -> tuple[float, float]:
    """Return the speed below which an object rests, and the usual one above it [m/s]."""
    ascending = np.sort(logarithms)
    middle, total = float(np.median(ascending)), len(ascending)
    one_mode = SLOW if middle < math.log(SLOW) else 0.0, math.exp(middle)
    if total < 2:
        return one_mode
    sums = np.cumsum(ascending)
    counts = np.arange(1, total)
    low, high = sums[:-1] / counts, (sums[-1] - sums[:-1]) / (total - counts)
    best = int(np.argmax(counts * (total - counts) * (high - low) ** 2))
    widths = math.hypot(ascending[: best + 1].std(), ascending[best + 1 :].std())
    apart = float(high[best] - low[best])
    if math.sqrt(2.0) * apart <= TWO_MODES * widths or apart <= math.log(2.0):
        return one_mode
    return math.exp(0.5 * (low[best] + high[best])), math.exp(high[best])


def _noise(places: Floats, rests: Bools) -> float:
    """Return the standard deviation of what is independent from frame to frame [m].

    Second differences of it have six times its variance. They are looked at where the object
    rests; where it never does, the stillest quarter of them is.
    """
    if len(places) < 3:
        return 0.0
    squares = np.sum(np.diff(places, n=2, axis=0) ** 2, axis=1)
    inside = squares[rests[1:-1]]
    if len(inside) > 2:
        return float(np.sqrt(np.median(inside) / (6.0 * _SQUARES)))
    return float(np.sqrt(np.quantile(squares, 0.25) / (6.0 * _LOW_SQUARES)))

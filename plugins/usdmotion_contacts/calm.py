"""When an object rests, how fast it moves when it does not, and how much of that is noise."""

import math
from dataclasses import dataclass

import numpy as np

from usdmotion import Bools, Floats
from usdmotion.kernels import kernel

SHORTEST_WINDOW, LONGEST_WINDOW = 0.2, 0.4
"""Over how long a drift is measured [s]: longer than a turn of the way, shorter than a step."""
SLOW = 0.1
"""What drifts by less rests, where nothing else tells [m/s]."""
STANDSTILL = 1e-3
"""Drifts slower than this are all the same: a frozen frame is no third mode [m/s]."""
TWO_MODES, TIMES_AS_FAST = 3.2, 4.0
"""Ashman's D of two modes that are two, the halves of one normal distribution having 2.65; and how
far apart they are."""
SHORTEST_STEP, LONGEST_STEP = 0.02, 0.16
"""What displacements may span [s]: in less, a slow object moves less than it seems to by noise; in
more, there is little left of a short rest."""
CLEAR = 8.0
"""A step is clear of noise if the object goes so many times farther than it seems to at rest."""
SQUARES = 2.366
"""Median of the sum of three squared standard normal numbers."""
_LOW_SQUARES = 1.2125
"""Its lower quartile."""


@dataclass(frozen=True, eq=False)
class Calm:
    """How an object moves as a whole."""

    rests: Bools
    """The frames on which it does not go anywhere, shape (frame_count,)."""
    slow: float
    """What drifts by less rests [m/s]."""
    usual: float
    """How fast it goes when it goes [m/s], the geometric mean."""
    noise: float
    """Standard deviation along each axis of what differs from frame to frame [m]."""

    @classmethod
    def of(cls, times: Floats, translations: Floats) -> "Calm":
        """Look at an object.

        Its drift over a fifth of a second, or over up to two where there is much noise, has hardly
        any noise in it: that goes no farther with time. Single outliers are left out. Drifts of
        something that now rests and now moves have two modes, whose logarithms are parted where
        the classes are farthest from each other (Otsu 1979). With one mode only it rests
        where it is slower than `SLOW`: always, never, or now and then in a dance.

        Args:
            times: Ascending [s], shape (frame_count,).
            translations: World positions of its origin [m], shape (frame_count, 3).
        """
        if not len(times):
            return cls(np.zeros(0, dtype=np.bool_), 0.0, 0.0, 0.0)
        window, seeming = _window(times, _noise(translations, np.zeros(len(times), dtype=np.bool_)))
        drifts = _drifts(times, _without_spikes(translations), window)
        slow, usual = _parted(np.log(np.maximum(drifts, STANDSTILL)), math.hypot(SLOW, seeming))
        rests = np.asarray(drifts <= slow)
        return cls(rests, slow, usual, _noise(translations, rests))

    @property
    def clear(self) -> float:
        """In what time it usually goes far beyond what noise alone makes of a rest [s]."""
        return CLEAR * math.sqrt(2.0 * SQUARES) * self.noise / max(self.usual, STANDSTILL)

    def step(self, interval: float) -> float:
        """Return how long the displacements of it had better be [s].

        As short as noise allows, so that the ends of rests are sharp. Of an object that never rests
        nobody knows what is noise.

        Args:
            interval: Usual time between two samples [s], which is the least.
        """
        clear = self.clear if self.rests.any() else 0.0
        return max(interval, min(max(clear, SHORTEST_STEP), LONGEST_STEP))


def _without_spikes(places: Floats) -> Floats:
    """Return the running geometric median of three, (F, 3) to (F, 3).

    That is the place with the least sum of distances to them, their Fermat point: one of them where
    their triangle has 120° or more. A median along each axis depends on how the world is turned.
    """
    if len(places) < 3:
        return places
    three = np.stack([places[:-2], places[1:-1], places[2:]])
    one, other = three[[1, 2, 0]] - three, three[[2, 0, 1]] - three
    angles = np.arctan2(np.linalg.norm(np.cross(one, other), axis=2), np.sum(one * other, axis=2))
    wide = angles >= np.radians(120.0)
    across = np.linalg.norm(one - other, axis=2)
    shares = np.where(wide.any(axis=0), wide, across / np.sin(angles + np.radians(60.0)))
    total = shares.sum(axis=0)
    middle = three[1] + np.divide(
        np.sum(shares[..., None] * (three - three[1]), axis=0),
        total[:, None],
        out=np.zeros_like(three[1]),
        where=total[:, None] > 0.0,
    )
    return np.concatenate([middle[:1], middle, middle[-1:]])


def _window(times: Floats, noise: float) -> tuple[float, float]:
    """Return over how long to measure drifts [s], and what noise alone makes of them [m/s].

    The variance of a slope over n even samples is that of one sample by the sum of the squares of
    their times from the middle, which is about window³ / 12 intervals.
    """
    interval = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    square = 12.0 * interval * SQUARES * noise**2
    window = min(max((square / SLOW**2) ** (1.0 / 3.0), SHORTEST_WINDOW), LONGEST_WINDOW)
    window = max(window, 2.0 * interval)
    return window, math.sqrt(square / window**3)


def _drifts(times: Floats, places: Floats, window: float) -> Floats:
    """Return the speeds of the straight ways that fit best around each frame [m/s], (F,)."""
    drifts = np.zeros(len(times))
    _drift(times, places, 0.5 * window + 1e-6, drifts)
    return drifts


@kernel
def _drift(times: Floats, places: Floats, half: float, drifts: Floats) -> None:
    """(F,), (F, 3) into (F,): the slopes of regressions over windows of time."""
    count = times.shape[0]
    first = end = 0
    for frame in range(count):
        while times[first] < times[frame] - half:
            first += 1
        while end < count and times[end] <= times[frame] + half:
            end += 1
        middle = 0.0
        for i in range(first, end):
            middle += (times[i] - times[frame]) / (end - first)
        spread = x = y = z = 0.0
        for i in range(first, end):
            since = times[i] - times[frame] - middle
            spread += since * since
            # From the frame itself, so that it is as exact far from the origin.
            x += since * (places[i, 0] - places[frame, 0])
            y += since * (places[i, 1] - places[frame, 1])
            z += since * (places[i, 2] - places[frame, 2])
        if spread > 0.0:
            drifts[frame] = math.sqrt(x * x + y * y + z * z) / spread


def _parted(logarithms: Floats, otherwise: float) -> tuple[float, float]:
    """Return the speed below which an object rests, and the usual one above it [m/s].

    Args:
        logarithms: Of its drifts, shape (frame_count,).
        otherwise: What drifts by less rests if there is one mode only [m/s].
    """
    ascending = np.sort(logarithms)
    total, limit = len(ascending), math.log(otherwise)
    moving = ascending[ascending > limit] if ascending[-1] > limit else ascending
    one_mode = otherwise, math.exp(moving.mean())
    if total < 2:
        return one_mode
    sums = np.cumsum(ascending)
    counts = np.arange(1, total)
    low, high = sums[:-1] / counts, (sums[-1] - sums[:-1]) / (total - counts)
    best = int(np.argmax(counts * (total - counts) * (high - low) ** 2))
    widths = math.hypot(ascending[: best + 1].std(), ascending[best + 1 :].std())
    apart = float(high[best] - low[best])
    if math.sqrt(2.0) * apart <= TWO_MODES * widths or apart <= math.log(TIMES_AS_FAST):
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
        return float(np.sqrt(np.median(inside) / (6.0 * SQUARES)))
    return float(np.sqrt(np.quantile(squares, 0.25) / (6.0 * _LOW_SQUARES)))

"""What of a template is noise: least median of squares, and the maximum of the rest."""

import numpy as np

from usdmotion import Bools, Floats
from usdmotion.kernels import kernel, shared

NUMERICAL_SIGMA = 1e-6
"""Standard deviation of σ3 that single precision alone gives."""
NUMERICAL_EPSILON = 1e-6
"""The same of ε, of something a few metres from the origin [m]."""
FAR = 2.5
"""Outliers are farther from the rest than so many standard deviations."""

EQUAL = 1e-6
"""A limit is by this share more than what set it: that meets it wherever in the world it is."""


def without_outliers(values: Floats, floor: float) -> Bools:
    """Return which values do not deviate from the others (2006, section 6.1).

    Every value is tried as the one that stands for all, and the one with the least median M of
    squared residuals does. The robust standard deviation is 1.4826 (1 + 5 / (N − 1)) √M. It is at
    least `floor`: most of a template may be equal to the last bit. What is beyond 2.5 of it
    strictly is out. Of fewer than three values nobody knows, and all stay.
    """
    if len(values) < 3:
        return np.ones(len(values), dtype=np.bool_)
    ascending = np.sort(values)
    medians = np.empty(len(values))
    _squared_medians(ascending, medians)
    best = int(np.argmin(medians))
    deviation = 1.4826 * (1.0 + 5.0 / (len(values) - 1)) * np.sqrt(medians[best])
    kept: Bools = np.abs(values - ascending[best]) <= FAR * max(deviation, floor)
    return kept


def largest_noise(values: Floats, floor: float) -> float:
    """Return the largest value that is no outlier, as a limit that this value meets.

    It is never less than what is numerical noise. Where a motion is moved or turned as a whole the
    last bits of all values change: a limit without slack would be met here, and not there.
    """
    largest = float(values[without_outliers(values, floor)].max(initial=0.0))
    return (1.0 + EQUAL) * max(largest, FAR * floor)


@kernel
def _squared_medians(values: Floats, medians: Floats) -> None:
    """(N,) ascending into (N,): of the squared residuals to each of them."""
    count = values.shape[0]
    for i in range(count):
        low = _reach(values, i, (count + 1) // 2)
        high = _reach(values, i, count // 2 + 1)
        medians[i] = 0.5 * (low * low + high * high)


@shared
def _reach(values: Floats, i: int, count: int) -> float:
    """Return the distance within which so many values are of the i-th, itself included.

    They are neighbours in a sorted row; as it shifts to the right its left end comes nearer and its
    right end goes farther, so the best place of it is where these two meet.
    """
    low, high = max(0, i - count + 1), min(i, values.shape[0] - count)
    while low < high:
        middle = (low + high) // 2
        if values[middle + count - 1] - values[i] >= values[i] - values[middle]:
            high = middle
        else:
            low = middle + 1
    reach: float = max(values[i] - values[low], values[low + count - 1] - values[i])
    if low > max(0, i - count + 1):
        before = low - 1
        reach = min(reach, max(values[i] - values[before], values[before + count - 1] - values[i]))
    return reach

"""Curves over time that constraints are made of."""

import numpy as np

from usdmotion.arrays import Floats


def ease(times: Floats, keys: tuple[float, ...]) -> Floats:
    """Return the cubic activity profile of up to four key times.

    It rises as 3s² − 2s³ over t0..t1, is 1 over t1..t2 and falls over t2..t3 (2003, figure 4).
    Two keys t0 t1 are an interval without easing; no keys mean 1 throughout. Intervals are closed,
    and a sample within 1 µs of an end is inside.

    Args:
        times: Seconds, shape (frame_count,).
        keys: Ascending key times in seconds; 0, 2 or 4 of them.

    Returns:
        Activities in 0..1, shape (frame_count,).
    """
    if not keys:
        return np.ones_like(times)
    t0, t1, t2, t3 = keys if len(keys) == 4 else (keys[0], keys[0], keys[1], keys[1])
    return _rise(times, t0, t1) * _rise(-times, -t3, -t2)


def _rise(times: Floats, start: float, end: float) -> Floats:
    slack = 1e-6
    s = np.clip((times - start) / max(end - start, slack), 0.0, 1.0)
    s = np.where(times >= end - slack, 1.0, s)
    return np.asarray(3.0 * s**2 - 2.0 * s**3)

"""Curves over time that constraints are made of."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats, seal

SLACK = 1e-6
"""How far a sample may be beside the end of an interval that it counts to [s]."""


@dataclass(frozen=True, eq=False)
class Spline:
    """A cubic spline over time, held flat outside its knots."""

    times: Floats
    """Time of each knot [s], ascending, at least one, shape (knot_count,)."""
    values: Floats
    """Value at each knot, shape (knot_count,)."""
    slopes: Floats
    """Derivative at each knot [1/s], shape (knot_count,)."""

    def __post_init__(self) -> None:
        for name in ("times", "values", "slopes"):
            array = seal(getattr(self, name), len(self.times), name=name)
            object.__setattr__(self, name, array)

    @classmethod
    def through(cls, times: Floats, values: Floats) -> "Spline":
        """Return the spline through some values that rises and falls only where they do.

        So it stays between neighbouring values, and never falls below zero where they do not. The
        slope at a knot is the weighted harmonic mean of those beside it (Fritsch and Butland 1984),
        and zero at the ends.
        """
        gaps = np.diff(times)
        rises = np.diff(values) / gaps
        before, after = 2.0 * gaps[1:] + gaps[:-1], gaps[1:] + 2.0 * gaps[:-1]
        turns = rises[:-1] * rises[1:] <= 0.0
        left, right = (np.where(turns, 1.0, each) for each in (rises[:-1], rises[1:]))
        mean = (before + after) / (before / left + after / right)
        return cls(times, values, np.pad(np.where(turns, 0.0, mean), 1)[: len(times)])

    def at(self, times: Floats) -> Floats:
        """Return its values at some times [s], of the shape of those."""
        inside = np.clip(times, self.times[0], self.times[-1])
        if len(self.times) == 1:
            return np.full(np.shape(times), self.values[0])
        knot = np.clip(np.searchsorted(self.times, inside, "right") - 1, 0, len(self.times) - 2)
        length = self.times[knot + 1] - self.times[knot]
        s = (inside - self.times[knot]) / length
        values, slopes = self.values, self.slopes
        return _hermite(
            s, length, (values[knot], values[knot + 1]), (slopes[knot], slopes[knot + 1])
        )


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


def between(times: Floats, keys: tuple[float, ...]) -> slice:
    """Return the frames on which `ease` is not 0, without a look at the others; none may be."""
    if not keys:
        return slice(0, len(times))
    start = int(np.searchsorted(times, keys[0] - SLACK, side="left"))
    stop = int(np.searchsorted(times, keys[-1] + SLACK, side="right"))
    return slice(start, max(start, stop))


def plateau(keys: Sequence[float], span: tuple[float, float]) -> tuple[float, float]:
    """Return the first and the last time at which `ease` is 1.

    Args:
        keys: Ascending key times; 0, 2 or 4 of them.
        span: The first and the last time that there is, which no keys mean.
    """
    if not keys:
        return span
    return (keys[1], keys[2]) if len(keys) == 4 else (keys[0], keys[1])


def _rise(times: Floats, start: float, end: float) -> Floats:
    s = np.clip((times - start) / max(end - start, SLACK), 0.0, 1.0)
    s = np.where(times >= end - SLACK, 1.0, s)
    return np.asarray(3.0 * s**2 - 2.0 * s**3)


def time_curve(times: Floats, keys: Floats, releases: Floats) -> tuple[Floats, Floats]:
    """Return T(t), and the parameter u of each control point (2004, section 4.2).

    T rises with slope 1 from key to key and rests between a key and its release, so that u is in
    seconds and the speed along the curve is that of the clock.

    Args:
        times: Where T is wanted [s], shape (frame_count,), inside the keys.
        keys: When each control point is reached [s], ascending, shape (point_count,).
        releases: When it is left again [s], none before its key, shape (point_count,).
    """
    knots = np.concatenate([[0.0], np.cumsum(keys[1:] - releases[:-1])])
    corners = np.stack([keys, releases], axis=1).ravel()
    return np.interp(times, corners, np.repeat(knots, 2)), knots


def kochanek_bartels(
    u: Floats,
    knots: Floats,
    points: Floats,
    shape: Floats,
    velocities: tuple[Floats, Floats],
) -> Floats:
    """Return S(u), a spline through points (Kochanek and Bartels 1984) over uneven knots.

    Differences of neighbouring points become divided differences, weighted as in the parabola
    through three points: with tension, continuity and bias 0 the velocity is continuous however
    uneven the knots are, and with even knots this is the spline of the paper.

    Args:
        u: Parameters, shape (frame_count,).
        knots: Parameter of each control point, ascending, shape (point_count,).
        points: Control points, shape (point_count, 3).
        shape: Tension, continuity and bias of each, shape (point_count, 3).
        velocities: Derivative at the first and at the last control point, each of shape (3,).

    Returns:
        Points of the curve, shape (frame_count, 3).
    """
    arriving, leaving = _tangents(knots, points, shape)
    leaving[0], arriving[-1] = velocities
    span = np.clip(np.searchsorted(knots, u, side="right") - 1, 0, len(knots) - 2)
    length = (knots[span + 1] - knots[span])[:, None]
    s = (u - knots[span])[:, None] / length
    ends, slopes = (points[span], points[span + 1]), (leaving[span], arriving[span + 1])
    return _hermite(s, length, ends, slopes)


def _hermite(
    s: Floats, length: Floats, ends: tuple[Floats, Floats], slopes: tuple[Floats, Floats]
) -> Floats:
    """Return cubics at a share s of their spans, from values and slopes at both ends of them."""
    return np.asarray(
        (1.0 + s * s * (2.0 * s - 3.0)) * ends[0]
        + s * s * (3.0 - 2.0 * s) * ends[1]
        + s * (1.0 - s) ** 2 * length * slopes[0]
        + s * s * (s - 1.0) * length * slopes[1]
    )


def _tangents(knots: Floats, points: Floats, shape: Floats) -> tuple[Floats, Floats]:
    """Return the derivatives with which each point is reached and left; zero at both ends."""
    arriving, leaving = np.zeros_like(points), np.zeros_like(points)
    steps = np.diff(knots)[:, None]
    slopes = np.diff(points, axis=0) / steps
    before, after = steps[:-1], steps[1:]
    back = after / (before + after) * slopes[:-1]
    forth = before / (before + after) * slopes[1:]
    tension, continuity, bias = np.hsplit(shape[1:-1], 3)
    arriving[1:-1] = (1.0 - tension) * (
        (1.0 - continuity) * (1.0 + bias) * back + (1.0 + continuity) * (1.0 - bias) * forth
    )
    leaving[1:-1] = (1.0 - tension) * (
        (1.0 + continuity) * (1.0 + bias) * back + (1.0 - continuity) * (1.0 - bias) * forth
    )
    return arriving, leaving

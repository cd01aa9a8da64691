"""How a motion comes to where it is held, and goes on from there, while a contact eases."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.curves import SLACK
from usdmotion.kernels import conjugate, from_vector, multiply, slerp, to_vector

FASTEST = 1.0
"""Nothing that is held a moment later goes faster than this [m/s]."""
FASTEST_TURN = 6.0
"""Nor does it turn faster [rad/s]."""


def gone(times: Floats, keys: tuple[float, ...], places: Floats) -> Floats:
    """Return how far a point may be from where a contact holds it.

    While the contact eases that is as far as the motion itself is from where it is at that end of
    the contact, but for what makes it come to rest there, or set off from rest.

    Args:
        times: Ascending [s], shape (frame_count,).
        keys: Key times of the contact's easing [s]; between the second and third it holds.
        places: Where the point is in the motion [m], shape (frame_count, 3).

    Returns:
        Shape (frame_count, 3); nothing while it holds, or where it does not ease.
    """
    far = np.zeros_like(places)
    for far_end, end, beside in _ends(times, keys):
        before, after, share = _between(times, end, far_end)
        step = places[after] - places[before]
        gap = times[after] - times[before]
        lag = _lag(times[beside], far_end, end, gap) * _share(step, gap, FASTEST)
        far[beside] = places[beside] - places[before] - share * step + lag[:, None] * step
    return far


def turned(times: Floats, keys: tuple[float, ...], turns: Floats) -> Floats:
    """Return by what a frame may be turned from how a contact holds it, as `gone` does for points.

    Args:
        times: Ascending [s], shape (frame_count,).
        keys: Key times of the contact's easing [s]; between the second and third it holds.
        turns: Its orientations in the motion, xyzw, shape (frame_count, 4).

    Returns:
        Rotations in the frame itself, shape (frame_count, 4); none while it holds, or where it
        does not ease.
    """
    away = np.zeros_like(turns)
    away[:, 3] = 1.0
    for far_end, end, beside in _ends(times, keys):
        before, after, share = _between(times, end, far_end)
        there = slerp(turns[before], turns[after], np.asarray(share))
        back = np.broadcast_to(conjugate(there), turns[beside].shape)
        step = to_vector(multiply(conjugate(turns[before]), turns[after]))
        gap = times[after] - times[before]
        lag = _lag(times[beside], far_end, end, gap) * _share(step, gap, FASTEST_TURN)
        away[beside] = multiply(from_vector(lag[:, None] * step), multiply(back, turns[beside]))
    return away


def _lag(times: Floats, far_end: float, end: float, gap: float) -> Floats:
    """Return what of a step between two samples makes a motion come to rest at an end.

    It is nothing at both ends of the ease, and its slope is that of the step at the one only: the
    Hermite cubic s² (1 − s).
    """
    if gap <= 0.0 or abs(end - far_end) < SLACK:
        return np.zeros_like(times)
    s = np.clip((times - far_end) / (end - far_end), 0.0, 1.0)
    return np.asarray(s * s * (1.0 - s) * (end - far_end) / gap)


def _share(step: Floats, gap: float, fastest: float) -> float:
    """Return how much of a step is believed: a jump of the motion is nothing to slow down from."""
    return min(1.0, fastest * gap / max(float(np.linalg.norm(step)), 1e-12))


def _ends(times: Floats, keys: tuple[float, ...]) -> list[tuple[float, float, slice]]:
    """Return the eases of a contact: the time at which it is off, and on; the frames beside."""
    if len(keys) < 4:
        return []
    first = int(np.searchsorted(times, keys[1] - SLACK, side="left"))
    last = int(np.searchsorted(times, keys[2] + SLACK, side="right"))
    return [
        (keys[0], keys[1], slice(0, first)),
        (keys[3], keys[2], slice(last, len(times))),
    ]


def _between(times: Floats, end: float, outside: float) -> tuple[int, int, float]:
    """Return the samples about an end, and how far it is from one to the other.

    Where a sample is at the end, the other one is outside of the contact.
    """
    if len(times) < 2:
        return 0, 0, 0.0
    if outside < end:
        after = int(np.searchsorted(times, end - SLACK, side="left"))
    else:
        after = int(np.searchsorted(times, end + SLACK, side="right"))
    after = min(max(after, 1), len(times) - 1)
    share = (end - times[after - 1]) / (times[after] - times[after - 1])
    return after - 1, after, float(np.clip(share, 0.0, 1.0))

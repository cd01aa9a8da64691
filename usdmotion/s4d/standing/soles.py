"""Soles on the ground: how high it is under a standing foot, and how the foot lies on it."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.ground import Ground
from usdmotion.s4d.turns import swing, unit

_SAMPLES = 7
"""How many places along a sole the ground is looked at."""
_GIVES = 0.01
"""How far the ground may stand into the middle of a sole [m]: flesh and shoes give way."""
_MOST = 0.7
"""Over an edge a sole lies on the higher side, unless so much of it is over the lower one."""
_HALF_WIDTH = 0.035
"""Half the width of a sole [m]."""
_STEEPEST = np.tan(np.radians(40.0))
"""A sole lies no steeper than this along the foot; what is steeper under it is an edge."""
_TILT = np.tan(np.radians(25.0))
"""And no steeper than this across it."""


@dataclass(frozen=True)
class Sole:
    """The underside of a foot, seen from the joint that it stands on."""

    back: float
    """How far behind that joint it ends [m]."""
    front: float
    """How far before it [m]."""

    def places(self) -> Floats:
        """Return how far ahead of the joint the ground is looked at [m], the joint itself first."""
        ends = np.linspace(-self.back, self.front, _SAMPLES)
        return np.concatenate([[0.0], ends[np.abs(ends) > 1e-3]])


class Lie(NamedTuple):
    """How a foot lies on the ground."""

    heights: Floats
    """Of the ground under the joint that it stands on [m], shape (frame_count,), not a number where
    there is none."""
    turns: Floats
    """What turns what is level onto it, xyzw, shape (frame_count, 4)."""


def lie(
    ground: Ground, places: Floats, heading: Floats, sole: Sole, times: Floats, up: Floats
) -> Lie:
    """Return how a foot lies on the ground at some places.

    Its sole is a line along the foot that rests on the ground at both ends, and on what stands
    higher between them: over the edge of a step it stays level. Across, it is as steep as the
    ground is.

    Args:
        ground: The ground.
        places: The contact under the joint that it stands on, as high as the foot knows [m], shape
            (frame_count, 3).
        heading: Where the foot points along the ground, shape (frame_count, 3).
        sole: The underside of the foot.
        times: Seconds of the frames, shape (frame_count,).
        up: The direction away from the ground, shape (3,).
    """
    aside = np.cross(up, heading)  # to its left, seen along its heading
    ahead = sole.places()
    line = places[:, None] + ahead[:, None] * heading[:, None]  # (F, S, 3)
    side = _HALF_WIDTH * aside[:, None]
    points = np.concatenate([line, line + side, line - side], axis=1)
    heights, _ = ground.under(points, times)
    middle, left, right = np.split(heights, 3, axis=1)
    along, higher = _along(middle, ahead)
    aslant = _across(left, right)
    normal = np.cross(heading + along[:, None] * up, aside + aslant[:, None] * up)
    return Lie(middle[:, 0] + higher, swing(up, unit(normal)))


def _along(heights: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """Return the slope of a sole along the foot, and how much higher it lies than one of its ends.

    That is where most of it is over something higher, as a heel on the edge of a step that its ball
    is beyond. Shapes (F, S), (S,) to (F,), (F,).
    """
    rises = np.nan_to_num(heights - heights[:, :1], nan=-1.0)  # beside the ground it falls away
    back, front = ahead.argmin(), ahead.argmax()
    chord = (rises[:, front] - rises[:, back]) / (ahead[front] - ahead[back])
    chord = np.where(np.abs(chord) < _STEEPEST, chord, 0.0)
    ways = ahead[1:]
    bounds = rises[:, 1:] / ways
    # What would have to be climbed steeper than that is a wall beside the foot.
    lowest = np.where((ways > 0.0) & (bounds < _STEEPEST), bounds, -_STEEPEST).max(axis=1)
    highest = np.where((ways < 0.0) & (bounds > -_STEEPEST), bounds, _STEEPEST).min(axis=1)
    resting = np.clip(chord, lowest, np.maximum(lowest, highest))
    inside = (rises - chord[:, None] * ahead).max(axis=1)
    slope = chord + _given_way(inside) * (resting - chord)
    most = np.quantile(rises - slope[:, None] * ahead, _MOST, axis=1)
    return slope, _given_way(most) * most


def _given_way(inside: Floats) -> Floats:
    """Return 0 where a sole gives way to what stands into it, 1 where it cannot."""
    share = np.clip(inside / _GIVES - 1.0, 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _across(left: Floats, right: Floats) -> Floats:
    """Return the slope of a sole to its left, from heights along both edges, (F, S) to (F,)."""
    slopes = (left - right) / (2.0 * _HALF_WIDTH)
    edge = ~(np.abs(slopes) < 1.0)
    slopes = np.sort(np.where(edge, np.inf, slopes), axis=1)
    middle = np.maximum(np.isfinite(slopes).sum(axis=1) - 1, 0) // 2
    found = slopes[np.arange(len(slopes)), middle]
    return np.clip(np.where(np.isfinite(found), found, 0.0), -_TILT, _TILT)

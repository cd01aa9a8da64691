"""The way of an ankle through a whole cycle: planted, rolling off, swung to the next place.

In swing the leg follows the curves. Where it leaves the ground and where it meets it, the planted
leg differs from them by a few degrees, and that difference fades within a part of the swing.
Lengths are fractions of the body's height, phases those of the leg itself; its heel stands at
z = 0 in the cycle that begins with phase 0, and a stride further in each one after it.
"""

from functools import cache

import numpy as np
from scipy.interpolate import BPoly

from usdmotion.arrays import Floats
from usdmotion.demos.gait.curves import leg_angles
from usdmotion.demos.gait.pelvis import (
    HALF_STEP_WIDTH,
    hip_position,
    leg_lengths,
    leg_reach,
    pelvis_ride,
)
from usdmotion.demos.gait.stance import (
    FOOT_FLAT,
    HEEL_STRIKE,
    TOE_OFF,
    TOE_OUT,
    ankle_on_ground,
)

_FADE_OUT, _FADE_IN = 0.11, 0.05
"""How long the planted leg is felt after toe-off and before the strike, in cycles."""
_STEP = 1e-3
"""Of the differences that stand for derivatives by the phase."""


def ankle_position(phase: Floats) -> Floats:
    """(…) to (…, 3): where the left ankle is."""
    cycle = np.floor(phase - HEEL_STRIKE)
    within = phase - cycle
    on_ground = (within <= TOE_OFF)[..., None]
    position = np.where(on_ground, _planted(within), _swung(np.maximum(within, TOE_OFF)))
    position[..., 2] += pelvis_ride().stride * cycle
    return position


def _planted(phase: Floats, order: int = 0) -> Floats:
    """(…) to (…, 3): the left ankle over its planted foot, or a derivative by the phase."""
    flat = 0.0 if order else ankle_on_ground(np.array(FOOT_FLAT))[1]
    up_ahead = ankle_on_ground(phase, order)
    ahead = up_ahead[..., 1] - flat
    sine, cosine = np.sin(np.radians(TOE_OUT)), np.cos(np.radians(TOE_OUT))
    aside = 0.0 if order else HALF_STEP_WIDTH
    return np.stack([aside + sine * ahead, up_ahead[..., 0], flat + cosine * ahead], axis=-1)


def _swung(phase: Floats) -> Floats:
    """(…) to (…, 3): the left ankle in swing, from its hip and the angles of its leg."""
    knee, lean = np.moveaxis(_free_angles(phase) + _correction(phase), -1, 0)
    hip = hip_position(phase, 1)
    x = _aside()(phase)
    upper, lower = leg_lengths()
    square = upper**2 + lower**2 + 2.0 * upper * lower * np.cos(knee) - (x - hip[..., 0]) ** 2
    reach = np.sqrt(square)
    return np.stack(
        [x, hip[..., 1] - reach * np.cos(lean), hip[..., 2] + reach * np.sin(lean)], axis=-1
    )


def _free_angles(phase: Floats) -> Floats:
    """(…) to (…, 2): flexion of the knee and lean of the whole leg in the curves [rad]."""
    angles = leg_angles(phase)
    down, ahead = np.moveaxis(leg_reach(angles), -1, 0)
    return np.stack([np.radians(angles.knee), np.arctan2(ahead, down)], axis=-1)


def _planted_angles(phase: Floats) -> Floats:
    """(…) to (…, 2): the same of the leg on its planted foot."""
    way = _planted(phase) - hip_position(phase, 1)
    upper, lower = leg_lengths()
    square = np.sum(way**2, axis=-1)
    knee = np.arccos((square - upper**2 - lower**2) / (2.0 * upper * lower))
    return np.stack([knee, np.arctan2(way[..., 2], -way[..., 1])], axis=-1)


def _correction(phase: Floats) -> Floats:
    """(…) to (…, 2): what the swinging leg adds to the curves [rad]."""
    leaving, meeting = _corrections()
    after = np.where((phase < TOE_OFF + _FADE_OUT)[..., None], leaving(phase), 0.0)
    before = np.where((phase > 1.0 + HEEL_STRIKE - _FADE_IN)[..., None], meeting(phase), 0.0)
    return after + before


@cache
def _corrections() -> tuple[BPoly, BPoly]:
    """Return the fading differences of planted and free leg after toe-off and before the strike."""
    still = np.zeros((3, 2))
    strike = 1.0 + HEEL_STRIKE
    leaving = BPoly.from_derivatives([TOE_OFF, TOE_OFF + _FADE_OUT], [_difference(TOE_OFF), still])
    meeting = BPoly.from_derivatives([strike - _FADE_IN, strike], [still, _difference(HEEL_STRIKE)])
    return leaving, meeting


def _difference(phase: float) -> Floats:
    """Return planted less free angles, and their derivatives by the phase, shape (3, 2)."""
    around = phase + _STEP * np.array((-1.0, 0.0, 1.0))
    before, here, after = _planted_angles(around) - _free_angles(around)
    rate, change = (after - before) / (2.0 * _STEP), (after - 2.0 * here + before) / _STEP**2
    return np.stack([here, rate, change])


@cache
def _aside() -> BPoly:
    """Return x of the swinging ankle, from one planted foot to the next."""
    ends = [TOE_OFF, 1.0 + HEEL_STRIKE]
    planted = np.array([TOE_OFF, HEEL_STRIKE])
    derivatives = np.stack([_planted(planted, order)[:, 0] for order in range(3)], axis=-1)
    return BPoly.from_derivatives(ends, derivatives)

"""The foot on the ground: it strikes with the heel, lies flat, and rolls off over the ball.

Lengths are fractions of the body's height. A foot's own place is where its heel struck.
"""

from functools import cache

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid, sole
from usdmotion.demos.gait.curves import leg_angles

# Perry & Burnfield 2010 let the foot lie flat from 12 % of the cycle to 31 % and leave the ground
# at 62 %; in the curves it is flat, within 2 degrees, from 8 to 30 %. The heel touches at 0, and at
# 3 % it has come to rest: it does not stop dead in life either, and a knee that is all but straight
# would have to jump for it. The toes leave where the curves' foot turns fastest: held any longer,
# they would hold the ankle back.
HEEL_STRIKE = 0.03
"""Phase from which the heel stands still."""
FOOT_FLAT = 0.10
"""Phase from which the ball of the foot stands still."""
HEEL_OFF = 0.31
"""Phase until which the heel stands still."""
TOE_OFF = 0.58
"""Phase until which the ball of the foot stands still."""
TOE_OUT = 6.0
"""How far a foot points outwards [degrees]; Schwartz et al. have 5, Murray et al. 1964 have 7."""
_BALL = "Hips/LeftUpLeg/LeftLeg/LeftFoot/LeftToeBase"
_SOFT_FOOT = 3.0
"""How far the curves' stiff foot seems to have turned while the real one is flat [degrees]."""
_TOE_PHASES = (0.66, 0.72, 0.78, 0.84, 0.90, 0.96)
_TOE_ANGLES = (48.0, 30.0, 22.0, 14.0, 6.0, 1.0)


def pitch(phase: Floats, order: int = 0) -> Floats:
    """Return how far the foot's tip points up [rad], or a derivative of it by the phase."""
    phase = np.mod(phase, 1.0)
    since_heel_off = np.where(phase < FOOT_FLAT, phase + 1.0, np.maximum(phase, HEEL_OFF))
    flat = (phase >= FOOT_FLAT) & (phase <= HEEL_OFF)
    return np.where(flat, 0.0, _pitch_spline()(since_heel_off, nu=order))


def toe_pitch(phase: Floats) -> Floats:
    """Return how far the toes point up [rad]: flat on the ground, lifted clear of it in swing."""
    phase = np.mod(phase, 1.0)
    within = np.where(phase < HEEL_STRIKE, phase + 1.0, phase)
    swung = pitch(within) + _toe_spline()(np.maximum(within, TOE_OFF))
    flat = (phase >= FOOT_FLAT) & (phase <= TOE_OFF)
    striking = (phase >= HEEL_STRIKE) & (phase < FOOT_FLAT)
    return np.where(flat, 0.0, np.where(striking, pitch(phase), swung))


def ankle_on_ground(phase: Floats, order: int = 0) -> Floats:
    """(…) to (…, 2): height and way ahead of the ankle in stance, or a derivative by the phase.

    The foot turns about its heel until it is flat, and about the toe joint from then on.
    """
    skeleton, _, _ = humanoid(1.0)
    to_ball = skeleton.rest_translations[skeleton.index[_BALL]][1:]
    to_heel = sole(1.0).heel[1:]
    on_heel = (np.asarray(phase) < FOOT_FLAT)[..., None]
    pivot_to_ankle = np.where(on_heel, -to_heel, -to_ball)
    turned = _turn(pivot_to_ankle, phase, order)
    return turned if order else turned + np.where(on_heel, 0.0, to_ball - to_heel)


def _turn(vector: Floats, phase: Floats, order: int) -> Floats:
    """(…, 2), (…) to (…, 2): a vector of the foot (up, ahead), turned by the pitch."""
    angle, rate, change = (pitch(phase, n)[..., None] for n in range(3))
    up, ahead = vector[..., :1], vector[..., 1:]
    sine, cosine = np.sin(angle), np.cos(angle)
    turned = np.concatenate([cosine * up + sine * ahead, cosine * ahead - sine * up], axis=-1)
    across = np.concatenate([cosine * ahead - sine * up, -cosine * up - sine * ahead], axis=-1)
    return (turned, rate * across, change * across - rate**2 * turned)[order]


def _smooth_step(phase: Floats, start: float, end: float) -> Floats:
    """Return 0 before start, 1 after end, and between them a rise with two smooth derivatives."""
    s = np.clip((phase - start) / (end - start), 0.0, 1.0)
    return s**3 * (10.0 - 15.0 * s + 6.0 * s**2)


@cache
def _pitch_spline() -> BSpline:
    """Return the foot's pitch from heel-off to the next foot-flat, at rest at both ends."""
    phases = np.arange(0.44, 1.03, 0.04)
    angles = leg_angles(phases)
    given = _SOFT_FOOT * (1.0 - _smooth_step(phases, 0.48, 0.62))
    curve = np.radians(angles.thigh - angles.knee + angles.ankle + given)
    at_rest = [(1, 0.0), (2, 0.0)]
    return make_interp_spline(
        np.array([HEEL_OFF, *phases, 1.0 + FOOT_FLAT]),
        np.array([0.0, *curve, 0.0]),
        k=5,
        bc_type=(at_rest, at_rest),
    )


@cache
def _toe_spline() -> BSpline:
    """Return how far the toes are bent up against the foot in swing [rad].

    By eye: as flat on the ground at toe-off, less in swing, but so that their tips clear it.
    """
    leaving = np.array(TOE_OFF)
    start = [(order, float(-pitch(leaving, order))) for order in (1, 2)]
    return make_interp_spline(
        np.array([TOE_OFF, *_TOE_PHASES, 1.0 + HEEL_STRIKE]),
        np.array([-pitch(leaving), *np.radians(_TOE_ANGLES), 0.0]),
        k=5,
        bc_type=(start, [(1, 0.0), (2, 0.0)]),
    )

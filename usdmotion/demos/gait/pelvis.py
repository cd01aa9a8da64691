"""The way of the pelvis: it rides on the leg that carries the body.

The planted foot and the angles of its leg say where the hip joint is, hence where the pelvis is.
A few harmonics of a step are fitted to that over the whole of stance, so where both feet are down
they are as true to both legs as can be. Lengths are fractions of the body's height, phases are
those of the left leg, and the left heel strikes at z = 0 in phase 0.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid
from usdmotion.demos.gait.curves import LegAngles, leg_angles, pelvis_angles
from usdmotion.demos.gait.stance import HEEL_STRIKE, TOE_OFF, ankle_on_ground
from usdmotion.kernels import from_vector, multiply, rotate

HALF_STEP_WIDTH = 0.027
"""How far a standing ankle is from the middle: 0.09 m apart, Murray et al. 1964 have 0.08."""
SWAY = 0.0125
"""How far the pelvis goes to a standing leg: 0.043 m in all; Saunders et al. 1953: 0.044."""
_SWAY_PEAK = 0.30
_HARMONICS = 3
_SAMPLES = 100
_HIP = "Hips/LeftUpLeg"
_KNEE = "Hips/LeftUpLeg/LeftLeg"
_ANKLE = "Hips/LeftUpLeg/LeftLeg/LeftFoot"


@dataclass(frozen=True, eq=False)
class Ride:
    """How the pelvis moves over a step, as Fourier series."""

    stride: float
    """Way that one cycle goes ahead."""
    rise: Floats
    """Its height: a constant, cosines, sines."""
    lead: Floats
    """How far it is ahead of a steady walk: the same."""


def pelvis_rotation(phase: Floats) -> Floats:
    """(…) to (…, 4): the orientation of the pelvis, xyzw."""
    angles = pelvis_angles(phase)
    return multiply(
        multiply(about(1, -angles.rotation), about(2, angles.obliquity)), about(0, angles.tilt)
    )


def pelvis_position(phase: Floats) -> Floats:
    """(…) to (…, 3): where the root joint is; phase goes on counting with the cycles."""
    ride = pelvis_ride()
    basis = _basis(phase)
    rise, lead = (np.sum(basis * series, axis=-1) for series in (ride.rise, ride.lead))
    return np.stack([_sway(phase), rise, ride.stride * phase + lead], axis=-1)


def hip_position(phase: Floats, side: int) -> Floats:
    """(…) to (…, 3): where the left (1) or right (-1) hip joint is."""
    return pelvis_position(phase) + rotate(pelvis_rotation(phase), hip_offset(side))


def hip_offset(side: int) -> Floats:
    """Return where a hip joint is in the frame of the root; side is 1 for left, -1 for right."""
    skeleton, _, _ = humanoid(1.0)
    left: Floats = skeleton.rest_translations[skeleton.index[_HIP]]
    return left * (side, 1.0, 1.0)


@cache
def pelvis_ride() -> Ride:
    """Return the way of the pelvis that the stance of the left leg asks for.

    First the way ahead, then the height that gives the knee the angle of the curves; both by least
    squares over stance, the second in degrees of the knee: a straight leg forgives least.
    """
    phase = np.linspace(HEEL_STRIKE, TOE_OFF, _SAMPLES)
    angles = leg_angles(phase)
    reach = leg_reach(angles)
    hip = rotate(pelvis_rotation(phase), hip_offset(1))
    ankle = ankle_on_ground(phase)
    basis = _basis(phase)
    fit = _fit(np.column_stack([phase, basis]), ankle[:, 1] - reach[:, 1] - hip[:, 2])
    stride, lead = fit[0], fit[1:]
    ahead = stride * phase + np.sum(basis * lead, axis=-1) + hip[:, 2] - ankle[:, 1]
    aside = _sway(phase) + hip[:, 0] - HALF_STEP_WIDTH
    height = np.sqrt(np.sum(reach**2, axis=-1) - ahead**2 - aside**2)
    strictness = 1.0 / np.sin(np.radians(angles.knee))
    rise = _fit(basis, ankle[:, 0] + height - hip[:, 1], strictness)
    return Ride(float(stride), rise, lead)


def leg_reach(angles: LegAngles) -> Floats:
    """(…) angles to (…, 2): how far an ankle is below its hip and ahead of it."""
    thigh, shank = np.radians(angles.thigh), np.radians(angles.thigh - angles.knee)
    upper, lower = leg_lengths()
    down = upper * np.cos(thigh) + lower * np.cos(shank)
    return np.stack([down, upper * np.sin(thigh) + lower * np.sin(shank)], axis=-1)


@cache
def leg_lengths() -> tuple[float, float]:
    """Return the lengths of thigh and shank."""
    skeleton, _, _ = humanoid(1.0)
    below = skeleton.rest_translations[[skeleton.index[joint] for joint in (_KNEE, _ANKLE)]]
    upper, lower = np.linalg.norm(below, axis=-1)
    return float(upper), float(lower)


def about(axis: int, degrees: Floats) -> Floats:
    """(…) to (…, 4): turns about one axis."""
    vector = np.zeros((*np.shape(degrees), 3))
    vector[..., axis] = np.radians(degrees)
    return from_vector(vector)


def _sway(phase: Floats) -> Floats:
    """(…) to (…): how far the pelvis is to the left."""
    return SWAY * np.cos(2.0 * np.pi * (phase - _SWAY_PEAK))


def _basis(phase: Floats) -> Floats:
    """(…) to (…, 2 harmonics + 1): a constant and the first harmonics of a step, half a cycle."""
    turns = 4.0 * np.pi * np.asarray(phase)[..., None] * np.arange(1, _HARMONICS + 1)
    return np.concatenate([np.ones_like(turns[..., :1]), np.cos(turns), np.sin(turns)], axis=-1)


def _fit(basis: Floats, values: Floats, strictness: Floats | float = 1.0) -> Floats:
    """(N, M), (N,), (N,) to (M,): the least squares solution."""
    rows = basis * np.reshape(strictness, (-1, 1))
    solution: Floats = np.linalg.lstsq(rows, values * strictness)[0]
    return solution

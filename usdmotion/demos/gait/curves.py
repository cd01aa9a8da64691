"""How the pelvis and the legs turn over one cycle of normal walking.

Source: Schwartz, Rozumalski & Trost, "The effect of walking speed on the gait of typically
developing children", Journal of Biomechanics 41 (2008) 1639-1650: group means of 83 children at
free speed, every 4 % of the cycle, the cycle starting where the heel of that side strikes. Gait is
mature at that age; the ranges are those of adults (Winter 1991; Perry & Burnfield 2010). It is used
here because pelvis and leg come from one experiment: together they make a foot that lies flat in
stance and steps of the length that the legs swing.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.interpolate import CubicSpline

from usdmotion.arrays import Floats

# fmt: off
_HIP = (35.6, 35.3, 34.1, 30.9, 26.8, 22.4, 18.0, 13.5, 9.2, 5.3, 1.6, -1.7, -4.4, -5.7, -4.9,
        -0.9, 6.2, 14.1, 21.5, 27.5, 32.1, 35.2, 36.7, 36.7, 36.0)
_KNEE = (5.5, 10.8, 16.8, 19.2, 18.5, 16.4, 13.9, 11.3, 9.0, 7.2, 6.2, 6.8, 9.5, 14.5, 22.6,
         33.9, 46.4, 55.7, 59.2, 57.0, 49.8, 38.9, 25.6, 12.6, 4.7)
_ANKLE = (-2.2, -5.7, -4.2, -0.3, 2.8, 5.1, 6.7, 8.0, 9.1, 10.2, 11.1, 11.8, 11.4, 8.4, -0.2,
          -13.8, -19.8, -14.7, -7.8, -2.3, 1.2, 2.6, 1.9, 0.2, -1.0)
_TILT = (12.1, 11.7, 11.1, 10.7, 10.6, 11.0, 11.3, 11.6, 11.8, 12.1, 12.4, 12.4, 12.2, 11.9, 11.4,
         10.8, 10.6, 10.7, 11.1, 11.4, 11.6, 11.9, 12.3, 12.5, 12.4)
_OBLIQUITY = (0.7, 1.4, 2.7, 3.7, 4.0, 3.3, 2.1, 0.8, -0.1, -0.5, -0.5, -0.4, -0.5, -1.0, -2.0,
              -3.3, -4.0, -3.8, -2.8, -1.5, -0.4, 0.3, 0.5, 0.4, 0.4)
_ROTATION = (4.3, 4.2, 3.5, 3.4, 3.5, 3.2, 2.5, 1.5, 0.5, -0.6, -1.9, -3.2, -4.1, -4.4, -3.9,
             -3.5, -3.6, -3.6, -3.0, -2.1, -1.1, 0.0, 1.2, 2.5, 3.7)
# fmt: on
NEUTRAL_TILT = 11.6
"""Forward tilt of the anatomical axes of a pelvis that stands upright, here its mean [degrees]."""


@dataclass(frozen=True, eq=False)
class LegAngles:
    """The angles of one leg in the plane of walking [degrees], each of the shape asked for."""

    hip: Floats
    """Flexion of the thigh against the pelvis, whose upright pose is 0."""
    knee: Floats
    """Flexion."""
    ankle: Floats
    """Dorsiflexion."""
    thigh: Floats
    """Flexion of the thigh against the vertical."""


@dataclass(frozen=True, eq=False)
class PelvisAngles:
    """The angles of the pelvis against its upright pose [degrees], seen from the left leg."""

    tilt: Floats
    """Forward."""
    obliquity: Floats
    """Left side up."""
    rotation: Floats
    """Left side ahead."""


def leg_angles(phase: Floats) -> LegAngles:
    """Return a leg's angles; phase 0 is where its heel strikes, 1 where it does so again."""
    curves = _curves()
    hip = curves["hip"](phase) - NEUTRAL_TILT
    return LegAngles(
        hip=hip,
        knee=curves["knee"](phase),
        ankle=curves["ankle"](phase),
        thigh=hip - pelvis_angles(phase).tilt,
    )


def pelvis_angles(phase: Floats) -> PelvisAngles:
    """Return the pelvis's angles at a phase of the left leg.

    The means of left and right steps differ by some hundredths of a degree; the parts that make
    both sides alike are taken.
    """
    curves, other = _curves(), phase + 0.5
    return PelvisAngles(
        tilt=0.5 * (curves["tilt"](phase) + curves["tilt"](other)) - NEUTRAL_TILT,
        obliquity=0.5 * (curves["obliquity"](phase) - curves["obliquity"](other)),
        rotation=0.5 * (curves["rotation"](phase) - curves["rotation"](other)),
    )


@cache
def _curves() -> dict[str, CubicSpline]:
    tables = {
        "hip": _HIP,
        "knee": _KNEE,
        "ankle": _ANKLE,
        "tilt": _TILT,
        "obliquity": _OBLIQUITY,
        "rotation": _ROTATION,
    }
    phases = np.linspace(0.0, 1.0, len(_HIP) + 1)
    return {
        name: CubicSpline(phases, (*table, table[0]), bc_type="periodic")
        for name, table in tables.items()
    }

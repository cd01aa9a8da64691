"""The one turn between the axes of a stage and those of normalized motions, which have y up."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, from_vector
from usdmotion.usd.shot import Facts

_FROM_Z = from_vector(np.array([-0.5 * np.pi, 0.0, 0.0]))
_NONE = np.array([0.0, 0.0, 0.0, 1.0])


def to_y_up(facts: Facts) -> Floats:
    """Return the rotation from the world of a stage to one with y up, xyzw, shape (4,)."""
    return _FROM_Z if facts.up_axis == "Z" else _NONE


def from_y_up(facts: Facts) -> Floats:
    """Return the rotation back, xyzw, shape (4,)."""
    return conjugate(to_y_up(facts))

"""Displacements as points of the σε-space, in closed form (2006, section 5)."""

import math
from dataclasses import dataclass

import numpy as np

from usdmotion import Floats
from usdmotion.kernels import kernel
from usdmotion_contacts.displacements import Displacements

NO_TURN = 1e-12
"""Half of the σ3 below which a rotation has no axis."""


@dataclass(frozen=True, eq=False)
class SigmaEpsilon:
    """The σε-points of an object: all that noise and instantaneous contacts are read from.

    R − I turns about the axis of R what is across it, and scales it by 2 sin(θ/2): its singular
    values are that number twice, and 0. With all of them taken for zero nothing but p = 0 is left
    and the whole translation is residual; with σ1 alone, only the slide along the axis is.
    """

    displacements: Displacements
    """What they are the projections of."""
    sigma_3: Floats
    """2 sin(θ/2), which σ2 is as well; no unit, shape (displacement_count,)."""
    epsilon_1: Floats
    """Length of the slide along the axis [m], shape (displacement_count,)."""
    epsilon_3: Floats
    """Length of the translation [m], shape (displacement_count,)."""


def project(displacements: Displacements) -> SigmaEpsilon:
    """Return the σε-points of displacements."""
    sigma_3, epsilon_1, epsilon_3 = (np.empty(displacements.count) for _ in range(3))
    _project(displacements.translations, displacements.rotations, sigma_3, epsilon_1, epsilon_3)
    return SigmaEpsilon(displacements, sigma_3, epsilon_1, epsilon_3)


@kernel
def _project(
    translations: Floats, rotations: Floats, sigma_3: Floats, epsilon_1: Floats, epsilon_3: Floats
) -> None:
    """(D, 3), (D, 4) into (D,), (D,), (D,)."""
    for i in range(translations.shape[0]):
        t, q = translations[i], rotations[i]
        sine = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])
        length = math.sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2])
        sigma_3[i] = 2.0 * sine
        epsilon_3[i] = length
        epsilon_1[i] = length
        if sine > NO_TURN:
            epsilon_1[i] = abs(t[0] * q[0] + t[1] * q[1] + t[2] * q[2]) / sine


def axes(displacements: Displacements) -> tuple[Floats, Floats]:
    """Return the instantaneous axis of each displacement: a direction, and its particular point.

    The point is p = −V Σ⁻¹ Uᵀ t, the one of the axis that is nearest to the object's origin. Both
    are in the object's frame, of shape (displacement_count, 3), and not finite without a turn.
    """
    vector, cosine = displacements.rotations[:, :3], displacements.rotations[:, 3:]
    sine = np.linalg.norm(vector, axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        axis = vector / sine
        t = displacements.translations
        across = t - np.sum(t * axis, axis=1, keepdims=True) * axis
        point = 0.5 * (across + cosine / sine * np.cross(axis, across))
    return axis, point

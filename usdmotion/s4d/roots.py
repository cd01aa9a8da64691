"""The root: its heading, and how high what carries it holds it."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, multiply
from usdmotion.s4d.turns import Y, about, continuous, twist

_UPSIDE_DOWN = 0.05
"""Of a rotation that has less of the up axis than this, nobody can tell the heading."""


def split_heading(orientation: Floats) -> tuple[Floats, Floats]:
    """Return the turn about the up axis, and what is left without it.

    Where a body stands on its head, its heading is that of the frames around.

    Args:
        orientation: Of the pelvis, y up, shape (F, 4).

    Returns:
        Heading and local orientation, each of shape (F, 4); the one after the other is the whole.
    """
    clear = np.hypot(orientation[:, 1], orientation[:, 3]) > _UPSIDE_DOWN
    frames = np.arange(len(orientation))
    angle = np.zeros(len(orientation))
    if clear.any():
        known = np.unwrap(twist(orientation[clear], 1))
        angle = np.interp(frames, frames[clear], known)
    heading = about(Y, angle)
    return heading, continuous(multiply(conjugate(heading), orientation))

"""Limbs: two segments as a frame, a length and two twists, and back (2005, section 4)."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.s4d.turns import X, Y, Z, about, across, from_y_z, swing, twist, unit

_STRAIGHT = 1e-6
"""How far beside the line to the end a middle joint is of which no side is told, over length."""


def aligned(frames: Floats, ways: Floats) -> Floats:
    """(…, 4), (…, 3) to (…, 4): frames led by the smallest turns to where their segments go."""
    ahead = rotate(frames, Z)
    return multiply(swing(ahead, unit(ways)), frames)


def fold(
    ways: tuple[Floats, Floats], frames: tuple[Floats, Floats]
) -> tuple[Floats, Floats, Floats]:
    """Return frame, length and twists of limbs (2005, figure 4).

    Args:
        ways: From top to middle joint and from there to the end [m], each of shape (F, L, 3).
        frames: Of the upper and of the lower segment: z along it, y to the side where the middle
            joint is when it bends; each of shape (F, L, 4).

    Returns:
        Frames (F, L, 4), lengths over the limb stretched out (F, L), twists [rad] (F, L, 2).
    """
    line = ways[0] + ways[1]
    reach = np.linalg.norm(line, axis=-1)
    upper, lower = (np.linalg.norm(way, axis=-1) for way in ways)
    whole = upper + lower
    z = np.where((reach > 0.0)[..., None], unit(line), unit(ways[0]))
    side = across(ways[0], z)
    hinge = across(rotate(frames[0], Y) + rotate(frames[1], Y), z)
    told = np.linalg.norm(side, axis=-1) > _STRAIGHT * whole
    frame = from_y_z(np.where(told[..., None], side, hinge), z)
    bent = _segments(frame, reach, upper, lower)
    twists = [
        twist(multiply(conjugate(plain), own), 2) for plain, own in zip(bent, frames, strict=True)
    ]
    return frame, reach / whole, np.stack(twists, axis=-1)


def unfold(
    frame: Floats, length: Floats, twists: Floats, upper: Floats, lower: Floats
) -> tuple[Floats, Floats]:
    """Return the frames of the upper and of the lower segment; the inverse of `fold`.

    Args:
        frame: Shape (F, L, 4).
        length: Over the limb stretched out, shape (F, L).
        twists: Shape (F, L, 2).
        upper: Lengths of the upper segments [m], shape (F or 1, L).
        lower: The same of the lower ones.
    """
    plain = _segments(frame, length * (upper + lower), upper, lower)
    first, second = (multiply(plain[index], about(Z, twists[..., index])) for index in (0, 1))
    return first, second


def middle_of(upper: Floats, lower: Floats, reach: Floats) -> tuple[Floats, Floats]:
    """Return where the middle joint of a limb is (2005, section 8): along the line, and beside it.

    Args:
        upper: Length of the upper segment [m].
        lower: Length of the lower one.
        reach: Distance from top joint to end.
    """
    along = (upper**2 - lower**2 + reach**2) / (2.0 * reach)
    return along, np.sqrt(np.maximum(upper**2 - along**2, 0.0))


def _segments(frame: Floats, reach: Floats, upper: Floats, lower: Floats) -> tuple[Floats, Floats]:
    """Return both segments in the half-plane of a frame: x of it is the hinge (2005, section 8)."""
    reach = np.clip(reach, np.maximum(np.abs(upper - lower), 1e-9), upper + lower)
    z, y = middle_of(upper, lower, reach)
    return (
        multiply(frame, about(X, -np.arctan2(y, z))),
        multiply(frame, about(X, np.arctan2(y, reach - z))),
    )

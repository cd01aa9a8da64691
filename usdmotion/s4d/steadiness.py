"""Limbs as they change steadily: told by the hinge, not by where the middle joint happens to be.

The half-plane of a limb that is stretched flips over when it bends the other way, and wanders when
it is almost straight. Between two postures one has to go another way: from the half-plane of the
hinge, with the bend as an offset in it that may be nothing or negative.
"""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, multiply
from usdmotion.s4d.bodies.anatomy import basis
from usdmotion.s4d.turns import Z, about


@dataclass(frozen=True, eq=False)
class Steady:
    """Limbs on F frames; L of them."""

    frames: Floats
    """As of a normalized motion, but y is where the hinge lets the middle joint go, (F, L, 4)."""
    bends: Floats
    """How far the middle joint is beside the line to the end in x and y of those frames, over half
    the length of a limb with equal segments, shape (F, L, 2)."""
    twists: Floats
    """Half of what the upper segment is turned more about itself than the lower one, (F, L)."""
    ends: Floats
    """Rotations of hands and feet as seen from those frames, xyzw, shape (F, L, 4)."""

    @classmethod
    def of(
        cls,
        limbs: tuple[str, ...],
        told: tuple[Floats, Floats, Floats],
        ends: Floats,
    ) -> "Steady":
        """Return limbs as they change steadily.

        Args:
            limbs: H-Anim names of their tops.
            told: Frames, lengths and twists, as of a normalized motion.
            ends: Rotations of their hands and feet, shape (F, L, 4).
        """
        frames, lengths, twists = told
        apart = twists[..., 0] - twists[..., 1]
        half = 0.5 * ((apart + np.pi) % (2.0 * np.pi) - np.pi)
        turn = twists[..., 0] - half
        bend = np.sqrt(np.clip(1.0 - lengths**2, 0.0, 1.0))
        return cls(
            frames=multiply(frames, about(Z, turn)),
            bends=bend[..., None] * np.stack([np.sin(turn), np.cos(turn)], axis=-1),
            twists=half,
            ends=multiply(_seen(limbs, -turn), ends),
        )

    def told(self, limbs: tuple[str, ...]) -> tuple[tuple[Floats, Floats, Floats], Floats]:
        """Return what `of` was given."""
        turn = np.arctan2(self.bends[..., 0], self.bends[..., 1])
        lengths = np.sqrt(np.clip(1.0 - np.sum(self.bends**2, axis=-1), 0.0, 1.0))
        twists = np.stack([turn + self.twists, turn - self.twists], axis=-1)
        frames = multiply(self.frames, about(Z, -turn))
        return (frames, lengths, twists), multiply(_seen(limbs, turn), self.ends)


def _seen(limbs: tuple[str, ...], turn: Floats) -> Floats:
    """(F, L) to (F, L, 4): a turn about a limb as its end sees it, in the axes of a T-pose."""
    bases = np.array([basis(limb) for limb in limbs])
    return multiply(multiply(bases, about(Z, turn)), conjugate(bases))

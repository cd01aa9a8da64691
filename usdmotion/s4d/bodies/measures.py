"""The lengths of a body, at rest or as it grows."""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG
from usdmotion.kernels import rotate
from usdmotion.s4d.bodies.places import ENDS, LIMBS, ROOT
from usdmotion.s4d.turns import Y

_BALL_HEIGHT = 0.157011
"""Height of the ball of a foot over its sole, over the way from ankle to ball: a foot is as thick
as it is long, whatever leg it is on. Skeletons do not tell where the skin is, and the tables of
lengths that the demonstrations' body comes from (Drillis & Contini 1966) have no such height: this
is theirs, chosen by eye. The sole of a thicker foot is off by the difference, on another body, in
as much as its legs are longer."""
_NO_BALL_HEIGHT = 0.02444
"""The same over leg length, where a foot has no ball."""
_ANKLE_HEIGHT = 0.07943
"""Height of an ankle over the sole, over leg length, where a foot has no ball."""


@dataclass(frozen=True, eq=False)
class Measures:
    """Lengths on N frames, of which one stands for all where nothing grows."""

    limbs: Floats
    """Upper and lower segment of left arm and leg, right arm and leg [m], shape (N, 4, 2)."""
    spine: Floats
    """From the pelvis to the first vertebra, from one to the next, and on to the neck [m]."""
    trunk: Floats
    """From the middle of the hips to the middle of the shoulders [m], shape (N,)."""
    ankle_height: Floats
    """Height of an ankle over the sole that stands on the ground [m], shape (N,)."""
    ball_height: Floats
    """The same of the ball of a foot."""

    @property
    def leg(self) -> Floats:
        """Thigh and shank, mean of both legs [m], shape (N,)."""
        return np.asarray(self.limbs[:, 1::2].sum(axis=2).mean(axis=1))

    @classmethod
    def of(cls, positions: Floats, parts: PartMap, frames: Floats) -> "Measures":
        """Return the lengths of a body whose joints are at rest.

        Args:
            positions: Of the joints [m], shape (N, joint_count, 3).
            parts: Which joint is which part.
            frames: Canonical orientation of each joint at rest, xyzw, shape (joint_count, 4).
        """

        def place(part: str) -> Floats:
            return np.asarray(positions[:, parts.joint(part)])

        def middle(part: str) -> Floats:
            return 0.5 * (place(f"l_{part}") + place(f"r_{part}"))

        ways = [[place(lower) - place(upper) for upper, lower in _pairs(limb)] for limb in LIMBS]
        limbs = np.linalg.norm(np.moveaxis(np.array(ways), 2, 0), axis=-1)
        column = [place(part) for part in _column(parts)]
        leg = limbs[:, 1::2].sum(axis=2).mean(axis=1)
        balls = [part for part in _BALLS if parts.joint(part) is not None]
        ankles = [ENDS[1] if ball.startswith("l") else ENDS[3] for ball in balls]
        ups = [rotate(frames[parts.joint(ankle)], Y) for ankle in ankles]
        feet = [place(ankle) - place(ball) for ankle, ball in zip(ankles, balls, strict=True)]
        rises = [foot @ up for foot, up in zip(feet, ups, strict=True)]
        sizes = np.linalg.norm(feet, axis=-1) if feet else np.zeros((1, 1))
        ball_height = _BALL_HEIGHT * sizes.mean(axis=0) if feet else _NO_BALL_HEIGHT * leg
        rise = np.maximum(np.mean(rises, axis=0), 0.0) if rises else 0.0
        return cls(
            limbs=limbs,
            spine=np.linalg.norm(np.diff(column, axis=0), axis=-1).T,
            trunk=np.linalg.norm(middle("shoulder") - middle("hip"), axis=-1),
            ankle_height=ball_height + rise if rises else _ANKLE_HEIGHT * leg,
            ball_height=ball_height,
        )


_BALLS = tuple(f"{side}_{LEG[3]}" for side in "lr")


def _column(parts: PartMap) -> list[str]:
    """Return the parts from the pelvis to where the neck begins."""
    back, neck = ([parts.parts[joint] for joint in row] for row in (parts.spine, parts.neck))
    return [ROOT, *back, *(neck[:1] or ["skullbase"])]


def _pairs(limb: tuple[str, str, str]) -> tuple[tuple[str, str], tuple[str, str]]:
    return (limb[0], limb[1]), (limb[1], limb[2])

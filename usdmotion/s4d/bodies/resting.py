"""How a body stands, where its rest pose does not say: told by the way it moves.

Some files give lengths only, along the axes that the joints happen to have: at rest, legs point
wherever the back does. Then the postures tell which way knees and elbows bend and which side of a
foot is the sole, and what they are on average, at right angles where they are near, is how the
trunk stands.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import LEG
from usdmotion.kernels import chordal_mean, conjugate, forward, multiply, rotate, to_vector
from usdmotion.motion import Motion, Skeleton
from usdmotion.s4d.bodies.places import LIMBS
from usdmotion.s4d.turns import across, unit

_MOST_FRAMES = 500
"""Postures that are looked at, evenly over the clip."""
_NEAR = np.radians(40.0)
"""How far from a turn by right angles a joint may be on average to be meant as that."""
_STILL = np.radians(2.0)
"""Median turn away from its mean of a joint that hardly moves."""
_BENT = 0.03
"""How far beside the line from top to end a middle joint is on average that shows its side, over
the length of the upper segment."""
_STANDING = 0.1
"""Share of the frames, the slowest and lowest ones, in which a foot is taken to stand."""
_UPRIGHT = np.cos(np.radians(40.0))
"""And how far the shank above it may lean."""
_ALIKE = np.radians(5.0)
"""How much more one foot may be pitched than the other as it stands; more is on tiptoe."""


@dataclass(frozen=True, eq=False)
class Resting:
    """A rest pose for a skeleton, and what only its motion shows."""

    skeleton: Skeleton
    """The skeleton, standing."""
    sides: Mapping[int, Floats]
    """Where the middle joint of a limb goes when it bends, in the frame of its top or of its middle
    joint, shape (3,); none of limbs that hardly bend."""
    soles: Mapping[int, Floats]
    """The direction away from the sole in the frame of an ankle, shape (3,); none of feet that do
    not stand."""

    @classmethod
    def seen(cls, skeleton: Skeleton, parts: PartMap, motion: Motion) -> "Resting":
        """Return how a body stands, from its motion."""
        step = -(-motion.frame_count // _MOST_FRAMES)
        poses = motion.during(slice(None, None, step))
        rotations = skeleton.rest_rotations.copy()
        root = parts.joint("humanoid_root")
        assert root is not None
        for joint in range(len(skeleton.joints)):
            if root in skeleton.chain(joint)[1:]:
                rotations[joint] = _usual(poses.rotations[:, joint])
        positions, orientations = forward(skeleton.parents, poses.translations, poses.rotations)
        posed = _Posed(parts, positions, orientations)
        sides: dict[int, Floats] = {}
        for limb in LIMBS:
            sides |= posed.sides(*limb)
        return cls(replace(skeleton, rest_rotations=rotations), sides, posed.soles())


def _usual(rotations: Floats) -> Floats:
    """(F, 4) to (4,): the mean, or of a joint that moves the turn by right angles that it is near.

    The mean of a joint that moves depends on what it does in the clip; that of one that hardly
    does is how it is built.
    """
    mean = chordal_mean(rotations, np.ones(len(rotations)))
    turns = np.linalg.norm(to_vector(multiply(conjugate(mean), rotations)), axis=-1)
    if np.median(turns) < _STILL:
        return mean
    right_angles = _right_angles()
    away = np.linalg.norm(to_vector(multiply(conjugate(right_angles), mean)), axis=-1)
    nearest = int(np.argmin(away))
    return np.asarray(right_angles[nearest] if away[nearest] < _NEAR else mean)


@dataclass(frozen=True, eq=False)
class _Posed:
    parts: PartMap
    positions: Floats
    orientations: Floats

    def joint(self, part: str) -> int:
        joint = self.parts.joint(part)
        assert joint is not None
        return joint

    def place(self, part: str) -> Floats:
        return np.asarray(self.positions[:, self.joint(part)])

    def sides(self, top: str, middle: str, end: str) -> dict[int, Floats]:
        """Return the mean side of the middle joint, which counts by how far the limb is bent.

        None of a limb that hardly ever bends.
        """
        upper = self.place(middle) - self.place(top)
        side = across(upper, unit(self.place(end) - self.place(top)))
        sides = {
            joint: rotate(conjugate(self.orientations[:, joint]), side).mean(axis=0)
            for joint in (self.joint(top), self.joint(middle))
        }
        length = np.linalg.norm(upper, axis=-1).mean()
        is_told = all(np.linalg.norm(each) > _BENT * length for each in sides.values())
        return sides if is_told else {}

    def soles(self) -> dict[int, Floats]:
        """Return which way is up for each foot while its leg stands; none if it never does."""
        hips = self.place("l_hip") + self.place("r_hip")
        trunk = unit(self.place("l_shoulder") + self.place("r_shoulder") - hips).mean(axis=0)
        axis = int(np.argmax(np.abs(trunk)))
        up = np.sign(trunk[axis]) * np.eye(3)[axis]
        found = {}
        for side in "lr":
            ankle = self.joint(f"{side}_talocrural")
            stands = self._stands(side, up)
            if stands.any():
                turns = conjugate(self.orientations[stands, ankle])
                found[ankle] = unit(np.median(rotate(turns, up), axis=0))
        return self._flat(found)

    def _flat(self, soles: dict[int, Floats]) -> dict[int, Floats]:
        """Return soles of which one that was seen on tiptoe only is pitched as the other foot's.

        Bodies are built alike on both sides, and who stands with one heel in the air all the time
        is told from who stands flat by the other foot alone.
        """
        ways: dict[int, Floats] = {}
        for side in "lr":
            ankle, ball = self.joint(f"{side}_{LEG[2]}"), self.parts.joint(f"{side}_{LEG[3]}")
            if ball is not None and ankle in soles:
                way = self.positions[:, ball] - self.positions[:, ankle]
                way = rotate(conjugate(self.orientations[:, ankle]), way)
                ways[ankle] = unit(way.mean(axis=0))
        pitches = {ankle: np.arcsin(-way @ soles[ankle]) for ankle, way in ways.items()}
        if len(pitches) < 2 or np.ptp(list(pitches.values())) <= _ALIKE:
            return soles
        flat = min(pitches.values())
        return {
            ankle: np.cos(flat) * unit(across(soles[ankle], way)) - np.sin(flat) * way
            for ankle, way in ways.items()
        }

    def _stands(self, side: str, up: Floats) -> Bools:
        """Return on which frames a foot is slowest and lowest of those with an upright leg."""
        ankle, toes = self.joint(f"{side}_{LEG[2]}"), self.parts.joint(f"{side}_{LEG[3]}")
        foot = self.positions[:, [ankle, ankle if toes is None else toes]]
        leg = unit(self.place(f"{side}_knee") - foot[:, 0]) @ up
        steps = np.linalg.norm(np.diff(foot, axis=0, prepend=foot[:1]), axis=-1).sum(axis=1)
        rank = np.argsort(np.argsort(steps)) + np.argsort(np.argsort(foot[:, 0] @ up))
        upright = np.asarray(leg > _UPRIGHT)
        if not upright.any():
            return upright
        return np.asarray(upright & (rank <= np.quantile(rank[upright], _STANDING)))


@cache
def _right_angles() -> Floats:
    """Return all turns by right angles, xyzw, shape (24, 4)."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.create_group("O").as_quat())

"""Where the body is in the frames of a skeleton: told by the geometry of its rest pose.

Every part gets a frame as if the body stood in a T-pose, palms down: x to its left, y up, z front.
Arms, legs, hands, feet and digits are led there from wherever they are at rest by the smallest
turns, so that a T-pose, an A-pose and hanging arms give the same frames in the joints; trunk, head
and clavicles are at rest what they are in a T-pose.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import finger
from usdmotion.kernels import conjugate, forward, multiply, rotate
from usdmotion.motion import Skeleton
from usdmotion.s4d.bodies.places import FINGERS, LIMBS
from usdmotion.s4d.bodies.resting import Resting
from usdmotion.s4d.turns import IDENTITY, X, Y, Z, across, from_y_z, swing, unit

_UPRIGHT = np.cos(np.radians(30.0))
"""How near to a principal axis the trunk has to be at rest, to be meant along it."""
_SQUARE = np.cos(np.radians(10.0))
"""The same, of the line from right to left."""
_BENT = np.sin(np.radians(10.0))
"""A limb that is bent as much at rest shows its half-plane."""
_STANDING = 0.5
"""Cosine of how far legs, hips, shoulders and head may be from where they are in a T-pose."""
_AHEAD = 0.3
"""Share of its length that a foot goes ahead at least, to show where ahead is."""
_ROLL = np.cos(np.radians(12.0))
"""How far a foot may be rolled against its leg and be meant to stand flat."""
_SPREAD = 0.1
"""How far apart the outer knuckles are, over their way from the wrist, to show the palm."""
_WIDE = ("hip", "shoulder")
_SAME_SIDE = 0.3
"""Cosine below which a bend at rest is another than that of the joint."""


def basis(top: str) -> Floats:
    """Return the frame of a limb in a T-pose, in the axes of the body, xyzw, shape (4,).

    z points from its top to its end, y to the side where its middle joint is when it bends: knees
    to the front, elbows to the back.
    """
    if top.endswith("hip"):
        return from_y_z(Z, -Y)
    return from_y_z(-Z, X if top.startswith("l") else -X)


class Rest:
    """A body at rest, in the space of its skeleton."""

    def __init__(self, skeleton: Skeleton, parts: PartMap, told: Resting | None = None) -> None:
        self.skeleton = skeleton if told is None else told.skeleton
        self.parts = parts
        self._sides = {} if told is None else told.sides
        self._soles = {} if told is None else told.soles
        self.positions, self.orientations = rest_pose(self.skeleton)
        self.axes = self._axes()

    @property
    def stands(self) -> bool:
        """Whether this is a body's posture: legs below the trunk, hips and shoulders in line."""
        sides = [self.line(self.joint(f"r_{part}"), self.joint(f"l_{part}")) for part in _WIDE]
        legs = [self.line(self.joint(limb[0]), self.joint(limb[2])) for limb in LIMBS[1::2]]
        head = self.line(self.joint("humanoid_root"), self.joint("skullbase"))
        turned = [*(unit(side) @ X for side in sides), *(unit(leg) @ -Y for leg in legs)]
        return bool(min(*turned, unit(head) @ Y) > _STANDING)

    def _seen(self, hints: Mapping[int, Floats], joint: int) -> Floats | None:
        """Return a direction that was seen in the frame of a joint, in the axes of the body."""
        if joint not in hints:
            return None
        turned = multiply(conjugate(self.axes), self.orientations[joint])
        return rotate(turned, unit(hints[joint]))

    def joint(self, part: str) -> int:
        """Return the joint of a part that every body has."""
        joint = self.parts.joint(part)
        assert joint is not None
        return joint

    def place(self, part: str) -> Floats:
        """Return where a part is that every body has [m], shape (3,)."""
        return np.asarray(self.positions[self.joint(part)])

    def middle(self, part: str) -> Floats:
        """Return the middle between a part's left and its right [m], shape (3,)."""
        return 0.5 * (self.place(f"l_{part}") + self.place(f"r_{part}"))

    def line(self, a: int, b: int) -> Floats:
        """Return the way from a joint to another in the axes of the body [m], shape (3,)."""
        return rotate(conjugate(self.axes), self.positions[b] - self.positions[a])

    def _axes(self) -> Floats:
        """Return the axes of the body: x to its left, y up, z front."""
        trunk = unit(self.middle("shoulder") - self.middle("hip"))
        up = _snapped(trunk, _UPRIGHT)
        hips = unit(self.place("l_hip") - self.place("r_hip"))
        shoulders = unit(self.place("l_shoulder") - self.place("r_shoulder"))
        left = _snapped(unit(across(hips + shoulders, up)), _SQUARE)
        return from_y_z(up, np.cross(left, up))

    def frames(self) -> Floats:
        """Return the frame of every joint in the space of the skeleton, (joint_count, 4).

        In the axes of the body first: what no limb carries is upright.
        """
        frames: dict[int, Floats] = {}
        for top, middle, end in LIMBS:
            joints = (self.joint(top), self.joint(middle), self.joint(end))
            frames |= self._limb(basis(top), joints)
            frames[joints[2]] = (
                self._foot(joints[2], frames[joints[1]])
                if end.endswith("talocrural")
                else self._hand(joints, frames[joints[1]], 1.0 if end.startswith("l") else -1.0)
            )
        for row in FINGERS:
            frames |= self._finger(row, frames)
        every = np.empty((len(self.skeleton.joints), 4))
        for joint, parent in enumerate(self.skeleton.parents):
            above = every[parent] if parent >= 0 else IDENTITY
            own = IDENTITY if self._is_trunk(joint) else above
            every[joint] = frames.get(joint, own)
        return multiply(self.axes, every)

    def _is_trunk(self, joint: int) -> bool:
        return joint in (self.parts.pelvis, *self.parts.spine, *self.parts.neck)

    def _limb(self, base: Floats, joints: Sequence[int]) -> dict[int, Floats]:
        top, middle, end = joints
        upper, lower = unit(self.line(top, middle)), unit(self.line(middle, end))
        frame = multiply(swing(rotate(base, Z), upper), base)
        side = -across(lower, upper)
        if np.linalg.norm(side) > _BENT and unit(side) @ rotate(frame, Y) > _SAME_SIDE:
            frame = from_y_z(side, upper)
        below = multiply(swing(upper, lower), frame)
        first, second = (self._seen(self._sides, joint) for joint in (top, middle))
        if first is not None and second is not None:
            frame, below = from_y_z(first, upper), from_y_z(second, lower)
        return {top: multiply(frame, conjugate(base)), middle: multiply(below, conjugate(base))}

    def _foot(self, ankle: int, shank: Floats) -> Floats:
        """Return the frame of a foot, which points to its ball and is flat at rest.

        Unless it would have to roll more than an ankle does, and goes straighter ahead if it hangs
        on its leg.
        """
        balls = self._ahead(ankle, ("tarsometatarsal", "metatarsophalangeal"))
        ways = [self.line(ankle, ball) for ball in balls]
        way = np.mean(ways, axis=0) if np.any(ways) else Z
        up = self._seen(self._soles, ankle)
        if up is not None:
            return from_y_z(up, across(way, up))
        ahead = across(way, Y)[2] > _AHEAD * np.linalg.norm(way)
        hanging = unit(across(rotate(shank, Y), Z))
        flat, slanted = (from_y_z(up, across(way if ahead else Z, up)) for up in (Y, hanging))
        straighter = not np.any(ways) or rotate(slanted, Z)[2] > rotate(flat, Z)[2]
        return slanted if hanging @ Y < _ROLL and straighter else flat

    def _hand(self, joints: Sequence[int], forearm: Floats, sign: float) -> Floats:
        """Return the frame of a hand: along its middle, its back away from the palm."""
        wrist = joints[2]
        knuckles = [
            self.parts.joint(f"{'l' if sign > 0 else 'r'}_{finger(digit)[1]}")
            for digit in (2, 3, 4, 5)
        ]
        known = [joint for joint in knuckles if joint is not None]
        straight = rotate(forearm, sign * X)
        ways = [self.line(wrist, joint) for joint in known]
        way = unit(np.mean(ways, axis=0)) if np.any(ways) else straight
        spread = self.line(known[-1], known[0]) if known else np.zeros(3)
        thumbwards = across(spread, way)
        if np.linalg.norm(thumbwards) > _SPREAD * np.linalg.norm(ways or straight, axis=-1).mean():
            return from_y_z(np.cross(thumbwards, sign * way), thumbwards)
        return multiply(swing(straight, way), forearm)

    def _finger(self, row: Sequence[str], frames: dict[int, Floats]) -> dict[int, Floats]:
        joints = [joint for joint in map(self.parts.joint, row) if joint is not None]
        if not joints:
            return {}
        left = row[0].startswith("l")
        wrist = self.joint("l_radiocarpal" if left else "r_radiocarpal")
        hand = frames[wrist]
        ahead = rotate(hand, X if left else -X)
        ways = [self.line(a, b) for a, b in pairwise(joints)]
        ways.append(ways[-1] if ways else self.line(wrist, joints[0]))
        return {
            joint: multiply(swing(ahead, unit(way)), hand)
            for joint, way in zip(joints, ways, strict=True)
        }

    def _ahead(self, ankle: int, names: Sequence[str]) -> list[int]:
        """Return the joints of a foot that are its ball: of the whole foot, or of each toe."""
        side = self.parts.parts[ankle][0]
        digits = ("", *(f"_{digit}" for digit in range(1, 6)))
        wanted = [f"{side}_{name}{digit}" for digit in digits for name in reversed(names)]
        found = [joint for joint in map(self.parts.joint, wanted) if joint is not None]
        return [found[0]] if f"{side}_metatarsophalangeal" in self.parts.parts else found


def rest_pose(skeleton: Skeleton) -> tuple[Floats, Floats]:
    """Return where joints are at rest [m] and how they are turned, (J, 3) and (J, 4)."""
    positions, orientations = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    return positions[0], orientations[0]


def _snapped(direction: Floats, cosine: float) -> Floats:
    """Return the principal axis that a direction is within some angle of, else itself."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) < cosine:
        return direction
    return np.asarray(np.sign(direction[axis]) * np.eye(3)[axis])

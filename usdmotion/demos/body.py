"""The humanoid of the demonstrations: its skeleton, its masses, its limits, its outline.

It stands in a T-pose with its soles on y = 0, faces +Z, and has its left side towards +X. Every
rest rotation is the identity, so a rotation of a joint is also its turn away from the T-pose.

Sources. Lengths as fractions of the height: Drillis & Contini 1966, as drawn in Winter,
"Biomechanics and Motor Control of Human Movement", figure 4.1. Masses and their centres: de Leva,
"Adjustments to Zatsiorsky-Seluyanov's segment inertia parameters", Journal of Biomechanics 29
(1996), table 4, men. Hip joint centres: 14 % of the width between the iliac spines inwards from
each (Bell, Brand & Pedersen 1989), that width being about 0.14 of the height. What those leave open
is chosen by eye: the heights of the vertebrae and of the skull's base, the joints of the shoulder
girdle, the place of the ankle and of the ball along the foot.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.motion import Body, Skeleton

_FREE = (-np.inf, np.inf)
_SLACK = (-5.0, 5.0)
"""A knee or an elbow is no perfect hinge: this much it gives way sideways [degrees]."""

_ANKLE_HEIGHT = 0.039
_KNEE_HEIGHT = 0.285
_HIP_HEIGHT = 0.530
_HIP_SIDE = 0.05
_SHOULDER_HEIGHT = 0.818
_SHOULDER_SIDE = 0.105
_BALL_HEIGHT = 0.012
_HEEL_BACK = 0.0375
_BALL_AHEAD = 0.0715
_TOE_LENGTH = 0.043
_KINDS = {
    "shoulder": ("Shoulder",),
    "arm": ("Arm", "Hand"),
    "leg": ("Leg",),
    "foot": ("Foot", "Toe"),
    "head": ("Neck", "Head"),
}
_ANKLES = ("l_talocrural", "r_talocrural")


@dataclass(frozen=True, kw_only=True)
class Proportions:
    """How somebody differs from the usual body of the same height; 1 is the usual."""

    legs: float = 1.0
    """Length of thighs and shanks."""
    arms: float = 1.0
    """Length of upper arms, forearms and hands."""
    trunk: float = 1.0
    """Length from the hips to the neck."""
    width: float = 1.0
    """Width of hips and shoulders."""
    feet: float = 1.0
    """Length and height of the feet."""
    head: float = 1.0
    """Size of neck and head."""

    def of(self, kind: str) -> Floats:
        """Return the factors of a kind of segment along x, y and z, shape (3,)."""
        factors: dict[str, float | tuple[float, float, float]] = {
            "trunk": (self.width, self.trunk, 1.0),
            "shoulder": self.width,
            "arm": self.arms,
            "leg": self.legs,
            "foot": self.feet,
            "head": self.head,
        }
        return np.asarray(np.broadcast_to(factors[kind], 3))


USUAL = Proportions()
"""Those of the sources above."""


@dataclass(frozen=True)
class Segment:
    """What hangs on a joint: where it is, what it weighs, how far the joint turns, how it looks."""

    name: str
    """Name of the joint."""
    parent: str
    """Name of the parent joint; "" for the root."""
    part: str
    """H-Anim name of the joint."""
    place: tuple[float, float, float]
    """Position in the T-pose, world axes, fraction of the height."""
    end: tuple[float, float, float]
    """Far end of the segment in the T-pose, world axes, fraction of the height."""
    radius: float
    """Thickness for drawing, fraction of the height."""
    mass: float = 0.0
    """Fraction of the body's mass."""
    mass_center: float = 0.5
    """Where the mass is between place (0) and end (1)."""
    limits: tuple[tuple[float, float], ...] = (_FREE, _FREE, _FREE)
    """Limits about x, y and z [degrees]."""

    @property
    def kind(self) -> str:
        """What it grows with, by its name: trunk, shoulder, arm, leg, foot or head."""
        kinds = (kind for kind, words in _KINDS.items() if any(word in self.name for word in words))
        return next(kinds, "trunk")


@dataclass(frozen=True, eq=False)
class Solid:
    """A capsule that stands for the segment of a joint."""

    joint: int
    """Index of the joint, where the capsule starts."""
    end: Floats
    """Where it ends, in the joint's frame [m], shape (3,)."""
    radius: float
    """Thickness [m]."""


@dataclass(frozen=True, eq=False)
class Sole:
    """The points of a foot that touch the ground; the same on both sides."""

    heel: Floats
    """Underside of the heel in the ankle's frame [m], shape (3,)."""
    ball: Floats
    """Underside of the ball of the foot in the toe joint's frame [m], shape (3,)."""
    toe_tip: Floats
    """Underside of the tip of the toes in the toe joint's frame [m], shape (3,)."""


def humanoid(
    height: float = 1.7, *, mass: float = 68.0, proportions: Proportions = USUAL
) -> tuple[Skeleton, Body, tuple[str, ...]]:
    """Return the skeleton [m], the body [kg] and the H-Anim part of every joint."""
    return assembled(proportioned(SEGMENTS, proportions), height, mass)


def assembled(
    segments: Sequence[Segment], height: float, mass: float
) -> tuple[Skeleton, Body, tuple[str, ...]]:
    """Return the skeleton [m], the body [kg] and the H-Anim part of every joint of some segments.

    Args:
        segments: Parents before children.
        height: Of the body [m].
        mass: Of the body [kg].
    """
    tokens = _tokens(segments)
    names = list(tokens)
    parents = np.array([names.index(s.parent) if s.parent else -1 for s in segments])
    places = height * np.array([s.place for s in segments])
    ends = height * np.array([s.end for s in segments])
    origins = np.where(parents[:, None] < 0, 0.0, places[parents])
    shares = np.array([s.mass_center for s in segments])
    limits = np.array([s.limits for s in segments])
    upright = np.tile((0.0, 0.0, 0.0, 1.0), (len(segments), 1))
    skeleton = Skeleton(tuple(tokens.values()), parents, places - origins, upright)
    body = Body(
        masses=mass * np.array([s.mass for s in segments]),
        mass_centers=shares[:, None] * (ends - places),
        limits_min=limits[:, :, 0],
        limits_max=limits[:, :, 1],
        stiffness=np.zeros(len(segments)),
    )
    return skeleton, body, tuple(s.part for s in segments)


def proportioned(segments: Sequence[Segment], proportions: Proportions) -> tuple[Segment, ...]:
    """Return the segments of somebody with other proportions, of the same height, on the ground."""
    places: dict[str, Floats] = {}
    kinds = {segment.name: segment.kind for segment in segments}
    old = {segment.name: np.array(segment.place) for segment in segments}
    grown = []
    for segment in segments:
        place = old[segment.name]
        if segment.parent:
            way = place - old[segment.parent]
            place = places[segment.parent] + proportions.of(kinds[segment.parent]) * way
        places[segment.name] = place
        own = proportions.of(segment.kind) * np.subtract(segment.end, segment.place)
        radius = segment.radius * (proportions.head if segment.kind == "head" else 1.0)
        grown.append((segment, place, place + own, radius))
    ankle = min(place[1] for segment, place, _, _ in grown if segment.part in _ANKLES)
    ground = np.array((0.0, ankle - _ANKLE_HEIGHT * proportions.feet, 0.0))
    top = max((end - ground)[1] + radius for s, _, end, radius in grown if s.kind == "head")
    return tuple(
        replace(
            segment,
            place=tuple((place - ground) / top),
            end=tuple((end - ground) / top),
            radius=radius / top,
        )
        for segment, place, end, radius in grown
    )


def solids(height: float = 1.7, proportions: Proportions = USUAL) -> tuple[Solid, ...]:
    """Return one capsule per joint, in the order of the skeleton."""
    return tuple(
        Solid(joint, seal(height * np.subtract(s.end, s.place), 3), height * s.radius)
        for joint, s in enumerate(proportioned(SEGMENTS, proportions))
    )


def sole(height: float = 1.7, proportions: Proportions = USUAL) -> Sole:
    """Return the points under a foot."""
    segments = {segment.name: segment for segment in proportioned(SEGMENTS, proportions)}
    size = height * segments["LeftFoot"].place[1] / _ANKLE_HEIGHT
    return Sole(
        heel=seal(size * np.array((0.0, -_ANKLE_HEIGHT, -_HEEL_BACK)), 3),
        ball=seal(size * np.array((0.0, -_BALL_HEIGHT, 0.0)), 3),
        toe_tip=seal(size * np.array((0.0, -_BALL_HEIGHT, _TOE_LENGTH)), 3),
    )


def _tokens(segments: Sequence[Segment]) -> dict[str, str]:
    """Return the path of every joint by its name, in order."""
    tokens: dict[str, str] = {}
    for segment in segments:
        above = f"{tokens[segment.parent]}/" if segment.parent else ""
        tokens[segment.name] = above + segment.name
    return tokens


def _trunk() -> list[Segment]:
    """Return pelvis, vertebrae and head.

    The lower trunk weighs on the hips, the middle one (navel to breastbone) on the lumbar spine,
    the upper one on the upper thorax; their centres are told as shares of the segment's own line.
    """
    skull = (0.0, 0.905, 0.008)
    return [
        Segment("Hips", "", "humanoid_root", (0, 0.555, 0), (0, 0.610, 0), 0.055, 0.1117, 0.14),
        Segment("Spine", "Hips", "vl5", (0, 0.580, 0), (0, 0.690, 0), 0.055, 0.1633, 0.92),
        Segment("Spine1", "Spine", "vt12", (0, 0.690, 0), (0, 0.770, 0), 0.060),
        Segment("Spine2", "Spine1", "vt6", (0, 0.770, 0), (0, 0.840, 0), 0.056, 0.1596, 0.51),
        Segment("Neck", "Spine2", "vc7", (0, 0.840, 0), skull, 0.028),
        Segment("Head", "Neck", "skullbase", skull, (0, 0.955, 0.018), 0.045, 0.0694, 0.5),
    ]


def _arm(side: str, prefix: str, sign: int) -> list[Segment]:
    """Return collar bone, upper arm, forearm and hand, stretched out sideways."""
    y = _SHOULDER_HEIGHT
    reach = np.cumsum((_SHOULDER_SIDE, 0.186, 0.146, 0.108)) * sign
    shoulder, elbow, wrist, tip = ((float(x), y, 0.0) for x in reach)
    bend = (-150.0, 0.0) if sign > 0 else (0.0, 150.0)
    hinge = ((-90.0, 90.0), bend, _SLACK)
    collar, upper, fore = (sign * 0.02, y, 0.02), f"{side}Arm", f"{side}ForeArm"
    clavicle = f"{side}Shoulder"
    return [
        Segment(clavicle, "Spine2", f"{prefix}_sternoclavicular", collar, shoulder, 0.026),
        Segment(upper, clavicle, f"{prefix}_shoulder", shoulder, elbow, 0.026, 0.0271, 0.5772),
        Segment(fore, upper, f"{prefix}_elbow", elbow, wrist, 0.021, 0.0162, 0.4574, hinge),
        Segment(f"{side}Hand", fore, f"{prefix}_radiocarpal", wrist, tip, 0.018, 0.0061, 0.3624),
    ]


def _leg(side: str, prefix: str, sign: int) -> list[Segment]:
    """Return thigh, shank, foot and toes, straight down from the hip."""
    x = sign * _HIP_SIDE
    hip, knee, ankle = ((x, y, 0.0) for y in (_HIP_HEIGHT, _KNEE_HEIGHT, _ANKLE_HEIGHT))
    ball = (x, _BALL_HEIGHT, _BALL_AHEAD)
    tip = (x, _BALL_HEIGHT, _BALL_AHEAD + _TOE_LENGTH)
    hinge = ((0.0, 150.0), _SLACK, _SLACK)
    up, low, foot = f"{side}UpLeg", f"{side}Leg", f"{side}Foot"
    return [
        Segment(up, "Hips", f"{prefix}_hip", hip, knee, 0.042, 0.1416, 0.4095),
        Segment(low, up, f"{prefix}_knee", knee, ankle, 0.030, 0.0433, 0.4459, hinge),
        Segment(foot, low, f"{prefix}_talocrural", ankle, ball, 0.019, 0.0137, 0.414),
        Segment(f"{side}ToeBase", foot, f"{prefix}_metatarsophalangeal", ball, tip, 0.012),
    ]


SEGMENTS: tuple[Segment, ...] = (
    *_trunk(),
    *_arm("Left", "l", 1),
    *_arm("Right", "r", -1),
    *_leg("Left", "l", 1),
    *_leg("Right", "r", -1),
)
"""The whole body, parents before children."""

"""Who fights, and how: everybody's motion is made of the same four, blended and put on his body.

They are taken off the usual body (2005, section 4), played at the pace of a bout, one blended into
the other, and put on bodies of other heights and proportions.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.curves import ease
from usdmotion.demos.body import Proportions, Solid, humanoid, solids
from usdmotion.demos.fighting import GESTURES, HEIGHT, RATE, performed
from usdmotion.humanoid import PartMap
from usdmotion.kernels import forward, from_vector, multiply, rotate
from usdmotion.motion import Body, Motion, Placement, Skeleton
from usdmotion.s4d import Morphology, NormalizedMotion, blend, normalize, restore, warp

SECONDS = 4.0
"""How long they fight [s]."""
COLLAR = 0.95
"""How stiff a collar bone is."""
UP = np.array((0.0, 1.0, 0.0))
_FADE = 0.25
"""How long a gesture takes to come in, and to go [s]."""


@dataclass(frozen=True)
class Build:
    """How somebody is built."""

    height: float
    """[m]"""
    mass: float
    """[kg]"""
    proportions: Proportions


@dataclass(frozen=True)
class Bout:
    """Two who fight: one attacks, the other wards off and strikes back."""

    attacker: Build
    defender: Build
    place: tuple[float, float]
    """Where their middle is, to the left and ahead [m]."""
    heading: float
    """Where the attacker faces, from ahead to the left [degrees]."""
    apart: float
    """How far they stand apart [m]."""
    start: float
    """When the attacker begins to kick [s]."""
    pace: float
    """How long what takes a second takes here [s]."""

    def moments(self, *seconds: float) -> tuple[float, ...]:
        """Return when something happens that happens so long after the kick began, at pace 1."""
        return tuple(self.start + self.pace * each for each in seconds)


BOUTS = (
    Bout(
        Build(1.78, 75.0, Proportions(legs=1.06, trunk=0.94)),
        Build(1.66, 66.0, Proportions(width=1.12, arms=0.96)),
        (0.0, 0.0),
        4.0,
        0.95,
        0.30,
        1.0,
    ),
    Bout(
        Build(1.62, 54.0, Proportions(width=0.92, head=1.05)),
        Build(1.70, 68.0, Proportions(arms=0.97)),
        (1.8, 0.3),
        -5.0,
        0.98,
        0.55,
        0.95,
    ),
    Bout(
        Build(1.95, 98.0, Proportions(width=1.10, trunk=1.04)),
        Build(1.86, 82.0, Proportions(legs=0.95, trunk=1.06)),
        (3.7, 0.1),
        2.0,
        1.04,
        0.15,
        1.04,
    ),
    Bout(
        Build(1.40, 40.0, Proportions(legs=0.95, head=1.12)),
        Build(1.36, 38.0, Proportions(head=1.14, arms=0.97)),
        (5.4, 0.4),
        -3.0,
        0.78,
        0.42,
        0.92,
    ),
)
"""Who fights whom."""

_KICK = ((0.0, 0.0), (0.80, 0.76), (0.95, 1.10), (1.60, 1.70), (1.9, 2.0))
_DUCK = ((0.0, 1.46), (0.38, 1.86), (0.62, 2.16), (1.25, 2.90))
_WARD_AND_PUNCH = (
    (0.0, 0.25),
    (0.45, 0.74),
    (0.70, 1.05),
    (0.80, 1.32),
    (1.05, 1.80),
    (1.17, 2.20),
    (1.9, 3.05),
)
_ATTACK = (("kick", _KICK), ("duck", _DUCK))
_DEFENCE = (("ward_and_punch", _WARD_AND_PUNCH),)
"""Gestures, and which of their moments is when after the kick began, at pace 1 [s]."""


@dataclass(frozen=True, eq=False)
class Fighter:
    """Somebody with his body and his motion, before he looks at the other."""

    name: str
    bout: Bout
    build: Build
    skeleton: Skeleton
    body: Body
    parts: tuple[str, ...]
    motion: Motion

    @property
    def path(self) -> str:
        """Path of his Skeleton."""
        return f"/Fight/{self.name}/Skeleton"

    @property
    def attacks(self) -> bool:
        """Whether he is the one who attacks."""
        return self.build is self.bout.attacker

    @property
    def solids(self) -> tuple[Solid, ...]:
        """What he looks like."""
        return solids(self.build.height, self.build.proportions)

    def token(self, name: str) -> str:
        """Return the token of a joint by its last part."""
        names = [token.rsplit("/", 1)[-1] for token in self.skeleton.joints]
        return self.skeleton.joints[names.index(name)]

    def standing(self, name: str) -> tuple[Floats, Floats]:
        """Return where a joint is on the first frame, and how it is turned."""
        motion = self.motion.during(slice(0, 1))
        poses = forward(self.skeleton.parents, motion.translations, motion.rotations)
        joint = self.skeleton.index[self.token(name)]
        return poses[0][0, joint], poses[1][0, joint]


def fighters() -> list[Fighter]:
    """Return everybody, bout by bout, who attacks before who defends."""
    found = []
    for number, bout in enumerate(BOUTS, 1):
        for team, build in (("White", bout.attacker), ("Red", bout.defender)):
            found.append(_fighter(f"{team}{number}", bout, build))
    return found


def _fighter(name: str, bout: Bout, build: Build) -> Fighter:
    skeleton, body, parts = humanoid(build.height, mass=build.mass, proportions=build.proportions)
    played = _played(bout, _ATTACK if build is bout.attacker else _DEFENCE)
    space = Placement.identity(len(played.times))
    motion = restore(played, Morphology.of(skeleton, PartMap(parts)), space, up=UP)
    placed = _placed(motion, *_stand(bout, build))
    return Fighter(name, bout, build, skeleton, _stiff(body, parts), parts, placed)


def _stiff(body: Body, parts: Sequence[str]) -> Body:
    """Return a body whose collar bones give way only a little."""
    collars = [part.endswith("sternoclavicular") for part in parts]
    return replace(body, stiffness=np.where(collars, COLLAR, 0.0))


def _stand(bout: Bout, build: Build) -> tuple[Floats, Floats]:
    """Return where somebody stands, and how he is turned: the two face each other."""
    side, about = (-1.0, 0.0) if build is bout.attacker else (1.0, 180.0)
    facing, own = (from_vector(np.radians((0.0, bout.heading + each, 0.0))) for each in (0, about))
    aside, ahead = bout.place
    middle = np.array((aside, 0.0, ahead))
    return middle + rotate(facing, np.array((0.0, 0.0, 0.5 * side * bout.apart))), own


def _placed(motion: Motion, place: Floats, turn: Floats) -> Motion:
    """Return a motion about another place, turned by a rotation."""
    translations, rotations = np.array(motion.translations), np.array(motion.rotations)
    translations[:, 0] = place + rotate(turn, translations[:, 0])
    rotations[:, 0] = multiply(turn, rotations[:, 0])
    return Motion(motion.times, translations, rotations)


def _played(
    bout: Bout, gestures: tuple[tuple[str, tuple[tuple[float, float], ...]], ...]
) -> NormalizedMotion:
    """Return the guard with some gestures blended into it, one after the other."""
    times = np.arange(round(SECONDS * RATE) + 1) / RATE
    guard = _database()["guard"]
    played = warp(guard, times, np.mod(times, guard.times[-1]))
    for name, clock in gestures:
        own, seconds = np.array(clock).T
        there = np.array(bout.moments(*seconds))
        gesture = warp(_database()[name], times, np.interp(times, there, own))
        share = ease(times, (there[0], there[0] + _FADE, there[-1] - _FADE, there[-1]))
        played = blend([played, gesture], np.stack([1.0 - share, share], axis=1))
    return played


@cache
def _database() -> dict[str, NormalizedMotion]:
    """Return all that they know, without the body that knows it."""
    skeleton, _, parts = humanoid(HEIGHT)
    usual = Morphology.of(skeleton, PartMap(parts))

    def taken_off(name: str) -> NormalizedMotion:
        motion = performed(GESTURES[name])
        return normalize(motion, Placement.identity(motion.frame_count), usual, up=UP)

    return {name: taken_off(name) for name in GESTURES}

"""The two ways between a body and what depends on none, for one thing at a time."""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.travelling.meanings import Meanings

_UP = np.array([0.0, 1.0, 0.0])


class StaysBehind(Exception):
    """What is asked for cannot be said of the other body; the message says why, as a clause."""


@dataclass(frozen=True, eq=False)
class Way:
    """From a body to normalized lengths and parts, or back."""

    meanings: Meanings
    """The body."""
    onto: bool
    """Whether it leads onto the body; else from it."""
    there: str
    """Path of the prim that stands for the body at the other end, or of its Skeleton at this."""
    known: tuple[str, ...] = ()
    """The parts that names were chosen from, on the way onto a body."""

    @property
    def scale(self) -> float:
        """What a length is multiplied by."""
        return self.meanings.leg if self.onto else 1.0 / self.meanings.leg

    @property
    def world(self) -> Floats:
        """Rotation of the world, xyzw."""
        return conjugate(self.meanings.turn) if self.onto else self.meanings.turn

    def name(self, name: str) -> str:
        """Return what a joint is called at the other end.

        Raises:
            StaysBehind: There is no such joint.
        """
        joint = self.joint(name)
        return self.meanings.joints[joint] if self.onto else self.meanings.called(joint)

    def names(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return what recruited joints are called at the other end.

        Raises:
            StaysBehind: None of them is there.
        """
        if not names or not self.onto:
            return tuple(self.name(each) for each in names)
        found = self.meanings.recruited(names, self.known)
        if not found:
            raise StaysBehind(f"it may move {_listed(names)} alone, none of which is there")
        return tuple(self.meanings.joints[joint] for joint in found)

    def has(self, name: str) -> bool:
        """Tell whether there is a joint of that name."""
        return self.meanings.named(name) is not None

    def joint(self, name: str) -> int:
        """Return the joint that a name means on the body.

        Raises:
            StaysBehind: There is none.
        """
        joint = self.meanings.named(name)
        if joint is None:
            raise StaysBehind(f"there is no joint '{name}'")
        return joint

    def frame(self, name: str) -> Floats:
        """Return the rotation from the frame of a joint to that of its part, or back, xyzw."""
        frame = np.asarray(self.meanings.frames[self.joint(name)])
        return frame if self.onto else conjugate(frame)

    def place(self, places: Floats, joint: str) -> Floats:
        """Return world places that a joint is held at: heights count from where it stands.

        Args:
            places: Shape (…, 3).
            joint: What the joint is called; "" is none.
        """
        part = self.meanings.parts[self.joint(joint)] if joint else ""
        height = self.meanings.standing.get(part, 0.0) * _UP
        if self.onto:
            return np.asarray(rotate(self.world, places * self.scale + height))
        return np.asarray((rotate(self.world, places) - height) * self.scale)

    def facing(self, orientations: Floats, joint: str) -> Floats:
        """Return the orientations of a joint as those of its part, or back, (…, 4)."""
        return multiply(orientations, conjugate(self.frame(joint)))

    def axes(self, letters: str) -> str:
        """Return along which axes of the world something is held."""
        if np.array_equal(self.meanings.turn, (0.0, 0.0, 0.0, 1.0)):
            return letters
        return letters.translate(str.maketrans("yz", "zy"))


@dataclass(frozen=True, eq=False)
class Turned(Way):
    """Between two worlds, of what has no body: only the axes of the world change."""

    def name(self, name: str) -> str:
        """Return the name."""
        return name

    def names(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return the names."""
        return names

    def has(self, name: str) -> bool:
        """Tell that there are all joints."""
        return True

    def frame(self, name: str) -> Floats:
        """Return no rotation."""
        return np.array([0.0, 0.0, 0.0, 1.0])

    def place(self, places: Floats, joint: str) -> Floats:
        """Return world places in the other world."""
        return np.asarray(rotate(self.world, places))


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"'{name}'" for name in names[:3]) + (", …" if len(names) > 3 else "")

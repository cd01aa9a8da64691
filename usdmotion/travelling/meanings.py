"""What lengths, directions and joints mean on one body."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.humanoid import ANKLE, BALL, NECK, SPINE
from usdmotion.s4d import Morphology
from usdmotion.s4d.turns import swing

_NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])
_COLUMNS = (SPINE, NECK)


@dataclass(frozen=True, eq=False, kw_only=True)
class Meanings:
    """A body as what is said about it has to know it."""

    path: str
    """Path of the Skeleton."""
    joints: tuple[str, ...]
    """Token of each joint."""
    parts: tuple[str, ...]
    """H-Anim name of each joint, "" for none."""
    frames: Floats
    """The part's own frame in that of its joint, xyzw, shape (joint_count, 4); the joint's where it
    is no part."""
    leg: float
    """Length of a leg [m]."""
    standing: Mapping[str, float] = field(default_factory=dict)
    """How high parts of feet are while soles are on the ground [m], by the part; 0 of others."""
    turn: Floats = field(default_factory=lambda: _NO_TURN)
    """Rotation from the world to one with y up, xyzw, shape (4,)."""

    def __post_init__(self) -> None:
        count = len(self.joints)
        object.__setattr__(self, "frames", seal(self.frames, count, 4, name="frames"))
        object.__setattr__(self, "turn", seal(self.turn, 4, name="turn"))

    @classmethod
    def of(cls, path: str, morphology: Morphology, up: Floats) -> "Meanings":
        """Return what things mean on a body.

        Args:
            path: Path of the Skeleton.
            morphology: The body.
            up: The direction away from the ground in its world, shape (3,).
        """
        lengths = morphology.measures
        heights = {
            ANKLE: float(lengths.ankle_height[0]),
            BALL: float(lengths.ball_height[0]),
        }
        return cls(
            path=path,
            joints=morphology.skeleton.joints,
            parts=morphology.parts.parts,
            frames=morphology.part_frames,
            leg=morphology.leg_length,
            standing={f"{side}_{part}": each for side in "lr" for part, each in heights.items()},
            turn=swing(np.asarray(up, dtype=np.float64), np.array([0.0, 1.0, 0.0])),
        )

    @cached_property
    def _index(self) -> dict[str, int]:
        leaves = [token.rsplit("/", 1)[-1] for token in self.joints]
        once = {leaf: index for index, leaf in enumerate(leaves) if leaves.count(leaf) == 1}
        tokens = {token: index for index, token in enumerate(self.joints)}
        named = {part: index for index, part in enumerate(self.parts) if part}
        return once | tokens | named

    def named(self, name: str) -> int | None:
        """Return the joint that a part, a token or the last name of a token means, None for none.

        Of a vertebra that the body has not, it is the nearest one that it has.
        """
        found = self._index.get(name, self._index.get(name.rsplit("/", 1)[-1]))
        return self._nearest(name) if found is None else found

    def called(self, joint: int) -> str:
        """Return what a joint is called away from its body: the part that it is, else its token."""
        return self.parts[joint] or self.joints[joint]

    def recruited(self, names: tuple[str, ...], known: tuple[str, ...]) -> tuple[int, ...]:
        """Return the joints that some names recruit.

        Where two bodies have not as many vertebrae, each goes with the nearest that was there.

        Args:
            names: Parts or tokens.
            known: The parts that the names were chosen from.
        """
        found = {self._index[name] for name in names if name in self._index}
        found |= {self._index[leaf] for leaf in _leaves(names) if leaf in self._index}
        for column in _COLUMNS:
            there = [part for part in column if part in known]
            own = [part for part in column if part in self._index]
            for part in own if there else ():
                if _closest(column, part, there) in names:
                    found.add(self._index[part])
                else:
                    found.discard(self._index[part])
        return tuple(sorted(found))

    def _nearest(self, name: str) -> int | None:
        for column in _COLUMNS:
            own = [part for part in column if part in self._index]
            if name in column and own:
                return self._index[_closest(column, name, own)]
        return None


def _leaves(names: tuple[str, ...]) -> list[str]:
    return [name.rsplit("/", 1)[-1] for name in names]


def _closest(column: tuple[str, ...], part: str, others: list[str]) -> str:
    place = column.index(part)
    return min(others, key=lambda other: abs(column.index(other) - place))

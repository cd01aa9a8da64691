"""The rest pose of a body, seen from its own joints."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from usdmotion.anthropometry.segments import LIMBS
from usdmotion.arrays import Floats
from usdmotion.humanoid import PartMap
from usdmotion.kernels import conjugate, forward, rotate
from usdmotion.motion import Skeleton


class RestPose:
    """Where the joints of a body are at rest.

    Any pose will do: only lengths, and what a joint sees close by, are asked for.
    """

    def __init__(self, skeleton: Skeleton, parts: PartMap) -> None:
        self.skeleton = skeleton
        self.parts = parts
        positions, orientations = forward(
            skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
        )
        self._positions: Floats = positions[0]
        self._orientations: Floats = orientations[0]

    def seen(self, joint: int, other: int) -> Floats:
        """Return where another joint is in the frame of a joint [m], shape (3,)."""
        line = self._positions[other] - self._positions[joint]
        return rotate(conjugate(self._orientations[joint]), line)

    def way(self, top: str, end: str) -> list[int]:
        """Return the joints from one part down to another, none where it is not below."""
        first, last = self.parts.joint(top), self.parts.joint(end)
        if first is None or last is None:
            return []
        chain = self.skeleton.chain(last)
        return list(reversed(chain[: chain.index(first) + 1])) if first in chain else []

    def length(self, way: Sequence[int]) -> float:
        """Return how long a way is [m]."""
        return sum(self.distance(a, b) for a, b in pairwise(way))

    def distance(self, a: int, b: int) -> float:
        """Return how far apart two joints are [m]."""
        return float(np.linalg.norm(self._positions[a] - self._positions[b]))

    def onward(self, joint: int) -> Floats:
        """Return the direction that leads from the joint above on through a joint, in its frame."""
        for above in self.skeleton.chain(joint)[1:]:
            length = self.distance(joint, above)
            if length > 0.0:
                return -self.seen(joint, above) / length
        return np.zeros(3)

    @property
    def leg(self) -> float:
        """Mean length of the legs from hip to ankle [m]."""
        return 0.5 * sum(self.length(self.way(f"{s}_hip", f"{s}_talocrural")) for s in "lr")

    @property
    def is_whole(self) -> bool:
        """Whether head and limbs hang on the trunk as a body's do, and have lengths."""
        spans = [(f"{s}_{top}", f"{s}_{end}") for s in "lr" for top, end in LIMBS]
        ways = [self.way(*span) for span in (*spans, ("humanoid_root", "skullbase"))]
        back = set(ways[-1])
        return all(self.length(way) > 0.0 for way in ways) and back.issuperset(self.parts.spine)

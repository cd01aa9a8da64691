"""Several grounds as one: the highest of them is stood on."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.ground.contract import Ground


@dataclass(frozen=True, eq=False)
class SeveralGrounds:
    """Grounds beside and above each other."""

    grounds: tuple[Ground, ...]
    """At least one."""

    @classmethod
    def of(cls, grounds: Sequence[Ground]) -> Ground:
        """Return one ground for some, at least one."""
        return grounds[0] if len(grounds) == 1 else cls(tuple(grounds))

    def under(self, points: Floats, times: Floats) -> tuple[Floats, Floats]:
        """Return the height [m] and normal of the highest of them, as `Ground` has it."""
        height, normal = self.grounds[0].under(points, times)
        for each in self.grounds[1:]:
            other, lying = each.under(points, times)
            higher = ~(other <= height) & ~np.isnan(other)
            height = np.where(higher, other, height)
            normal = np.where(higher[..., None], lying, normal)
        return height, normal

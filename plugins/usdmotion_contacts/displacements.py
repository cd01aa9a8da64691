"""How an object moves in one step, in its own frame (2006, section 4)."""

from dataclasses import dataclass

import numpy as np

from usdmotion import Floats, Ints, Search
from usdmotion.kernels import kernel
from usdmotion.kernels.quaternions import inverse, product, quaternion_at, turned
from usdmotion_contacts.calm import Calm

SLACK = 1e-6
"""Times that differ by less are equal [s]."""


@dataclass(frozen=True, eq=False)
class Displacements:
    """D_i = W_i⁻¹ W_j of neighbouring poses i and j, which are a step apart.

    Where a step is s samples, n frames have n − s displacements. One at which the object rests says
    of frames i to j, both included, that they are one place: m in a row speak of m + s frames. A
    stop that lasts from frame a to frame b is seen by those from a to b − s, which together cover
    a to b again, so the step does not shorten what is found.
    """

    step: float
    """Time from pose to pose [s]; where samples are uneven, the least."""
    interval: float
    """Usual time between two samples [s]."""
    first: Ints
    """Frame i of each, shape (displacement_count,)."""
    last: Ints
    """Frame j of each, the first that is a step after i, shape (displacement_count,)."""
    times: Floats
    """The middle of each [s], shape (displacement_count,)."""
    translations: Floats
    """t of each, in frame i of the object [m], shape (displacement_count, 3)."""
    rotations: Floats
    """R of each, unit xyzw, shape (displacement_count, 4)."""
    calm: Calm
    """When the object rests, and what of its motion is noise."""

    @property
    def count(self) -> int:
        """How many there are; none of a motion that is shorter than a step."""
        return len(self.first)


def displacements(search: Search) -> Displacements:
    """Return the displacements of an object; with no step given, over one clear of noise."""
    times = search.times
    interval = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    calm = Calm.of(times, search.translations)
    step = search.step or calm.step(interval)
    last = np.searchsorted(times, times + (step - SLACK))
    last = np.maximum(last, np.arange(1, len(times) + 1))
    last = last[last < len(times)]
    first = np.arange(len(last))
    translations, rotations = np.empty((len(last), 3)), np.empty((len(last), 4))
    _displace(search.translations, search.rotations, last, translations, rotations)
    middle = 0.5 * (times[first] + times[last])
    return Displacements(step, interval, first, last, middle, translations, rotations, calm)


@kernel
def _displace(
    translations: Floats, rotations: Floats, last: Ints, moved: Floats, turns: Floats
) -> None:
    """(F, 3), (F, 4), (D,) into (D, 3), (D, 4)."""
    for i in range(last.shape[0]):
        j = last[i]
        back = inverse(quaternion_at(rotations, i))
        # The difference first: so it is exact far from the origin (2006, appendix A).
        way = (
            translations[j, 0] - translations[i, 0],
            translations[j, 1] - translations[i, 1],
            translations[j, 2] - translations[i, 2],
        )
        moved[i, 0], moved[i, 1], moved[i, 2] = turned(back, way)
        turn = product(back, quaternion_at(rotations, j))
        turns[i, 0], turns[i, 1], turns[i, 2], turns[i, 3] = turn

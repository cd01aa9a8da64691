"""A normalized motion with everything that travels with it."""

from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.s4d import NormalizedMotion
from usdmotion.travelling.carrying import Traveller
from usdmotion.travelling.settings import Settings

_WHOLE = 1e-6
"""Time codes closer to a whole one than this are it: seconds round them."""


@dataclass(frozen=True)
class Left:
    """A constraint that does not travel."""

    name: str
    """Its path below the edit."""
    why: str
    """A clause."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Luggage:
    """What goes from one body to another."""

    name: str
    """What the motion is called: the name of a prim."""
    motion: NormalizedMotion
    first: float
    """When it begins [s], as its stage counts."""
    travellers: tuple[Traveller, ...] = ()
    """Constraints without a body; the prim that stands for the body is named by `name`."""
    left: tuple[Left, ...] = ()
    """Constraints that could not leave the body that they are of."""
    settings: Settings = field(default_factory=Settings)
    """How the constraints are solved."""
    found: tuple[str, ...] = ()
    """Names of the contacts that were looked for on the way, as nobody had asked for any."""
    body: str = ""
    """What tells the body that it was recorded on from others, "" where nobody says."""
    source: str = ""
    """Path of the SkelAnimation that it was taken from."""

    def codes(self, rate: float) -> Floats:
        """Return the time code of each frame at some rate; those meant to be whole are."""
        codes = (self.first + self.motion.times) * rate
        whole = np.round(codes)
        return np.where(np.abs(codes - whole) < _WHOLE, whole, codes)

    @property
    def prim(self) -> str:
        """Path of the prim that stands for the body."""
        return f"/{self.name}"

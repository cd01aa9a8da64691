"""The contract between a motion and whatever finds what it already obeys."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.curves import Spline

KINDS = ("space", "line", "point", "plane", "slide")
"""What can be held: the frame of an object, a line of it, a point of it; a point that stays on a
plane, or on a line, while it moves."""

_ORIGIN = np.zeros((1, 3))


@dataclass(frozen=True)
class Template:
    """An example: a stretch of time during which an object is held, as somebody says who saw it."""

    kind: str
    """One of `KINDS`."""
    start: float
    """First time [s], inclusive."""
    end: float
    """Last time [s], inclusive."""


@dataclass(frozen=True, eq=False)
class NoisePattern:
    """How much an object that is held still moves in a step, over time (2006, section 6)."""

    sigma: Spline
    """Largest singular value of R − I that counts as not turning; it has no unit."""
    epsilon: Spline
    """Largest residual of a step that counts as not moving [m]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Search:
    """What a detector is given: how one object moves, and what to look for on it.

    Fields may be added, never taken away.
    """

    name: str
    """What the object is called, for sentences about it."""
    times: Floats
    """Seconds, ascending, shape (frame_count,)."""
    translations: Floats
    """World position of the object's frame [m], shape (frame_count, 3)."""
    rotations: Floats
    """World orientation of it, without scale, unit xyzw, shape (frame_count, 4)."""
    points: Floats = field(default_factory=lambda: _ORIGIN)
    """Points that stand for its size, in its frame [m], shape (point_count, 3): of a joint its own
    origin and where its segments end, of a prim the corners of its bounding box."""
    up: Floats = field(default_factory=lambda: np.array([0.0, 1.0, 0.0]))
    """The direction away from the ground, shape (3,)."""
    ground: float = float("nan")
    """Height of the ground along it [m]; not a number where nobody knows."""
    kinds: tuple[str, ...] = ("space",)
    """What to look for, some of `KINDS`."""
    templates: tuple[Template, ...] = ()
    """Examples on this object, in the order of their times."""
    pattern: NoisePattern | None = None
    """The noise pattern to use where there are no templates; None estimates one."""
    step: float = 0.0
    """Time between the two poses of a displacement [s]; 0 leaves it to the detector."""
    parallel_angle: float = 5.0
    """α_max: lines that differ by less are parallel [degrees]."""
    merge_distance: float = 0.03
    """dist_max: lines and points that are nearer to each other are one [m]."""
    gap: float = 0.4
    """F_max: the longest time that is bridged between two contacts at one place [s]."""
    gap_distance: float = 0.1
    """d_max: contacts farther apart are not bridged at all [m]."""
    minimum: float = 0.0
    """Contacts that last for less are dropped [s]."""

    def __post_init__(self) -> None:
        frames = len(self.times)
        shapes = {
            "times": (frames,),
            "translations": (frames, 3),
            "rotations": (frames, 4),
            "points": (None, 3),
            "up": (3,),
        }
        for name, shape in shapes.items():
            object.__setattr__(self, name, seal(getattr(self, name), *shape, name=name))


@dataclass(frozen=True, eq=False, kw_only=True)
class Contact:
    """A kinematic constraint that an object obeys for a while (2006, section 3.1)."""

    kind: str
    """One of `KINDS`."""
    start: float
    """Time of the first frame on which it holds [s]."""
    end: float
    """Time of the last [s]."""
    point: Floats
    """The point of the object that is held, in its frame [m], shape (3,): its origin of a space, a
    point of the axis of a line."""
    location: Floats
    """Where in the world that is [m], shape (3,); of what slides, a place on the plane or line."""
    orientation: Floats
    """World orientation of the object, unit xyzw, shape (4,): of a space the one that is held, of
    others that at the start."""
    axis: Floats = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    """World direction of a line, of the normal of a plane, or in which it slides, shape (3,)."""
    residual: float = 0.0
    """Largest distance of what is held from its place meanwhile [m]."""

    def __post_init__(self) -> None:
        for name, size in (("point", 3), ("location", 3), ("orientation", 4), ("axis", 3)):
            object.__setattr__(self, name, seal(getattr(self, name), size, name=name))


@dataclass(frozen=True, eq=False)
class Detected:
    """What was found on one object."""

    contacts: tuple[Contact, ...]
    """In the order of their times; those of one kind do not overlap."""
    pattern: NoisePattern | None = None
    """The noise pattern that was used; None of a detector that knows none."""
    notes: tuple[str, ...] = ()
    """One sentence about each thing that had to be guessed or left out."""
    left_out: Mapping[Template, str] = field(default_factory=dict)
    """The templates of the search from which nothing was learnt, each with the reason."""


@runtime_checkable
class Detector(Protocol):
    """Finds contacts of one object. Its dataclass fields made by `option` are its options."""

    name: ClassVar[str]

    def detect(self, search: Search) -> Detected:
        """Return what an object obeys.

        The answer does not depend on where in the world the motion is, nor on when it begins.

        Raises:
            OptionError: It cannot look for one of the kinds; the sentence lists what it can.
        """
        ...

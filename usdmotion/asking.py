"""What somebody asks a detection for, in words: names of joints, paths of prims, time codes."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Example:
    """A stretch of time in which somebody says that an object is held."""

    object: str
    """A joint, as its token, its leaf name or its H-Anim name; or the path of a prim."""
    start: float
    """First time code, inclusive."""
    end: float
    """Last time code, inclusive."""
    kind: str = "space"
    """How it is held, one of `detecting.KINDS`."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What is to be looked at, and for what; what is None or empty is left to the stage."""

    joints: tuple[str, ...] = ()
    """Joints, as tokens, leaf names or H-Anim names."""
    prims: tuple[str, ...] = ()
    """Paths of Xformable prims."""
    templates: tuple[Example, ...] = ()
    """Examples, on top of those that are on the stage."""
    kinds: tuple[str, ...] = ()
    """What to look for, some of `detecting.KINDS`."""
    detector: str = ""
    """Registered name of the detector."""
    options: Mapping[str, object] = field(default_factory=dict)
    """Options of it, on top of those on the stage."""
    minimum: float | None = None
    """Contacts that last for less are dropped [s]."""
    edit: str = ""
    """Path of the MotionEdit whose skeleton is looked at, and where contacts go."""
    skeletons: tuple[str, ...] = ()
    """Paths of the only Skeletons that are looked at; empty is all of them."""
    guides: bool = True
    """Whether contacts are drawn too, for people to look at."""


@dataclass(frozen=True)
class Span:
    """Frames of a picture, from a first to a last time code, inclusive."""

    first: float
    last: float
    step: float | None = None
    """Between two of them, in time codes; None spreads a usual number of frames evenly."""

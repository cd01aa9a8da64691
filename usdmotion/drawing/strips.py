"""Strips of poses, as papers show them: what is to be drawn, as plain values."""

from dataclasses import dataclass
from typing import Literal, Protocol

from usdmotion.arrays import Floats, Ints
from usdmotion.drawing.bodies import Kind
from usdmotion.drawing.mannequin import Mannequin
from usdmotion.motion import WorldPose

Color = str | tuple[float, float, float]


class Eye(Protocol):
    """From where something is seen."""

    def flat(self, points: Floats) -> Floats:
        """Return where points are in the picture, (…, 3) to (…, 2)."""
        ...

    def near(self, points: Floats) -> Floats:
        """Return how near points are, the nearest the largest, (…, 3) to (…,)."""
        ...

    def scale(self, points: Floats) -> Floats:
        """Return how long a metre across is in the picture at points, (…, 3) to (…,)."""
        ...


@dataclass(frozen=True, eq=False)
class Body:
    """A character as solid limbs."""

    mannequin: Mannequin
    pose: WorldPose
    """Of its joints, (joint_count, 3) and (joint_count, 4)."""
    kind: Kind


@dataclass(frozen=True, eq=False)
class Surface:
    """Something of polygons: a skin, a prop, a ground."""

    points: Floats
    """World [m], shape (point_count, 3)."""
    triangles: Ints
    """Shape (triangle_count, 3)."""
    color: tuple[float, float, float]
    """Linear, as USD has it."""
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Curve:
    """A polyline."""

    points: Floats
    """World [m], shape (point_count, 3)."""
    color: Color
    width: float = 1.2
    """In points of print."""
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Spot:
    """A place."""

    point: Floats
    """World [m], shape (3,)."""
    sign: Literal["goal", "held", "missed", "mass", "number"]
    color: Color
    opacity: float = 1.0
    text: str = ""
    """Written beside it."""


@dataclass(frozen=True, eq=False)
class Patch:
    """A flat area."""

    points: Floats
    """Its outline in the world [m], shape (corner_count, 3)."""
    color: Color
    opacity: float = 0.4


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture of a strip: a moment, seen from somewhere."""

    title: str
    eye: Eye
    bodies: tuple[Body, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    marks: tuple[Curve | Spot | Patch, ...] = ()
    ground: float | None = None
    """Height of the level ground to draw a grid on [m]; None draws none."""
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    window: tuple[float, float, float, float] | None = None
    """What is shown of the eye's picture: left, bottom, right, top; None shows all there is."""


@dataclass(frozen=True, eq=False)
class Row:
    """Panels beside each other, at one scale."""

    title: str
    panels: tuple[Panel, ...]


@dataclass(frozen=True, eq=False)
class Strip:
    """Rows below each other: views, or before and after."""

    rows: tuple[Row, ...]
    caption: str = ""

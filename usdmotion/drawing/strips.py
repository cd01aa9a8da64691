"""Strips of poses, as papers show them: what is to be drawn, as plain values."""

from dataclasses import dataclass
from typing import Literal

from usdmotion.arrays import Floats, Ints
from usdmotion.drawing.bodies import Kind
from usdmotion.drawing.eyes import Eye
from usdmotion.drawing.mannequin import Mannequin
from usdmotion.motion import WorldPose

Color = str | tuple[float, float, float]
"""As matplotlib names it, or linear as USD has it."""


@dataclass(frozen=True, eq=False)
class Body:
    """A character as solid limbs."""

    mannequin: Mannequin
    pose: WorldPose
    """Of its joints, (joint_count, 3) and (joint_count, 4)."""
    kind: Kind
    number: int = 0
    """Which of several characters, whose results differ in colour."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Something of polygons: a skin, a prop, a ground."""

    points: Floats
    """World [m], shape (point_count, 3)."""
    triangles: Ints
    """Shape (triangle_count, 3), their corners counterclockwise seen from outside."""
    color: tuple[float, float, float]
    """Linear, as USD has it."""
    opacity: float = 1.0
    both_sides: bool = False
    """Whether its back is seen too."""
    beyond: bool = False
    """Whether it may go beyond the panel, as a ground or a wall does."""


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
    beyond: bool = True
    """Whether it may go beyond the panel."""


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
    beyond: bool = False
    """Whether it may be outside of the panel, and is then left out."""


@dataclass(frozen=True, eq=False)
class Patch:
    """A flat area."""

    points: Floats
    """Its outline in the world [m], shape (corner_count, 3)."""
    color: Color
    opacity: float = 0.4
    beyond: bool = True
    """Whether it may go beyond the panel."""


Mark = Curve | Spot | Patch


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture of a strip: a moment, seen from somewhere."""

    title: str
    eye: Eye
    bodies: tuple[Body, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    marks: tuple[Mark, ...] = ()
    ground: float | None = None
    """Height of the level ground to draw a grid on [m]; None draws none."""
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)


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
    """What there is to be seen, in a sentence or two."""

"""What there is to see of a contact: held points, axis, number, the way in and out."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.guides.digits import strokes
from usdmotion.guides.palette import Color
from usdmotion.guides.polylines import simplified
from usdmotion.guides.soles import sole
from usdmotion.kernels import rotate

_UNKNOWN_SIZE = 0.12
"""Of an object that is one point, as the last joint of a limb [m]."""
_BEYOND = 0.25
"""How far an axis stands out beyond the object, over its size."""
_HEIGHT, _GAP = 0.6, 0.2
"""Height of a number, and how far it is above what is held, over the size of the object."""
_CLEAR, _APART = 1.2, 0.6
"""How near numbers may be, and how far one is lifted at a time, over their height."""
_MOST_SHIFTS = 20
"""So many places are tried for a number; above a heap of more it stays where it belongs."""
_LOW = 0.25
"""The lowest joint of somebody who stands on the plane of the origin is at most this far from it,
over the length of his foot: joints are inside him."""
_DETAIL = 0.03
"""How exactly ways are drawn, over the size of the object."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Held:
    """A contact and the object that it holds, in the world."""

    kind: str
    """space, line, point, plane or slide."""
    point: Floats
    """The point that is held, in the frame of the object [m], shape (3,)."""
    location: Floats
    """Where it is held [m], shape (3,)."""
    orientation: Floats
    """Of the object, while it is held wholly, xyzw, shape (4,)."""
    axis: Floats
    """Of a line, the normal of a plane, or the way of a slide, shape (3,)."""
    translations: Floats
    """Where the object is during the contact [m], shape (frame_count, 3), at least one frame."""
    rotations: Floats
    """How it is turned, xyzw, shape (frame_count, 4)."""
    way: Floats
    """Where it is from when the contact eases in until it has eased out [m], shape (count, 3)."""
    is_foot: bool = False
    """Whether it is the ankle or the ball of a foot."""
    ground: float = float("nan")
    """Height of the ground along the up axis [m]; not a number where nobody knows."""


@dataclass(frozen=True, eq=False)
class ContactGuide:
    """What there is to see of a contact, in the world."""

    marks: Floats
    """Points that are held [m], shape (mark_count, 3)."""
    axis: Floats
    """A polyline along what may turn or slide [m], shape (point_count, 3), or no points."""
    way: Floats
    """A polyline along the way of the object meanwhile [m]; one point where it stays."""
    number: tuple[Floats, ...]
    """Polylines [m], each (point_count, 3)."""
    translation: Floats
    """Where the object is in its contact [m], shape (3,)."""
    rotation: Floats
    """How it is turned there, xyzw, shape (4,)."""
    sole: Floats
    """Outline of what a foot leaves on the ground [m], shape (corner_count, 3), or no points."""


@dataclass(frozen=True, eq=False)
class ContactObject:
    """What is held by contacts."""

    path: str
    """Path of the prim; of a joint, of its Skeleton."""
    joint: str
    """Token of the joint; "" of a prim."""
    points: Floats
    """Points that stand for its size, in its frame [m], shape (point_count, 3)."""
    units: Floats
    """Metres per unit along the axes of its frame, shape (3,)."""
    start: float
    """Time code of the first frame of its motion."""
    course: Floats
    """A polyline along where it goes in all of that [m], shape (point_count, 3)."""

    @property
    def name(self) -> str:
        """What tells it from others."""
        return f"{self.path}:{self.joint.rsplit('/', 1)[-1]}" if self.joint else self.path


@dataclass(frozen=True, eq=False)
class ContactMark:
    """A contact on a stage, to be drawn anywhere."""

    path: str
    """Path of the MotionContactConstraint."""
    held: ContactObject
    """What it holds."""
    color: Color
    """That of its object."""
    number: int
    """By which it goes, of those of its object."""
    kind: str
    """space, line, point, plane or slide."""
    guide: ContactGuide
    first: float
    """Time code at which it begins to ease in."""
    start: float
    """Time code from which on it is fully on."""
    end: float
    """Time code until which it is."""
    last: float
    """Time code at which it has eased out."""
    always: bool
    """Whether it says no times, so that it is on throughout."""

    @property
    def object(self) -> str:
        """Name of what it holds: the path of a prim, or of a Skeleton and its joint."""
        return self.held.name


def size_of(points: Floats) -> float:
    """Return how large an object is, by points that stand for it [m]."""
    return float(np.linalg.norm(points, axis=1).max(initial=0.0)) or _UNKNOWN_SIZE


def contact_guide(
    held: Held, points: Floats, number: int, right: Floats, up: Floats
) -> ContactGuide:
    """Return what there is to see of a contact.

    Args:
        held: The contact.
        points: Points that stand for the size of the object, in its frame [m], (point_count, 3).
        number: What is written above it.
        right: To where numbers are read, shape (3,).
        up: Away from the ground, shape (3,).
    """
    size = size_of(points)
    translation, rotation = _pose(held)
    there = rotate(rotation, points) + translation
    marks = np.unique(there, axis=0) if held.kind == "space" else held.location[None]
    top = np.concatenate([there, marks]) @ up
    foot = held.location + (top.max() + _GAP * size - held.location @ up) * up
    return ContactGuide(
        marks=marks,
        axis=_axis(held, there, size),
        way=simplified(held.way, _DETAIL * size),
        number=tuple(
            foot + _HEIGHT * size * (stroke[:, :1] * right + stroke[:, 1:] * up)
            for stroke in strokes(number)
        ),
        translation=translation,
        rotation=rotation,
        sole=_sole(held, there, size, up),
    )


def apart(guides: Sequence[ContactGuide], up: Floats) -> tuple[ContactGuide, ...]:
    """Return guides with their numbers lifted so that none is drawn over one before it."""
    lifted: list[ContactGuide] = []
    feet = np.empty((len(guides), 3))
    for index, guide in enumerate(guides):
        points = np.concatenate(guide.number)
        height = np.ptp(points @ up)
        foot = points.mean(axis=0)
        shifts = _APART * height * np.arange(_MOST_SHIFTS)[:, None] * up
        ways = np.linalg.norm(feet[:index] - (foot + shifts)[:, None], axis=2)
        clear = (ways > _CLEAR * height).all(axis=1)
        shift = shifts[int(clear.argmax())]
        feet[index] = foot + shift
        lifted.append(replace(guide, number=tuple(stroke + shift for stroke in guide.number)))
    return tuple(lifted)


def trajectory(translations: Floats, points: Floats) -> Floats:
    """Return the way of an object as a polyline, one point where it stays.

    Args:
        translations: Where it is [m], shape (frame_count, 3).
        points: Points that stand for its size, in its frame [m], shape (point_count, 3).
    """
    return simplified(translations, _DETAIL * size_of(points))


def _pose(held: Held) -> tuple[Floats, Floats]:
    """Return where an object is in its contact: where it is held, or halfway through."""
    if held.kind == "space":
        return held.location - rotate(held.orientation, held.point), held.orientation
    middle = len(held.translations) // 2
    return held.translations[middle], held.rotations[middle]


def _axis(held: Held, there: Floats, size: float) -> Floats:
    """Return what an object turns about, or where its held point slides."""
    if held.kind not in ("line", "slide", "plane") or not held.axis.any():
        return np.zeros((0, 3))
    axis = held.axis / np.linalg.norm(held.axis)
    places = rotate(held.rotations, held.point) + held.translations
    if held.kind == "plane":
        return _square(axis, held.location, places, size)
    reach = (np.concatenate([there, places]) if held.kind == "line" else places) - held.location
    along = reach @ axis
    ends = np.array((along.min() - _BEYOND * size, along.max() + _BEYOND * size))
    return np.asarray(held.location + ends[:, None] * axis)


def _sole(held: Held, there: Floats, size: float, up: Floats) -> Floats:
    """Return the outline of a foot that stands; no points of what is none."""
    if held.kind != "space" or not held.is_foot:
        return np.zeros((0, 3))
    lowest = float((there @ up).min())
    # On a step or a hill it is not the one ground of the stage that it stands on.
    known = -_LOW * size <= lowest - held.ground <= size
    ground = 0.0 if abs(held.ground) <= _LOW * size else held.ground
    return sole(there, up, ground if known else lowest)


def _square(normal: Floats, location: Floats, places: Floats, size: float) -> Floats:
    """Return an outline in a plane around all places of the held point."""
    side = np.eye(3)[np.abs(normal).argmin()]
    first = np.cross(normal, side)
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    flat = (places - location) @ np.stack([first, second], axis=1)
    low, high = flat.min(axis=0) - _BEYOND * size, flat.max(axis=0) + _BEYOND * size
    corners = np.array([low, (high[0], low[1]), high, (low[0], high[1]), low])
    return np.asarray(location + corners @ np.stack([first, second]))

"""From where something is seen: without perspective, or through a lens."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from usdmotion.arrays import Floats

Window = tuple[float, float, float, float]
"""What a picture shows of its plane: left, bottom, right and top."""


class Eye(Protocol):
    """From where something is seen."""

    @property
    def window(self) -> Window | None:
        """What the picture shows; None shows whatever there is to be seen."""
        ...

    @property
    def limit(self) -> float:
        """What is nearer than this, as `near` has it, is not seen."""
        ...

    def flat(self, points: Floats) -> Floats:
        """Return where points are in the picture, (…, 3) to (…, 2)."""
        ...

    def near(self, points: Floats) -> Floats:
        """Return how near points are [m], the nearest the largest, (…, 3) to (…,)."""
        ...

    def size(self, points: Floats) -> Floats:
        """Return how large one metre is in the picture where points are, (…, 3) to (…,)."""
        ...


@dataclass(frozen=True, eq=False)
class Camera:
    """A view without perspective, in metres."""

    right: Floats
    up: Floats
    towards: Floats
    """To the eye; each of shape (3,)."""
    window: Window | None = None
    """What the picture shows [m]; None shows whatever there is to be seen."""
    limit: float = np.inf
    """What is nearer than this along `towards` is not seen [m]."""

    @classmethod
    def at(cls, facing: Floats, up: Floats, turn: float, rise: float) -> "Camera":
        """Return a camera that looks at somebody.

        Args:
            facing: Where he looks, level, shape (3,).
            up: Away from the ground, shape (3,).
            turn: How far the camera stands to his left [degrees]; 0 sees his face.
            rise: How far it looks down [degrees].
        """
        side, tilt = np.radians(turn), np.radians(rise)
        left = np.cross(up, facing)
        level = np.cos(side) * facing + np.sin(side) * left
        right = np.cross(up, level)
        towards = np.cos(tilt) * level + np.sin(tilt) * up
        return cls(right, np.cross(towards, right), towards)

    def flat(self, points: Floats) -> Floats:
        """Return where points are in the picture [m], (…, 3) to (…, 2)."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def near(self, points: Floats) -> Floats:
        """Return how near points are [m], (…, 3) to (…,)."""
        return np.asarray(points @ self.towards)

    def size(self, points: Floats) -> Floats:
        """Return 1 for each point: (…, 3) to (…,)."""
        return np.ones(points.shape[:-1])


@dataclass(frozen=True, eq=False)
class Perspective:
    """A view through a lens."""

    position: Floats
    """Where the eye is [m], shape (3,)."""
    right: Floats
    up: Floats
    towards: Floats
    """Against the line of sight; each of length one and of shape (3,)."""
    focal: float
    """Distance of the picture's plane, in the unit of `window`."""
    window: Window
    """What the picture shows of that plane: the aperture of the camera, moved by its offsets."""
    clip: float = 0.01
    """What is nearer to the eye than this along the line of sight is not seen [m]."""

    @property
    def limit(self) -> float:
        """What is nearer than this, as `near` has it, is not seen."""
        return -self.clip

    def flat(self, points: Floats) -> Floats:
        """Return where points before the eye are in the picture, (…, 3) to (…, 2)."""
        seen = points - self.position
        sides = np.stack([seen @ self.right, seen @ self.up], axis=-1)
        return np.asarray(sides * self.size(points)[..., None])

    def near(self, points: Floats) -> Floats:
        """Return how near points are along the line of sight [m], (…, 3) to (…,)."""
        return np.asarray((points - self.position) @ self.towards)

    def size(self, points: Floats) -> Floats:
        """Return how large one metre is in the picture where points are, (…, 3) to (…,)."""
        # What is behind the eye is cut before it is drawn, and must not be divided by nothing.
        return np.asarray(self.focal / np.maximum(-self.near(points), 0.5 * self.clip))


@dataclass(frozen=True, eq=False)
class Placed:
    """An eye whose picture is put somewhere on a sheet of paper, in points of print."""

    eye: Eye
    window: Window
    """Where on the sheet what is shown goes [points]."""
    scale: float
    """Points that one unit of the eye's picture is long."""
    shift: tuple[float, float]
    """Where the origin of the eye's picture is [points]."""

    @classmethod
    def at(cls, eye: Eye, window: Window, corner: tuple[float, float], scale: float) -> "Placed":
        """Return an eye with the lower left corner of a window of its picture put somewhere."""
        left, bottom, right, top = window
        x, y = corner
        place = x, y, x + scale * (right - left), y + scale * (top - bottom)
        return cls(eye, place, scale, (x - scale * left, y - scale * bottom))

    @property
    def limit(self) -> float:
        """What is nearer than this, as `near` has it, is not seen."""
        return self.eye.limit

    def flat(self, points: Floats) -> Floats:
        """Return where points are on the sheet [points], (…, 3) to (…, 2)."""
        return np.asarray(self.scale * self.eye.flat(points) + self.shift)

    def near(self, points: Floats) -> Floats:
        """Return how near points are [m], (…, 3) to (…,)."""
        return self.eye.near(points)

    def size(self, points: Floats) -> Floats:
        """Return how many points of print one metre is where points are, (…, 3) to (…,)."""
        return np.asarray(self.scale * self.eye.size(points))

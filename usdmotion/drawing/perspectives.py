"""The eye of a camera with a lens."""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats

NEAREST = 0.01
"""What is nearer to the eye than this, or behind it, is not seen [m]."""


@dataclass(frozen=True, eq=False)
class Perspective:
    """A view with perspective: what is one metre away has its own size in the picture."""

    place: Floats
    """Of the eye in the world [m], shape (3,)."""
    right: Floats
    up: Floats
    towards: Floats
    """Against the way it looks; each of shape (3,)."""

    def flat(self, points: Floats) -> Floats:
        """Return where points are in the picture, (…, 3) to (…, 2); nowhere what is not seen."""
        away = points - self.place
        scale = self.scale(points)[..., None]
        return scale * np.stack([away @ self.right, away @ self.up], axis=-1)

    def near(self, points: Floats) -> Floats:
        """Return how near points are [m], the nearest the largest, (…, 3) to (…,)."""
        return np.asarray((points - self.place) @ self.towards)

    def scale(self, points: Floats) -> Floats:
        """Return how long a metre across is in the picture, (…, 3) to (…,); NaN if not seen."""
        deep = -self.near(points)
        return np.where(self.sees(points), 1.0 / np.maximum(deep, NEAREST), np.nan)

    def sees(self, points: Floats) -> Bools:
        """Tell which points are before the eye, (…, 3) to (…,)."""
        return np.asarray(self.near(points) <= -NEAREST)

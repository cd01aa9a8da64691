"""A ground that a function tells the height of."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats, seal
from usdmotion.errors import SceneError
from usdmotion.ground.axes import across

_APART = 1e-3
"""How far to each side the height is asked for to tell the slope [m]."""


@dataclass(frozen=True, eq=False)
class FunctionGround:
    """The ground of a function, for programs (2005, section 7)."""

    height: Callable[[Floats, Floats], Floats]
    """Returns the height along the up axis [m], not a number where there is no ground, of places on
    the ground [m], shape (…, 2), at times [s] that broadcast against (…). A place is its x and z
    where y is up, its x and y where z is."""
    up: Floats
    """The direction away from the ground, shape (3,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "up", seal(self.up, 3, name="up"))

    def under(self, points: Floats, times: Floats) -> tuple[Floats, Floats]:
        """Return heights [m] and normals, as `Ground` has it; slopes are by differences.

        Raises:
            SceneError: The function does not return one height for each place.
        """
        axes = across(self.up)
        places, when = points @ axes.T, times[:, None]
        slopes = [
            (self._at(places + step, when) - self._at(places - step, when)) / (2.0 * _APART)
            for step in _APART * np.eye(2)
        ]
        normals = self.up - sum(
            np.nan_to_num(s)[..., None] * a for s, a in zip(slopes, axes, strict=True)
        )
        return self._at(places, when), normals / np.linalg.norm(normals, axis=-1, keepdims=True)

    def _at(self, places: Floats, times: Floats) -> Floats:
        found = np.asarray(self.height(places, times), dtype=np.float64)
        if found.shape not in ((), places.shape[:-1]):
            raise SceneError(
                f"the function of the ground returns heights of shape {found.shape} for places of "
                f"shape {places.shape}; return one height for each, as an array"
            )
        return np.broadcast_to(found, places.shape[:-1])

"""The frames in which the locations of contacts are written: those of the prims above them."""

from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.usd.transforms import is_still, rigid, world_matrices


@dataclass(frozen=True, eq=False)
class Frame:
    """A frame that does not move, in stage units."""

    translation: Floats
    rotation: Floats
    """xyzw."""
    scale: Floats
    """Along its axes."""
    is_world: bool = False
    """Whether it is the world's because those above move, so that a prim has to stand for it."""

    def point(self, world: Floats) -> Floats:
        """Return a point of the world in it, in its units."""
        inside = rotate(conjugate(self.rotation), world - self.translation)
        return np.asarray(inside / self.scale)

    def world_point(self, inside: Floats) -> Floats:
        """Return a point in it, in its units, as one of the world."""
        return np.asarray(self.translation + rotate(self.rotation, inside * self.scale))

    def world_orientation(self, inside: Floats) -> Floats:
        """Return an orientation in it as one of the world, xyzw."""
        return np.asarray(multiply(self.rotation, inside))

    def direction(self, world: Floats) -> Floats:
        """Return a direction of the world in it."""
        return np.asarray(rotate(conjugate(self.rotation), world))

    def orientation(self, world: Floats) -> Floats:
        """Return an orientation of the world in it, xyzw, the real part not negative."""
        found = multiply(conjugate(self.rotation), world)
        return np.asarray(-found if found[3] < 0.0 else found)


_WORLD = Frame(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), np.ones(3), is_world=True)


class Frames:
    """The frames above prims of a stage, each computed once."""

    def __init__(self, stage: Usd.Stage) -> None:
        self._stage = stage
        self._known: dict[str, Frame] = {}

    def above(self, path: str, time_codes: Floats) -> Frame:
        """Return the frame of what is below a prim that may not be there yet.

        Where that moves, or is no frame that a place can be given in, it is the world's.

        Args:
            path: Path of a prim without a transform of its own.
            time_codes: When it is not to move, shape (frame_count,).
        """
        there = Sdf.Path(path)
        while not self._stage.GetPrimAtPath(there):
            there = there.GetParentPath()
        # Those without a transform have the frame of the one above.
        key = str(there)
        if key not in self._known:
            self._known[key] = _frame(self._stage.GetPrimAtPath(there), time_codes)
        return self._known[key]


def _frame(prim: Usd.Prim, time_codes: Floats) -> Frame:
    matrices = world_matrices(prim, time_codes)
    if not is_still(matrices):
        return _WORLD
    try:
        translations, rotations, scales = rigid(matrices[:1], f"<{prim.GetPath()}>")
    except SceneError:
        return _WORLD
    return Frame(translations[0], rotations[0], scales[0])

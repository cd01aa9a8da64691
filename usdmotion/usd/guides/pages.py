"""What the guides of one edit are drawn with: units, sizes, times, colours."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pxr import Sdf

from usdmotion.arrays import Floats
from usdmotion.guides import COLORS, Color, thinned
from usdmotion.usd.guides.placements import Standing
from usdmotion.usd.guides.sheets import Sheet, author_home
from usdmotion.usd.layers import over

BEFORE: Color = (0.32, 0.36, 0.4)
"""Of the input."""
PALE = 0.35
"""Opacity of the input."""
_NEAR = 6e-4
"""How far what is shown may be from what is left out, over the size of a body: a mm."""


@dataclass(frozen=True, eq=False)
class Page:
    """What everything that is drawn of an edit shares."""

    sheet: Sheet
    home: str
    """Path of the edit's own guides."""
    codes: Floats
    """Time code of each frame, as the layer has it."""
    unit: float
    """Metres per unit of the stage."""
    size: float
    """Of the body, in those units."""
    up: Floats
    """Away from the ground, shape (3,)."""
    standings: Mapping[str, Standing]
    """How what is below the edit, "", or a constraint comes to have the frame of the world."""
    homes: Mapping[str, str]
    """Path of the guides of each constraint, by its own."""
    colors: Mapping[str, Color]
    """Of each constraint, by its path."""
    traced: frozenset[str]
    """Paths of the constraints whose effector has its whole way in the input drawn already."""

    @property
    def near(self) -> float:
        """How far what is shown may be from what is left out, in units of the stage."""
        return _NEAR * self.size

    def width(self, share: float) -> float:
        """Return a length by the size of the body, in units of the stage."""
        return float(f"{share * self.size:.3g}")

    def color(self, constraint: str) -> Color:
        """Return the colour of a constraint."""
        return self.colors.get(constraint, COLORS[0])

    def item(self, owner: str, name: str) -> Sdf.PrimSpec:
        """Return a new spec in the frame of the world.

        Args:
            owner: Path of the constraint that it belongs to; "" is the edit.
            name: What it is called.
        """
        layer = self.sheet.layer
        if not owner:
            spec = over(layer, f"{self.home}/{name}")
            self.standings[""].author(self.sheet, spec)
            return spec
        home = self.homes[owner]
        if not layer.GetPrimAtPath(home):
            self.standings[owner].author(self.sheet, author_home(self.sheet, home))
        return over(layer, f"{home}/{name}")

    def over_time(
        self, values: Floats, tolerance: float, frames: slice = slice(None)
    ) -> Floats | dict[float, Floats]:
        """Return values as they are written: one where nothing changes, else those that tell.

        Args:
            values: Shape (frame_count, …, size).
            tolerance: How far what is shown may be from what is left out.
            frames: The frames that matter.
        """
        codes, values = self.codes[frames], values[frames]
        kept = thinned(codes, values, tolerance)
        if len(kept) == 1:
            return np.asarray(values[0])
        return {float(codes[frame]): values[frame] for frame in kept}

    def in_stretches(
        self, values: Floats, tolerance: float, stretches: Sequence[tuple[int, int]]
    ) -> Floats | dict[float, Floats]:
        """Return values as they are written of what is there for some stretches of time alone.

        Args:
            values: Shape (frame_count, …, size).
            tolerance: How far what is shown may be from what is left out.
            stretches: First frame of each, at least one, and one past its last.
        """
        found: dict[float, Floats] = {}
        for first, end in stretches:
            part = self.over_time(values, tolerance, slice(first, end))
            if len(stretches) == 1:
                return part
            if isinstance(part, dict):
                found |= part
            else:
                # What does not move meanwhile stays until the end of its stretch.
                found |= {float(self.codes[frame]): part for frame in (first, end - 1)}
        return found


def seen(codes: Floats, on: np.ndarray) -> dict[float, bool]:
    """Return when something is seen: at the first frame, and wherever that changes."""
    changes = np.flatnonzero(np.diff(on, prepend=not on[0]))
    return {float(codes[frame]): bool(on[frame]) for frame in changes}

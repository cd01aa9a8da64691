"""Polygons that hide each other: drawn from far to near."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import BboxBase


@dataclass(frozen=True, eq=False)
class Polygons:
    """Shapes in a picture, and how near each is."""

    shapes: list[Floats]
    """Each of shape (corner_count, 2)."""
    near: Floats
    """The nearest the largest [m], shape (count,)."""
    fills: Floats
    """Colours as the screen has them, and opacities, shape (count, 4)."""
    edges: Floats
    """The same of their outlines."""
    widths: Floats
    """Of their outlines [points], shape (count,)."""

    @classmethod
    def plain(cls, shapes: Floats, near: Floats, fills: Floats) -> "Polygons":
        """Return polygons without a line around them, but for what closes the seams between them.

        Args:
            shapes: Shape (count, corner_count, 2).
            near: Shape (count,).
            fills: Shape (count, 4), or (4,) for all.
        """
        fills = np.broadcast_to(fills, (len(shapes), 4))
        # Lines would be seen where one may look through.
        widths = np.where(fills[:, 3] < 1.0, 0.0, 0.35)
        return cls(list(shapes), near, fills, fills, widths)

    @classmethod
    def together(cls, groups: Sequence["Polygons"]) -> "Polygons":
        """Return the polygons of all groups, the farthest first."""
        near = np.concatenate([each.near for each in groups] or [np.zeros(0)])
        order = np.argsort(near, kind="stable")
        shapes = [shape for each in groups for shape in each.shapes]
        fills, edges = (
            np.concatenate([getattr(each, name) for each in groups] or [np.zeros((0, 4))])[order]
            for name in ("fills", "edges")
        )
        widths = np.concatenate([each.widths for each in groups] or [np.zeros(0)])
        return cls([shapes[one] for one in order], near[order], fills, edges, widths[order])

    def draw(
        self,
        axes: "Axes",
        *,
        order: float,
        clip: "BboxBase | None" = None,
        fineness: float = 1.0,
    ) -> None:
        """Draw them from the first to the last.

        Args:
            axes: Where.
            order: What else is drawn with a lower one is below them.
            clip: What is outside of it is not drawn; None draws everything in the axes.
            fineness: How wide outlines are, over how wide they say they are.
        """
        from matplotlib.collections import PolyCollection

        drawn = PolyCollection(
            self.shapes,
            facecolors=self.fills,
            edgecolors=self.edges,
            linewidths=fineness * self.widths,
            zorder=order,
        )
        axes.add_collection(drawn, autolim=False)
        if clip is not None:
            drawn.set_clip_box(clip)


def rgb(color: str | tuple[float, float, float], opacity: float = 1.0) -> Floats:
    """Return a colour as the screen has it, and its opacity, shape (4,).

    Args:
        color: As matplotlib names it, or linear as USD has it.
        opacity: 0..1.
    """
    if isinstance(color, str):
        from matplotlib.colors import to_rgb

        return np.array((*to_rgb(color), opacity))
    return np.append(screen(np.array(color)), opacity)


def screen(linear: Floats) -> Floats:
    """Return linear values of colours as the screen has them (IEC 61966-2-1), 0..1."""
    light = np.clip(linear, 0.0, 1.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)


def over_white(color: Floats) -> Floats:
    """Return a colour with an opacity as it looks on white paper, opaque, (4,) to (4,)."""
    return np.append(1.0 - color[3] * (1.0 - color[:3]), 1.0)

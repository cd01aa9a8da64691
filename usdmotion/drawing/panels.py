"""One panel of a strip: the ground, what is solid from far to near, and the signs above it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.bodies import limbs
from usdmotion.drawing.cutting import pieces
from usdmotion.drawing.eyes import Placed
from usdmotion.drawing.framing import size
from usdmotion.drawing.polygons import Polygons, rgb
from usdmotion.drawing.signs import draw_spots
from usdmotion.drawing.solids import curve, outline, patch, surface
from usdmotion.drawing.strips import Body, Curve, Panel, Patch, Spot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import TransformedBbox

_SQUARE = 0.3
"""About how wide a square of the ground is, over the height of a body: half a metre for people."""
_SQUARES = 8.0
"""About how many squares are across where there is no body."""
_STEPS = np.log10((0.5, 1.0, 2.0, 5.0))
_MOST_SQUARES = 40
_GRID = "#e1e6ea"
_BEFORE = 0.17
"""How much nearer a result is taken to be than it is, where its input is drawn behind it, over the
height of the body."""
_THROUGH = 0.28
"""How strong a curve is where a body hides it."""
_SMALL = 0.06
"""Longest edge of a triangle before it is cut, over the width of the picture."""
_GROUND = 0.9
"""How much nearer a limb is taken than it is, over that edge: it stands on what it touches."""


_LARGE, _FINEST = 110.0, 0.45
"""Height of a body from which on lines and signs are as wide as they say [points], and how much
thinner they are at most over one that is smaller."""


def draw_panel(sheet: "Axes", panel: Panel, eye: Placed) -> None:
    """Draw a panel.

    Args:
        sheet: Where, in points of print.
        panel: What.
        eye: Its eye, put where the panel is on the sheet.
    """
    from matplotlib.transforms import Bbox, TransformedBbox

    clip = TransformedBbox(Bbox.from_extents(*eye.window), sheet.transData)
    _Drawn(sheet, panel, eye, _middle(panel), clip).draw()


def _middle(panel: Panel) -> Floats:
    """Return the middle of what there is to be seen [m], shape (3,)."""
    surfaces = [each for each in panel.surfaces if len(each.points)]
    there = [body.pose[0].mean(axis=0) for body in panel.bodies]
    there += [each.points.mean(axis=0) for each in surfaces if not each.beyond]
    there += [each.points.mean(axis=0) for each in surfaces[:1]] if not there else []
    return np.asarray(np.mean(there or [np.zeros(3)], axis=0))


@dataclass(frozen=True, eq=False)
class _Drawn:
    """A panel on its place."""

    sheet: "Axes"
    panel: Panel
    eye: Placed
    middle: Floats
    """Of what there is to be seen [m]."""
    clip: "TransformedBbox"
    """Beyond which nothing is drawn."""

    @property
    def across(self) -> float:
        """How wide the picture is in the middle [m]."""
        return size(self.eye.window)[0] / float(self.eye.size(self.middle))

    @property
    def square(self) -> float:
        """How wide a square of the ground is, one, two or five of some power of ten [m]."""
        heights = [_SQUARE * body.mannequin.height for body in self.panel.bodies]
        about = float(np.log10(max(heights, default=self.across / _SQUARES)))
        steps = np.floor(about) + _STEPS
        return float(10.0 ** steps[np.abs(steps - about).argmin()])

    @property
    def fineness(self) -> float:
        """How wide lines and signs are, over how wide they say they are."""
        heights = [body.mannequin.height for body in self.panel.bodies]
        tall = max(heights, default=np.inf) * float(self.eye.size(self.middle))
        return float(np.clip(tall / _LARGE, _FINEST, 1.0))

    def draw(self) -> None:
        """Draw the ground, what is solid, curves through that, and signs."""
        if self.panel.ground is not None:
            self._lines(self._grid(self.panel.ground), 0.0, colors=_GRID, linewidths=0.6)
        solids = Polygons.together(list(self._solids()))
        solids.draw(self.sheet, order=1.0, clip=self.clip, fineness=self.fineness)
        self._through()
        self._spots()

    def _solids(self) -> Iterator[Polygons]:
        """Yield what hides each other."""
        panel, eye = self.panel, self.eye
        up, longest, fineness = np.array(panel.up), _SMALL * self.across, self.fineness
        for each in panel.surfaces:
            yield surface(each, eye, up, longest)
        for body in panel.bodies:
            yield self._body(body, _GROUND * longest)
        for mark in panel.marks:
            if isinstance(mark, Patch) and len(mark.points) > 2:
                yield patch(mark, eye, longest)
                yield curve(outline(mark), eye, fineness, 0.7 * longest)
            elif isinstance(mark, Curve) and not mark.dashed:
                # Of two that are at one place the stronger is seen.
                yield curve(mark, eye, fineness, (0.6 + 0.9 * mark.opacity) * longest)

    def _body(self, body: Body, lift: float) -> Polygons:
        """Return the limbs of a body, those of a result before those of an input."""
        drawn = limbs(body.mannequin, self.eye, body.pose, body.kind, body.number)
        kinds = {each.kind for each in self.panel.bodies}
        if body.kind != "before" and "before" in kinds:
            lift += _BEFORE * body.mannequin.height
        return replace(drawn, near=drawn.near + lift)

    def _through(self) -> None:
        """Draw curves, pale where something hides them, that are not among what is solid."""
        for dashed in (False, True):
            curves = [m for m in self.panel.marks if isinstance(m, Curve) and m.dashed == dashed]
            runs = [
                (self.eye.flat(run), each)
                for each in curves
                for run in pieces(each.points, self.eye)
            ]
            part = 1.0 if dashed else _THROUGH
            self._lines(
                [run for run, _ in runs],
                2.0,
                colors=[tuple(rgb(each.color, part * each.opacity)) for _, each in runs],
                linewidths=[self.fineness * each.width for _, each in runs],
                linestyles=(0.0, (2.5, 1.8)) if dashed else "solid",
            )

    def _spots(self) -> None:
        """Draw signs, those left out that are behind the eye or beside the picture."""
        spots = [mark for mark in self.panel.marks if isinstance(mark, Spot)]
        there = np.array([spot.point for spot in spots]).reshape(-1, 3)
        places = self.eye.flat(there)
        left, bottom, right, top = self.eye.window
        inside = ((places >= (left, bottom)) & (places <= (right, top))).all(axis=1)
        seen = np.flatnonzero(inside & (self.eye.near(there) < self.eye.limit))
        shown = [spots[index] for index in seen]
        draw_spots(self.sheet, shown, places[seen], self.eye.window, self.fineness)

    def _grid(self, level: float) -> list[Floats]:
        """Return squares on level ground under the middle, as lines."""
        up, middle, square = np.array(self.panel.up), self.middle, self.square
        count = min(int(np.ceil(0.75 * self.across / square)) + 1, _MOST_SQUARES)
        first, second = (np.eye(3)[each] for each in np.argsort(np.abs(up), kind="stable")[:2])
        steps = square * np.arange(-count, count + 1)
        lines = []
        for along, aside in ((first, second), (second, first)):
            start, beside = (square * np.round(middle @ way / square) for way in (along, aside))
            for step in steps:
                line = (start + steps)[:, None] * along + (beside + step) * aside + level * up
                lines += [self.eye.flat(run) for run in pieces(line, self.eye)]
        return lines

    def _lines(self, lines: list[Floats], order: float, **said: Any) -> None:
        from matplotlib.collections import LineCollection

        drawn = LineCollection(lines, zorder=order, **said)
        self.sheet.add_collection(drawn, autolim=False)
        drawn.set_clip_box(self.clip)

"""The centre of mass over what it is supported by."""

import numpy as np
from pxr import Sdf

from usdmotion.arrays import Floats
from usdmotion.guides import COLORS, SupportGuide, support_guide
from usdmotion.quality import runs
from usdmotion.showing.shown import BalanceMark
from usdmotion.usd.guides.courses import draw_ways
from usdmotion.usd.guides.pages import Page, seen
from usdmotion.usd.guides.prims import (
    author_color,
    author_curve,
    author_mesh,
    author_opacity,
    author_points,
    author_visibility,
    make,
    move,
)
from usdmotion.usd.layers import over, set_value

CENTER = "CenterOfMass"
SUPPORTS = "Supports"
MASS = COLORS[6]
"""Colour of a centre of mass."""
_GROUND = COLORS[2]
_SPOT, _LINE, _MARGIN = 0.025, 0.002, 0.01
"""Size of the point, thickness of its drop line, and how far the area goes around its corners, over
the size of the body."""
_AREA = 0.35
"""Opacity of the area."""


def draw_balance(page: Page, mark: BalanceMark) -> None:
    """Draw a centre of mass, where it goes, what it is above, and the area below it."""
    owner = mark.path if mark.path in page.homes else ""
    now = mark.before if mark.after is None else mark.after
    center = _draw_center(page, owner, now)
    draw_ways(page, owner, CENTER, mark.before, mark.after, MASS)
    margin = _MARGIN * page.size * page.unit
    area = support_guide(mark.supports, mark.bearing, page.up, margin)
    if area.there.any():
        _draw_area(page, page.item(owner, SUPPORTS), area)
        _draw_drop(page, over(center.layer, f"{center.path}/Drop"), now, area)


def _draw_center(page: Page, owner: str, places: Floats) -> Sdf.PrimSpec:
    center = page.item(owner, CENTER)
    make(center, "Xform")
    spot = over(center.layer, f"{center.path}/Spot")
    author_points(spot, np.zeros((1, 3)), page.width(_SPOT), MASS)
    author_opacity(spot, 1.0)
    move(center, page.over_time(places / page.unit, page.near), None, page.near)
    return center


def _draw_area(page: Page, prim: Sdf.PrimSpec, area: SupportGuide) -> None:
    corners = _in_stretches(page, area, area.corners / page.unit)
    count = area.corners.shape[1]
    author_mesh(prim, corners, [count], range(count), page.width(_MARGIN))
    set_value(prim, "doubleSided", Sdf.ValueTypeNames.Bool, True)
    author_color(prim, _GROUND)
    author_opacity(prim, _AREA)
    _hide(page, prim, area)


def _draw_drop(page: Page, prim: Sdf.PrimSpec, places: Floats, area: SupportGuide) -> None:
    """Draw from a centre of mass, where it is, straight down to the height of the lowest corner."""
    lowest = (area.corners @ page.up).min(axis=1)
    below = (lowest - places @ page.up)[:, None] * page.up
    ends = np.stack([np.zeros_like(below), below], axis=1) / page.unit
    author_curve(prim, _in_stretches(page, area, ends), page.width(_LINE), MASS)
    author_opacity(prim, 0.6)
    _hide(page, prim, area)


def _in_stretches(page: Page, area: SupportGuide, values: Floats) -> Floats | dict[float, Floats]:
    """Return values thinned in each stretch in which the corners follow the same points."""
    stretches = [
        stretch
        for run in range(int(area.runs[-1]) + 1)
        for stretch in runs((area.runs == run) & area.there)
    ]
    return page.in_stretches(values, page.near, stretches)


def _hide(page: Page, prim: Sdf.PrimSpec, area: SupportGuide) -> None:
    if not area.there.all():
        author_visibility(prim, seen(page.codes, area.there))

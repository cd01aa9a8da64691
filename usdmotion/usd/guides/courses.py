"""Trajectories of effectors, what is wanted of them, and what is missed."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.guides import MISSED, Color, simplified
from usdmotion.quality import runs
from usdmotion.showing.shown import Course, Miss
from usdmotion.usd.guides.pages import BEFORE, PALE, Page, seen
from usdmotion.usd.guides.prims import (
    author_curve,
    author_opacity,
    author_points,
    author_visibility,
)

BEFORE_NAME, AFTER_NAME, MISSED_NAME = "Before", "After", "Missed"
_LINE, _THICK, _SPOT = 0.002, 0.004, 0.02
"""Thickness of the way before and after, and of points, over the size of the body."""
_APART = 0.002
"""How far two ways are from each other at least where they are seen as two, over that size."""


def draw_course(page: Page, course: Course) -> None:
    """Draw where an effector goes in the input, and in the result where that is elsewhere."""
    if course.path in page.homes:
        color, traced = page.color(course.path), course.path in page.traced
        draw_ways(page, course.path, "", course.before, course.after, color, drawn=traced)


def draw_ways(
    page: Page,
    owner: str,
    name: str,
    before: Floats,
    after: Floats | None,
    color: Color,
    *,
    drawn: bool = False,
) -> None:
    """Draw a way before and after, or one where nobody could tell them apart.

    Args:
        page: What to draw with.
        owner: Path of the constraint that they belong to; "" is the edit.
        name: What the names of the guides begin with.
        before: In the input [m], shape (frame_count, 3).
        after: In the result.
        color: Of the result.
        drawn: Whether somebody else draws the way in the input.
    """
    now = before if after is None else after
    differ = np.linalg.norm(now - before, axis=1).max() > _APART * page.size * page.unit
    if (differ or after is None) and not drawn:
        _draw_way(page, owner, f"{name}{BEFORE_NAME}", before, _LINE, BEFORE)
    if after is not None and (differ or not drawn):
        _draw_way(page, owner, f"{name}{AFTER_NAME}", now, _THICK, color)


def draw_miss(page: Page, miss: Miss) -> None:
    """Draw from where an effector is to where it is wanted, while it is not there."""
    if not miss.missed.any() or miss.path not in page.homes:
        return
    prim = page.item(miss.path, MISSED_NAME)
    ends = [miss.places] if miss.wanted is None else [miss.places, miss.wanted]
    places = np.stack(ends, axis=1) / page.unit
    shown = page.in_stretches(places, page.near, _seen_until(miss))
    if miss.wanted is None:
        author_points(prim, shown, page.width(_SPOT), MISSED)
    else:
        author_curve(prim, shown, page.width(_THICK), MISSED)
    author_opacity(prim, 1.0)
    if not miss.missed.all():
        author_visibility(prim, seen(page.codes, miss.missed))


def _seen_until(miss: Miss) -> list[tuple[int, int]]:
    """Return the frames of each stretch, and the one after it, until which USD shows the last."""
    count = len(miss.missed)
    return [(first, min(end + 1, count)) for first, end in runs(miss.missed)]


def _draw_way(
    page: Page, owner: str, name: str, places: Floats, share: float, color: Color
) -> None:
    way = simplified(places / page.unit, page.near)
    width = page.width(share)
    prim = page.item(owner, name)
    if len(way) == 1:
        author_points(prim, way, page.width(_SPOT), color)
    else:
        author_curve(prim, way, width, color)
    # A contact above is pale while it is not on.
    author_opacity(prim, PALE if color == BEFORE else 1.0)

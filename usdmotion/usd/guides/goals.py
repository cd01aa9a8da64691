"""Goals as markers that are seen from every side, as bright as they are active."""

from collections.abc import Sequence

import numpy as np
from pxr import Gf, Sdf, UsdGeom, Vt

from usdmotion.arrays import Floats
from usdmotion.guides import OCTAHEDRON_FACES, Color, octahedron
from usdmotion.showing.shown import GoalMark, Link
from usdmotion.usd.guides.courses import AFTER_NAME, BEFORE_NAME, MISSED_NAME
from usdmotion.usd.guides.pages import Page
from usdmotion.usd.guides.prims import (
    author_color,
    author_curve,
    author_curves,
    author_mesh,
    author_opacity,
    make,
    move,
)
from usdmotion.usd.guides.sheets import OF_CONTACT
from usdmotion.usd.layers import over, set_varying

_PLACE, _FRAME = "Goal", "TurnedGoal"
"""The classes below the guides of an edit that its markers are copies of."""
_RADIUS, _LENGTH, _LINE = 0.018, 0.06, 0.003
"""Of a marker, of its axes, and how thick those are, over the size of the body."""
_AXES: tuple[Color, ...] = ((0.8, 0.05, 0.05), (0.08, 0.5, 0.05), (0.05, 0.15, 0.8))
_FAINT = 0.1
"""Opacity of a goal that is not active, so that it is seen where it will be."""
_STEP = 0.01
"""How exactly activities and rotations are shown."""
_DISTANCE = "Distance"
_TAKEN = (BEFORE_NAME, AFTER_NAME, MISSED_NAME, _DISTANCE, *OF_CONTACT)


def draw_goals(page: Page, goals: Sequence[GoalMark]) -> None:
    """Draw goals, and what they are copies of once."""
    shown = [goal for goal in goals if _owner(goal) in page.homes]
    layer = page.sheet.layer
    if any(goal.rotations is None for goal in shown):
        _author_marker(over(layer, f"{page.home}/{_PLACE}"), page, turned=False)
    if any(goal.rotations is not None for goal in shown):
        _author_marker(over(layer, f"{page.home}/{_FRAME}"), page, turned=True)
    for goal in shown:
        _draw_goal(page, goal)


def draw_link(page: Page, link: Link) -> None:
    """Draw a line between two points that are to be so far apart, as bright as that is active."""
    prim = page.item(link.path, _DISTANCE)
    ends = (link.before if link.after is None else link.after) / page.unit
    author_curve(prim, page.over_time(ends, page.near), page.width(_LINE), page.color(link.path))
    _author_activity(page, prim, link.activity)


def _draw_goal(page: Page, goal: GoalMark) -> None:
    owner, name = _owner(goal), goal.path.rsplit("/", 1)[-1]
    prim = page.item(owner, f"{name}_" if name in _TAKEN else name)
    make(prim, "Xform")
    turned = goal.rotations is not None
    prim.inheritPathList.Prepend(Sdf.Path(f"{page.home}/{_FRAME if turned else _PLACE}"))
    rotations = None
    if goal.rotations is not None:
        rotations = page.over_time(_smooth(goal.rotations), _STEP)
    places = page.over_time(goal.translations / page.unit, page.near)
    move(prim, places, rotations, page.near)
    author_color(prim, page.color(owner))
    _author_activity(page, prim, goal.activity)


def _author_activity(page: Page, prim: Sdf.PrimSpec, activity: Floats) -> None:
    opacity = page.over_time(_FAINT + (1.0 - _FAINT) * activity[:, None], _STEP)
    if isinstance(opacity, dict):
        author_opacity(prim, {code: _percent(each) for code, each in opacity.items()})
    else:
        author_opacity(prim, _percent(opacity))


def _author_marker(prim: Sdf.PrimSpec, page: Page, *, turned: bool) -> None:
    make(prim, "Xform")
    prim.specifier = Sdf.SpecifierClass
    corners = OCTAHEDRON_FACES.ravel().tolist()
    marker = over(prim.layer, f"{prim.path}/Marker")
    radius = page.width(_RADIUS)
    author_mesh(marker, octahedron(radius), [3] * len(OCTAHEDRON_FACES), corners, radius)
    if turned:
        lines = [np.array([np.zeros(3), page.width(_LENGTH) * axis]) for axis in np.eye(3)]
        axes = over(prim.layer, f"{prim.path}/Axes")
        author_curves(axes, lines, page.width(_LINE), _AXES[0])
        colors = Vt.Vec3fArray([Gf.Vec3f(*color) for color in _AXES])
        kind = Sdf.ValueTypeNames.Color3fArray
        set_varying(axes, "primvars:displayColor", kind, colors, UsdGeom.Tokens.uniform)


def _owner(goal: GoalMark) -> str:
    return goal.path.rsplit("/", 1)[0]


def _smooth(rotations: Floats) -> Floats:
    """Return the same rotations with signs by which neighbours are near."""
    along = np.einsum("fi,fi->f", rotations[1:], rotations[:-1])
    signs = np.where(np.cumsum(np.concatenate([[False], along < 0.0])) % 2, -1.0, 1.0)
    return np.asarray(rotations * signs[:, None])


def _percent(opacity: Floats) -> float:
    return round(float(opacity[0]), 2)

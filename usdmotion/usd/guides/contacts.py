"""Guides of contacts: under each contact what is held, where, when, and by which number it goes.

They stand under the contact, so that switching it off hides them; what all contacts of an object
share is written once under its detection.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.guides import Color, ContactGuide, apart, contact_guide, size_of, trajectory
from usdmotion.usd.detections.authoring import Authored
from usdmotion.usd.detections.contact_prims import contact_prims
from usdmotion.usd.detections.searches import Sought
from usdmotion.usd.drawn import GUIDES
from usdmotion.usd.guides.colors import TRAJECTORY, colors_of
from usdmotion.usd.guides.holds import opacity_of, read_held
from usdmotion.usd.guides.prims import (
    author_curves,
    author_opacity,
    author_points,
    guide,
    make,
    place,
)
from usdmotion.usd.guides.shapes import SHAPE, Shape, author_ghost, author_shape, shape_of
from usdmotion.usd.guides.skins import Skins
from usdmotion.usd.layers import over
from usdmotion.usd.transforms import is_still, matrices_of, world_matrices

_RIGHT = {"Y": np.sqrt((0.5, 0.0, 0.5)) * (1.0, 0.0, -1.0), "Z": np.sqrt((0.5, 0.5, 0.0))}
"""Numbers are read from the front, and from the side that is on the right of it."""
_STROKE, _THIN, _MARK = 0.04, 0.012, 0.1
"""Thickness of curves, of the whole trajectory, and of points, over the size of the object."""
_WHOLE = 0.5
"""Opacity of a whole trajectory."""


@dataclass(frozen=True, eq=False)
class _Drawing:
    """A contact as it is to be drawn."""

    path: str
    guide: ContactGuide
    opacity: Mapping[float, float] | float
    there: Mapping[str, bool]
    """Names of guides that are there, and whether they are on."""


@dataclass(frozen=True, eq=False)
class _Sheet:
    """The contacts of one object as they are to be drawn."""

    sought: Sought
    color: Color
    placement: Floats | None
    """Takes places in the world to the frame of the detection, (4, 4); None where that moves."""
    drawings: tuple[_Drawing, ...]
    shape: Shape | None


def author_contact_guides(stage: Usd.Stage, authored: Sequence[Authored]) -> None:
    """Draw the contacts of the objects that were looked at, in the edit target of their stage.

    What is drawn is what the contacts say now, whoever wrote them.

    Args:
        stage: The stage, with the contacts on it.
        authored: The objects.
    """
    colors = colors_of(stage, [each.found.sought.path for each in authored])
    skins: dict[str, Skins] = {}
    sheets = [
        _sheet(stage, each.found.sought, color, skins)
        for each, color in zip(authored, colors, strict=True)
    ]
    layer = stage.GetEditTarget().GetLayer()
    with Sdf.ChangeBlock():
        for sheet in sheets:
            _draw_object(layer, sheet)
            for drawing in sheet.drawings:
                _draw_contact(layer, sheet, drawing)


def _sheet(stage: Usd.Stage, sought: Sought, color: Color, skins: dict[str, Skins]) -> _Sheet:
    performer = sought.watched.performer
    skin = None
    if performer is not None:
        skin = skins.setdefault(performer.path, Skins(performer.prim))
    detection = stage.GetPrimAtPath(sought.path)
    contacts = [prim for prim in contact_prims(detection) if prim.IsActive()]
    up = sought.facts.up
    guides = [
        contact_guide(
            read_held(prim, sought.trajectory, sought.facts),
            sought.trajectory.points,
            number,
            _RIGHT[sought.facts.up_axis],
            up,
        )
        for prim, number in zip(contacts, _numbers(contacts), strict=True)
    ]
    return _Sheet(
        sought=sought,
        color=color,
        placement=_placement(detection, sought),
        drawings=tuple(
            _drawing(prim, shown, sought)
            for prim, shown in zip(contacts, apart(guides, up), strict=True)
        ),
        shape=shape_of(sought, skin),
    )


def _placement(detection: Usd.Prim, sought: Sought) -> Floats | None:
    matrices = world_matrices(detection, sought.trajectory.time_codes)
    if not is_still(matrices):
        return None
    return np.asarray(np.linalg.inv(matrices[0]))


def _numbers(contacts: Sequence[Usd.Prim]) -> list[int]:
    """Return the number in the name of each contact, and to those without one that is free."""
    ends = [prim.GetName()[len(prim.GetName().rstrip("0123456789")) :] for prim in contacts]
    taken = {int(end) for end in ends if end}
    free = (number for number in range(1, 2 * len(contacts) + 1) if number not in taken)
    return [int(end) if end else next(free) for end in ends]


def _drawing(prim: Usd.Prim, shown: ContactGuide, sought: Sought) -> _Drawing:
    there = prim.GetStage().GetPrimAtPath(prim.GetPath().AppendChild(GUIDES))
    children = there.GetAllChildren() if there else ()
    return _Drawing(
        path=str(prim.GetPath()),
        guide=shown,
        opacity=opacity_of(prim, sought.trajectory, sought.facts),
        there={child.GetName(): child.IsActive() for child in children},
    )


def _draw_object(layer: Sdf.Layer, sheet: _Sheet) -> None:
    """Draw the whole way of an object, and write what its ghosts are copies of."""
    sought = sheet.sought
    above = over(layer, f"{sought.path}/{GUIDES}")
    make(above, "Xform")
    guide(above)
    place(above, sheet.placement)
    way = trajectory(sought.trajectory.translations, sought.trajectory.points)
    way = way if len(way) > 1 else np.repeat(way, 2, axis=0)
    prim = over(layer, f"{sought.path}/{TRAJECTORY}")
    unit = sought.facts.meters_per_unit
    width = _THIN * size_of(sought.trajectory.points) / unit
    author_curves(prim, [way / unit], width, sheet.color)
    author_opacity(prim, _WHOLE)
    if sheet.shape is not None:
        author_shape(layer, f"{sought.path}/{SHAPE}", sheet.shape, sheet.color)


def _draw_contact(layer: Sdf.Layer, sheet: _Sheet, drawing: _Drawing) -> None:
    above = over(layer, f"{drawing.path}/{GUIDES}")
    make(above, "Xform")
    guide(above)
    place(above, sheet.placement)
    author_opacity(above, drawing.opacity)
    shown, unit = drawing.guide, sheet.sought.facts.meters_per_unit
    size = size_of(sheet.sought.trajectory.points) / unit
    curves = {"Number": shown.number, "Axis": (shown.axis,), "Way": (shown.way,)}
    drawn = {name: lines for name, lines in curves.items() if len(lines[0]) > 1}
    author_points(_under(above, "Held"), shown.marks / unit, _MARK * size, sheet.color)
    for name, lines in drawn.items():
        places = [line / unit for line in lines]
        author_curves(_under(above, name), places, _STROKE * size, sheet.color)
    if sheet.shape is not None:
        pose = matrices_of(shown.translation / unit, shown.rotation)
        author_ghost(_under(above, "Ghost"), f"{sheet.sought.path}/{SHAPE}", sheet.shape.kind, pose)
    # One of before may say nothing any more, or something again.
    now = {"Held", *drawn, *(["Ghost"] if sheet.shape is not None else [])}
    for name, is_on in drawing.there.items():
        if is_on != (name in now):
            _under(above, name).SetInfo("active", name in now)


def _under(prim: Sdf.PrimSpec, name: str) -> Sdf.PrimSpec:
    return over(prim.layer, str(prim.path.AppendChild(name)))

"""Guides of contacts: under each contact what is held, where, when, and by which number it goes.

They stand under the contact, so that switching it off hides them; what all contacts of an object
share is written once: under its detection, else under the edit.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Tf, Usd

from usdmotion.arrays import Floats
from usdmotion.guides import ContactMark, size_of
from usdmotion.usd.detections.authoring import Authored
from usdmotion.usd.drawn import GUIDES
from usdmotion.usd.guides.colors import HELD, TRAJECTORY
from usdmotion.usd.guides.holds import opacity_of
from usdmotion.usd.guides.marks import marks_of
from usdmotion.usd.guides.objects import touched_by
from usdmotion.usd.guides.placements import Standing, Worlds
from usdmotion.usd.guides.prims import (
    author_color,
    author_curve,
    author_curves,
    author_mesh,
    author_opacity,
    author_points,
)
from usdmotion.usd.guides.shapes import Shape, author_ghost, author_shape, shape_of
from usdmotion.usd.guides.sheets import SHAPE, Sheet, author_home, is_of_contact, redrawn
from usdmotion.usd.guides.skins import Skins
from usdmotion.usd.layers import over, set_value
from usdmotion.usd.relations import edit_of, is_a
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import matrices_of

_STROKE, _THIN, _MARK = 0.04, 0.012, 0.1
"""Thickness of curves, of the whole trajectory, and of points, over the size of the object."""
_WHOLE = 0.5
"""Opacity of a whole trajectory."""


@dataclass(frozen=True, eq=False)
class _Object:
    """An object as it is to be drawn."""

    marks: tuple[ContactMark, ...]
    standings: tuple[Standing, ...]
    """How what stands below each contact comes to have the frame of the world."""
    detections: dict[str, Standing]
    """The same for each detection in which they stand, by its path."""
    shape: Shape | None
    shape_path: str


def author_contact_guides(stage: Usd.Stage, authored: Sequence[Authored]) -> None:
    """Draw the contacts of the objects that were looked at, in the edit target of their stage.

    What is drawn is what the contacts say now, whoever wrote them.

    Args:
        stage: The stage, with the contacts on it.
        authored: The objects.
    """
    author_contact_marks(stage, marks_of(stage, touched_by(stage, authored)))


def author_contact_marks(stage: Usd.Stage, marks: Sequence[ContactMark]) -> tuple[str, ...]:
    """Draw contacts in the edit target of their stage.

    What was drawn of them, of others of their detections, and of what is switched off, is drawn
    anew or gone.

    Args:
        stage: The stage that they are of.
        marks: The contacts.

    Returns:
        Paths of the contacts.
    """
    sheet, facts = Sheet(stage), read_facts(stage)
    worlds = Worlds(sheet)
    objects = _objects(worlds, marks, facts)
    places = _drawn_before(sheet, objects)
    with redrawn(sheet, places):
        worlds.author()
        for each in objects:
            _draw_object(sheet, each, facts)
            for mark, standing in zip(each.marks, each.standings, strict=True):
                _draw_contact(sheet, each, mark, standing, facts)
    return tuple(mark.path for mark in marks)


def _objects(worlds: Worlds, marks: Sequence[ContactMark], facts: Facts) -> list[_Object]:
    of_each: dict[tuple[str, str], list[ContactMark]] = {}
    for mark in marks:
        of_each.setdefault((mark.held.path, mark.held.joint), []).append(mark)
    skins: dict[str, Skins] = {}
    taken: set[str] = set()
    found = []
    for (path, _), own in of_each.items():
        stage = worlds.sheet.stage
        prim = stage.GetPrimAtPath(path)
        skin = skins.setdefault(path, Skins(prim))
        contacts = [stage.GetPrimAtPath(mark.path) for mark in own]
        above = [each.GetParent() for each in contacts]
        detections = {
            str(each.GetPath()): each for each in above if is_a(each, "UsdMotionDetection")
        }
        shape_path = _shape_path(worlds.sheet, contacts, own[0], taken)
        found.append(
            _Object(
                marks=tuple(own),
                standings=tuple(worlds.standing(each) for each in contacts),
                detections={each: worlds.standing(one) for each, one in detections.items()},
                shape=shape_of(own[0].held, prim, shape_path, skin),
                shape_path=shape_path,
            )
        )
    return found


def _shape_path(
    sheet: Sheet, contacts: Sequence[Usd.Prim], mark: ContactMark, taken: set[str]
) -> str:
    """Return where it is written what an object looks like, which its ghosts are copies of."""
    above = contacts[0].GetParent()
    edit = edit_of(contacts[0])
    if is_a(above, "UsdMotionDetection"):
        return f"{sheet.home(str(above.GetPath()))}/{SHAPE}"
    if edit is None:
        return f"{sheet.home(mark.path)}/{SHAPE}"
    leaf = (mark.held.joint or mark.held.path).rsplit("/", 1)[-1]
    path = f"{sheet.home(str(edit.GetPath()))}/{SHAPE}_{Tf.MakeValidIdentifier(leaf)}"
    while path in taken:
        path += "_"
    taken.add(path)
    return path


def _drawn_before(sheet: Sheet, objects: Sequence[_Object]) -> list[str]:
    """Return the paths of guides that are to be drawn anew, or are of what is gone."""
    looked_at = {path for each in objects for path in each.detections}
    looked_at |= {mark.path for each in objects for mark in each.marks}
    found = []
    for home, owner in sheet.homes().items():
        if not owner or not owner.IsActive():
            found.append(home)
        elif is_a(owner, "UsdMotionEdit") or str(owner.GetPath()) in looked_at:
            found += [path for path in sheet.items(home) if is_of_contact(path, owner)]
    return found


def _draw_object(sheet: Sheet, each: _Object, facts: Facts) -> None:
    """Draw the whole way of an object, and write what its ghosts are copies of."""
    held, unit = each.marks[0].held, facts.meters_per_unit
    way = held.course if len(held.course) > 1 else np.repeat(held.course, 2, axis=0)
    width = _THIN * size_of(held.points) / unit
    for path, standing in each.detections.items():
        home = author_home(sheet, sheet.home(path))
        standing.author(sheet, home)
        prim = _under(home, _leaf(TRAJECTORY))
        author_curve(prim, way / unit, width, each.marks[0].color)
        author_opacity(prim, _WHOLE)
    if each.shape is not None:
        author_home(sheet, str(Sdf.Path(each.shape_path).GetParentPath()))
        author_shape(sheet.layer, each.shape_path, each.shape, each.marks[0].color)


def _draw_contact(
    sheet: Sheet, each: _Object, mark: ContactMark, standing: Standing, facts: Facts
) -> None:
    above = author_home(sheet, sheet.home(mark.path))
    standing.author(sheet, above)
    opacity = opacity_of(mark, facts)
    if not isinstance(opacity, float):
        codes = sheet.own_codes(np.array(list(opacity))).tolist()
        opacity = dict(zip(codes, opacity.values(), strict=True))
    author_opacity(above, opacity)
    shown, unit = mark.guide, facts.meters_per_unit
    size = size_of(mark.held.points) / unit
    author_points(_under(above, _leaf(HELD)), shown.marks / unit, _MARK * size, mark.color)
    curves = {"Number": shown.number, "Axis": (shown.axis,), "Way": (shown.way,)}
    for name, lines in curves.items():
        if len(lines[0]) > 1:
            places = [line / unit for line in lines]
            author_curves(_under(above, name), places, _STROKE * size, mark.color)
    if len(shown.sole):
        _draw_sole(_under(above, "Sole"), shown.sole / unit, mark, size)
    if each.shape is not None:
        pose = matrices_of(shown.translation / unit, shown.rotation)
        author_ghost(_under(above, "Ghost"), each.shape_path, each.shape.kind, pose)


def _draw_sole(prim: Sdf.PrimSpec, outline: Floats, mark: ContactMark, size: float) -> None:
    author_mesh(prim, outline, [len(outline)], range(len(outline)), _STROKE * size)
    set_value(prim, "doubleSided", Sdf.ValueTypeNames.Bool, True)
    author_color(prim, mark.color)


def _leaf(name: str) -> str:
    return name.removeprefix(f"{GUIDES}/")


def _under(prim: Sdf.PrimSpec, name: str) -> Sdf.PrimSpec:
    return over(prim.layer, str(prim.path.AppendChild(name)))

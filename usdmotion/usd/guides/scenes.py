"""Guides of scenes: what was asked of each edit, what became of it, and what it started from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.guides import Color, ContactMark, another
from usdmotion.showing.shown import Course, Link, Miss, ShownEdit, ShownScene
from usdmotion.usd.guides.balances import MASS, draw_balance
from usdmotion.usd.guides.courses import draw_course, draw_miss
from usdmotion.usd.guides.goals import draw_goals, draw_link
from usdmotion.usd.guides.pages import Page
from usdmotion.usd.guides.placements import Worlds
from usdmotion.usd.guides.sheets import Sheet, author_home, is_of_contact, redrawn
from usdmotion.usd.guides.skeletons import Ghost, draw_ghost, read_ghost
from usdmotion.usd.relations import is_a
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts

_SMALLEST = 1e-3
"""The size of a body that has none [m]."""


@dataclass(frozen=True, eq=False)
class _Drawing:
    """An edit as it is to be drawn."""

    page: Page
    shown: ShownEdit
    ghost: Ghost | None


def author_guides(
    stage: Usd.Stage, shown: Sequence[ShownScene], contacts: Sequence[ContactMark] = ()
) -> tuple[str, ...]:
    """Draw what there is to see of some scenes, in the edit target of their stage.

    What was drawn of their edits before is drawn anew; what is gone is gone from the layer, and is
    switched off where a weaker layer has it.

    Args:
        stage: The stage that the scenes were read from.
        shown: What there is to see of them.
        contacts: Those of the stage; what is asked by one has the colour of what it holds, and no
            way in the input where its detection shows it.

    Returns:
        Paths of the prims below which something is drawn.

    Raises:
        SceneError: The motion that an edit starts from cannot be read.
    """
    sheet, facts = Sheet(stage), read_facts(stage)
    worlds = Worlds(sheet)
    colors = {mark.path: mark.color for mark in contacts}
    drawings = [
        _drawing(worlds, scene, edit, colors, facts) for scene in shown for edit in scene.edits
    ]
    paths = [drawing.shown.path for drawing in drawings]
    with redrawn(sheet, _drawn_before(sheet, paths)):
        worlds.author()
        for drawing in drawings:
            _draw(drawing)
    homes = [home for each in drawings for home in (each.page.home, *each.page.homes.values())]
    return tuple(home for home in homes if sheet.layer.GetPrimAtPath(home))


def _drawing(
    worlds: Worlds,
    scene: ShownScene,
    edit: ShownEdit,
    contacts: Mapping[str, Color],
    facts: Facts,
) -> _Drawing:
    sheet = worlds.sheet
    stage, codes = sheet.stage, scene.scene.time_codes
    prim, skeleton = stage.GetPrimAtPath(edit.path), stage.GetPrimAtPath(edit.skeleton)
    owners = _owners(edit)
    standings = {"": worlds.standing(prim)}
    standings |= {each: worlds.standing(stage.GetPrimAtPath(each)) for each in owners}
    page = Page(
        sheet=sheet,
        home=sheet.home(edit.path),
        codes=sheet.own_codes(codes),
        unit=facts.meters_per_unit,
        size=_size(scene, edit) / facts.meters_per_unit,
        up=facts.up,
        standings=standings,
        homes={owner: sheet.home(owner) for owner in owners},
        colors=_colors(owners, contacts),
        traced=frozenset(each for each in owners if each in contacts and _is_detected(stage, each)),
    )
    ghost = read_ghost(prim, skeleton, codes, facts) if edit.solved else None
    return _Drawing(page, edit, ghost)


def _draw(drawing: _Drawing) -> None:
    page, edit = drawing.page, drawing.shown
    author_home(page.sheet, page.home)
    if drawing.ghost is not None:
        draw_ghost(page, drawing.ghost)
    for course in edit.courses:
        draw_course(page, course)
    draw_goals(page, edit.goals)
    for link in edit.links:
        draw_link(page, link)
    if edit.balance is not None:
        draw_balance(page, edit.balance)
    for miss in edit.misses:
        draw_miss(page, miss)


def _owners(edit: ShownEdit) -> list[str]:
    """Return the paths of the constraints that something is drawn of, each once."""
    goals = (goal.path.rsplit("/", 1)[0] for goal in edit.goals)
    groups: tuple[tuple[Course | Link | Miss, ...], ...] = (edit.courses, edit.links, edit.misses)
    others = [each.path for group in groups for each in group]
    balance = [edit.balance.path] if edit.balance and edit.balance.path != edit.path else []
    return list(dict.fromkeys([*others, *goals, *balance]))


def _is_detected(stage: Usd.Stage, contact: str) -> bool:
    """Tell whether a contact stands in a detection, which shows the whole way of its object."""
    return is_a(stage.GetPrimAtPath(contact).GetParent(), "UsdMotionDetection")


def _colors(owners: Sequence[str], contacts: Mapping[str, Color]) -> dict[str, Color]:
    """Return the colour of each constraint: that of its contact, else one that is used least."""
    found = {owner: contacts[owner] for owner in owners if owner in contacts}
    used = [MASS, *found.values()]
    for owner in owners:
        if owner not in found:
            found[owner] = another(used)
            used.append(found[owner])
    return found


def _drawn_before(sheet: Sheet, edits: Sequence[str]) -> list[str]:
    """Return the paths of guides of some edits, and of all that is switched off or gone."""
    found = []
    for home, owner in sheet.homes().items():
        if not owner or not owner.IsActive():
            found.append(home)
        elif any(Sdf.Path(home).HasPrefix(Sdf.Path(each)) for each in edits):
            found += [path for path in sheet.items(home) if not is_of_contact(path, owner)]
    return found


def _size(scene: ShownScene, edit: ShownEdit) -> float:
    """Return how large a body is: how far its joints are spread at most along an axis [m]."""
    return max(float(np.ptp(_actor(scene, edit), axis=1).max()), _SMALLEST)


def _actor(scene: ShownScene, edit: ShownEdit) -> Floats:
    """Return where the joints of an edit's body are in the input [m], (F, J, 3)."""
    return next(actor.before[0] for actor in scene.actors if actor.character.path == edit.skeleton)

"""What travelled, authored as an edit of the body that it came to."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from pxr import Sdf, Usd, UsdGeom

from usdmotion.arrays import Floats
from usdmotion.constraints import ContactConstraint, Region, Space
from usdmotion.travelling import Left, Luggage, Traveller
from usdmotion.usd.attribute_authoring import author_fields, define
from usdmotion.usd.authoring import author_edit
from usdmotion.usd.detections.contact_prims import WORLD
from usdmotion.usd.frame_authoring import author_relations, author_space, in_units
from usdmotion.usd.goal_authoring import author_goal, author_transform
from usdmotion.usd.normalized.settings import author_settings
from usdmotion.usd.normalized.targets import Target
from usdmotion.usd.relations import edit_of, is_a
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import parent_matrices, rigid, world_matrices

_SAME = 1e-9
_SPACE = "usdmotion:space"
_REGIONS = ("Plane", "Cube", "Sphere", "Cylinder", "Capsule")


def place_travellers(
    stage: Usd.Stage,
    edit: str,
    target: Target,
    animation: str,
    luggage: Luggage,
    travellers: Sequence[Traveller],
) -> tuple[tuple[Traveller, ...], tuple[Left, ...]]:
    """Author an edit with constraints that have come to a body.

    Args:
        stage: Where, in its edit target.
        edit: Path of the MotionEdit.
        target: The body.
        animation: Path of the SkelAnimation that it starts from.
        luggage: What says how it is solved.
        travellers: The constraints, in metres on that body.

    Returns:
        Those that are there, and those that the stage has no prim for.
    """
    facts, codes = read_facts(stage), target.time_codes
    there, left = [], []
    for each in travellers:
        missing = _missing(stage, each)
        if missing:
            left.append(Left(each.name, f"it is about {missing}, which is not on the stage"))
        else:
            there.append(each)
    ground = tuple(path for path in luggage.settings.ground if stage.GetPrimAtPath(path))
    left += [
        Left(path, "this ground is not on the stage")
        for path in luggage.settings.ground
        if path not in ground
    ]
    if there or ground:
        author_edit(stage, edit, skeleton=target.path, source=animation)
        settings = replace(luggage.settings, ground=ground)
        author_settings(stage.GetPrimAtPath(edit), settings, codes, facts)
        _author_above(stage, edit, there)
    for each in there:
        _author(stage, f"{edit}/{each.name}", each, codes, facts)
    return tuple(there), tuple(left)


def _missing(stage: Usd.Stage, traveller: Traveller) -> str:
    """Return the prim that a constraint is about and that is not there, "" for none."""
    for path in traveller.props.values():
        if not is_a(stage.GetPrimAtPath(path), "UsdGeomXformable"):
            return f"the prop <{path}>"
    region = getattr(traveller.constraint, "region", None)
    if isinstance(region, Region):
        prim = stage.GetPrimAtPath(region.path)
        if not any(is_a(prim, f"UsdGeom{kind}") for kind in _REGIONS):
            return f"the region <{region.path}>"
    return ""


def _author_above(stage: Usd.Stage, edit: str, travellers: Sequence[Traveller]) -> None:
    """Make what constraints of one joint stand in: a detection where all are its contacts."""
    groups: dict[str, set[str]] = {}
    for each in travellers:
        above = each.name.rpartition("/")[0]
        is_contact = isinstance(each.constraint, ContactConstraint)
        groups.setdefault(above, set()).add(each.constraint.joint if is_contact else "")
    for above, joints in groups.items():
        path = Sdf.Path(f"{edit}/{above}") if above else None
        if path is None or stage.GetPrimAtPath(path):
            continue
        if len(joints) == 1 and "" not in joints:
            prim = define(stage, str(path), "MotionDetection")
            prim.GetAttribute("usdmotion:joint").Set(next(iter(joints)))
        else:
            stage.DefinePrim(path, "Scope")


def _author(stage: Usd.Stage, path: str, traveller: Traveller, codes: Floats, facts: Facts) -> None:
    constraint = traveller.constraint
    prim, prop = define(stage, path, constraint.schema), traveller.props.get("", "")
    if prop:
        prim.GetRelationship(_SPACE).SetTargets([prop])
    elif hasattr(constraint, "space"):
        _stand_in_world(stage, prim, constraint.space, codes)
        author_space(constraint, prim)
    author_relations(constraint, prim)
    scales = _scales(stage, prop, codes)[0] if prop else None
    told = in_units(constraint, prim, edit_of(prim), codes, facts, prop=scales)
    author_fields(prim, told, codes, facts)
    for goal in constraint.goals:
        held = define(stage, f"{path}/{goal.path}", "MotionGoal")
        of_goal = traveller.props.get(goal.path, "")
        if not of_goal:
            author_goal(held, goal, codes, facts)
            continue
        author_fields(held, goal, codes, facts)
        held.GetRelationship(_SPACE).SetTargets([of_goal])
        units = _scales(stage, of_goal, codes) * facts.meters_per_unit
        author_transform(held, goal.translation / units, goal.rotation, codes)


def _stand_in_world(stage: Usd.Stage, prim: Usd.Prim, space: Space, codes: Floats) -> None:
    """Let the places of a constraint be those of the world, whatever the prims above it do."""
    above = parent_matrices(prim, codes)
    if space.joint is not None or np.abs(above - np.eye(4)).max() <= _SAME:
        return
    edit = edit_of(prim)
    assert edit is not None
    path = f"{edit.GetPath()}/{WORLD}"
    if not stage.GetPrimAtPath(path):
        UsdGeom.Xform.Define(stage, path).SetResetXformStack(True)
    prim.GetRelationship(_SPACE).SetTargets([path])


def _scales(stage: Usd.Stage, prop: str, codes: Floats) -> Floats:
    """Return the scale of a prop, shape (frame_count or 1, 3)."""
    return rigid(world_matrices(stage.GetPrimAtPath(prop), codes), f"<{prop}>")[2]

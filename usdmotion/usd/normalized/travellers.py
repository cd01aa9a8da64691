"""What travels with a normalized motion, as prims below it."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, Region, Space, relations
from usdmotion.kernels import conjugate
from usdmotion.travelling import Meanings, Traveller, Turned, Way, carried
from usdmotion.usd.attribute_authoring import author_fields, define
from usdmotion.usd.attributes import collapse, read_fields
from usdmotion.usd.constraints import goal_prims, is_constraint
from usdmotion.usd.goal_authoring import author_transform
from usdmotion.usd.normalized.axes import to_y_up
from usdmotion.usd.relations import value
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import read_facts
from usdmotion.usd.transforms import local_matrices, rigid

_SPACE, _JOINT = "usdmotion:space", "usdmotion:spaceJoint"


def author_travellers(
    stage: Usd.Stage, path: str, travellers: Iterable[Traveller], time_codes: Floats
) -> None:
    """Author what travels with a normalized motion.

    Args:
        stage: Where, in its edit target.
        path: Path of the MotionNormalized.
        travellers: Constraints without a body.
        time_codes: Time code of each frame.
    """
    facts = _without_units(read_facts(stage))
    way = _between(facts, path, back=True)
    for each in travellers:
        there = carried(each, _Everywhere(way))
        _make_above(stage, path, there.name)
        prim = define(stage, f"{path}/{there.name}", there.constraint.schema)
        author_fields(prim, there.constraint, time_codes, facts)
        _relate(prim, there)
        for goal in there.constraint.goals:
            held = define(stage, f"{prim.GetPath()}/{goal.path}", "MotionGoal")
            author_fields(held, goal, time_codes, facts)
            author_transform(held, goal.translation, goal.rotation, time_codes)
            _name_space(held, there.props.get(goal.path, ""), goal.joint)


def read_travellers(
    prim: Usd.Prim, kinds: Sequence[type[Constraint]], time_codes: Floats, facts: Facts
) -> tuple[tuple[Traveller, ...], tuple[tuple[str, str], ...]]:
    """Return what travels with a normalized motion, and the name and type of what nobody knows.

    Args:
        prim: The MotionNormalized.
        kinds: What prims can be read as.
        time_codes: The frames.
        facts: Axis and rates of the stage.
    """
    known = {kind.schema: kind for kind in kinds}
    way = _Everywhere(_between(facts, str(prim.GetPath()), back=False))
    facts = _without_units(facts)
    found, unknown = [], []
    for each in _constraint_prims(prim):
        name = str(each.GetPath().MakeRelativePath(prim.GetPath()))
        kind = known.get(str(each.GetTypeName()))
        if kind is None:
            unknown.append((name, str(each.GetTypeName())))
        else:
            found.append(
                carried(_read(each, name, kind, str(prim.GetPath()), time_codes, facts), way)
            )
    return tuple(found), tuple(unknown)


class _Everywhere(dict[str, Way]):
    """One way for whatever body is named; the paths of others stay as they are."""

    def __init__(self, way: Turned) -> None:
        super().__init__()
        self._way = way

    def __contains__(self, body: object) -> bool:
        return True

    def __missing__(self, body: str) -> Way:
        return replace(self._way, there=body)


def _between(facts: Facts, path: str, *, back: bool) -> Turned:
    """Return the way from the axes of a stage to those with y up, or back."""
    turn = to_y_up(facts)
    nobody = Meanings(
        path=path,
        joints=(),
        parts=(),
        frames=np.zeros((0, 4)),
        leg=1.0,
        turn=conjugate(turn) if back else turn,
    )
    return Turned(nobody, False, path)


def _without_units(facts: Facts) -> Facts:
    """Return the facts of a stage on which a length is a number: over leg length, or in metres."""
    return replace(facts, meters_per_unit=1.0)


def _make_above(stage: Usd.Stage, path: str, name: str) -> None:
    above = Sdf.Path(f"{path}/{name}").GetParentPath()
    if not stage.GetPrimAtPath(above):
        stage.DefinePrim(above, "Scope")


def _relate(prim: Usd.Prim, traveller: Traveller) -> None:
    constraint: Any = traveller.constraint
    for each in relations(type(constraint)):
        named = getattr(constraint, each.field)
        if named:
            path = named if isinstance(named, str) else named.path
            prim.GetRelationship(each.name).SetTargets([path])
    if hasattr(constraint, "space"):
        _name_space(prim, traveller.props.get("", ""), constraint.space.joint)


def _name_space(prim: Usd.Prim, prop: str, joint: tuple[str, str] | None) -> None:
    body, name = joint or (prop, "")
    if body:
        prim.GetRelationship(_SPACE).SetTargets([body])
    if name:
        prim.GetAttribute(_JOINT).Set(name)


def _constraint_prims(prim: Usd.Prim) -> Iterator[Usd.Prim]:
    for each in Usd.PrimRange(prim):
        if each != prim and is_constraint(each):
            yield each


def _read(
    prim: Usd.Prim, name: str, kind: type[Constraint], body: str, codes: Floats, facts: Facts
) -> Traveller:
    fields = read_fields(prim, kind, codes, facts)
    for each in relations(kind):
        named = _named(prim, each.name)
        if named:
            fields[each.field] = Region(path=named) if each.target == "region" else named
    goals: list[Goal] = []
    props: dict[str, str] = {}
    for held in goal_prims(prim):
        goal, prop = _read_goal(held, codes, facts)
        goals.append(goal)
        props |= {goal.path: prop} if prop else {}
    if hasattr(kind, "__dataclass_fields__") and "space" in kind.__dataclass_fields__:
        joint, prop = _space(prim)
        fields["space"] = Space(joint=joint)
        props |= {"": prop} if prop else {}
    return Traveller(name, kind(path="", skeleton=body, goals=tuple(goals), **fields), props)


def _read_goal(prim: Usd.Prim, codes: Floats, facts: Facts) -> tuple[Goal, str]:
    places, turns, _ = rigid(local_matrices(prim, codes), f"<{prim.GetPath()}>")
    joint, prop = _space(prim)
    goal = Goal(
        path=prim.GetName(),
        translation=collapse(places),
        rotation=collapse(turns),
        joint=joint,
        **read_fields(prim, Goal, codes, facts),
    )
    return goal, prop


def _space(prim: Usd.Prim) -> tuple[tuple[str, str] | None, str]:
    """Return the joint in whose frame something is given, or the path of the prop."""
    body, name = _named(prim, _SPACE), str(value(prim, _JOINT, ""))
    return ((body, name), "") if name else (None, body)


def _named(prim: Usd.Prim, relationship: str) -> str:
    """Return the path that a relationship names, whether it is on the stage or not."""
    there = prim.GetRelationship(relationship)
    paths = there.GetTargets() if there else ()
    return str(paths[0]) if paths else ""

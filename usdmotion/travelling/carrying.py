"""A constraint of any kind leaves its body, or comes onto another and means the same there."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Attribute, Constraint, Goal, Space, attributes, relations
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.travelling.ways import StaysBehind, Way

_NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Traveller:
    """A constraint without a body, or what it is on one."""

    name: str
    """Its path below the edit."""
    constraint: Constraint
    """Lengths over leg length, joints by part; the paths in it are names of prims."""
    props: Mapping[str, str] = field(default_factory=dict)
    """The prims in whose frames it is given, in metres there: "" is its own space, else the name of
    a goal."""


def carried(traveller: Traveller, ways: Mapping[str, Way]) -> Traveller:
    """Return a constraint at the other end of a way.

    Args:
        traveller: The constraint at this end.
        ways: The way of each body that it may be about, by what stands for the body at this end.

    Raises:
        StaysBehind: It cannot be said there.
    """
    constraint = traveller.constraint
    walk = _Walk(traveller, ways)
    changed: dict[str, Any] = {"skeleton": walk.own.there}
    changed["goals"] = tuple(walk.goal(each) for each in constraint.goals)
    tokens = _token_fields(type(constraint))
    for each in attributes(type(constraint)):
        value = getattr(constraint, each.field)
        if each.field in tokens:
            changed[each.field] = walk.joints(each, value, tokens[each.field])
        elif each.unit == "length" or each.frame:
            changed[each.field] = walk.turned(each, value)
    for relation in relations(type(constraint)):
        named = getattr(constraint, relation.field)
        if relation.target == "skeleton" and named:
            changed[relation.field] = walk.way(named).there
    if hasattr(constraint, "space") and not traveller.props.get(""):
        changed["space"] = walk.space(constraint.space)
    return replace(traveller, constraint=replace(constraint, **changed))


def bodies(traveller: Traveller) -> set[str]:
    """Return what stands for every body that a constraint is about, at this end."""
    constraint: Any = traveller.constraint
    named = {constraint.skeleton}
    named |= {goal.joint[0] for goal in constraint.goals if goal.joint is not None}
    named |= {
        getattr(constraint, each.field)
        for each in relations(type(constraint))
        if each.target == "skeleton"
    }
    space = getattr(constraint, "space", None)
    if space is not None and space.joint is not None:
        named.add(space.joint[0])
    return named - {""}


def _token_fields(kind: type[Constraint]) -> dict[str, str]:
    """Return the fields of a kind that hold names of joints, and what says whose they are."""
    own = {"joint": "skeleton", "recruits": "skeleton"}
    named = {
        each.frame: each.skeleton
        for each in attributes(kind)
        if each.frame not in ("", "space", "edit", "goals")
    }
    return own | named


class _Walk:
    """One constraint, field by field."""

    def __init__(self, traveller: Traveller, ways: Mapping[str, Way]) -> None:
        self.constraint: Any = traveller.constraint
        self.props = traveller.props
        self.ways = ways
        self.own = self.way(self.constraint.skeleton)

    def way(self, body: str) -> Way:
        """Return the way of a body."""
        if body not in self.ways:
            raise StaysBehind(f"it is about <{body}>, which is not there or no human body")
        return self.ways[body]

    def joints(self, each: Attribute, value: Any, owner: str) -> Any:
        """Return the names of joints at the other end."""
        way = self.way(getattr(self.constraint, owner) or self.constraint.skeleton)
        if isinstance(value, str):
            return way.name(value) if value else ""
        if each.field == "recruits":
            return way.names(value)
        there = tuple(way.name(name) for name in value if way.has(name))
        if value and not there:
            raise StaysBehind(f"there is no joint '{value[0]}'")
        return there

    def turned(self, each: Attribute, value: Any) -> Any:
        """Return a length, a place, a direction or an orientation at the other end."""
        is_length = each.unit == "length"
        if each.frame == "":
            scaled = np.multiply(value, self.own.scale)
            return type(value)(scaled) if isinstance(value, (tuple, float, int)) else scaled
        if each.frame == "goals":
            return self._letters(value)
        if each.frame == "edit":
            scale = self.own.scale if is_length else 1.0
            return rotate(self.own.world, value) * scale
        if each.frame == "space":
            return self._in_space(each, value)
        way = self.way(getattr(self.constraint, each.skeleton) or self.constraint.skeleton)
        names = getattr(self.constraint, each.frame)
        if isinstance(names, str):
            return _inside(way, names, value, is_length) if names else value
        kept = [(name, at) for name, at in zip(names, value, strict=False) if way.has(name)]
        moved = [_inside(way, name, at, is_length) for name, at in kept]
        return np.array(moved).reshape(-1, *np.shape(value)[1:])

    def goal(self, goal: Goal) -> Goal:
        """Return a goal at the other end."""
        if self.props.get(goal.path.rsplit("/", 1)[-1]):
            return goal
        if goal.joint is None:
            return self._world_goal(goal)
        body, name = goal.joint
        way = self.way(body)
        frame = way.frame(name)
        return replace(
            goal,
            translation=rotate(frame, goal.translation) * way.scale,
            rotation=multiply(frame, goal.rotation),
            joint=(way.there, way.name(name)),
        )

    def space(self, space: Space) -> Space:
        """Return a space at the other end: the world, or a joint."""
        if space.joint is None:
            return space
        way = self.way(space.joint[0])
        return Space(joint=(way.there, way.name(space.joint[1])))

    def _world_goal(self, goal: Goal) -> Goal:
        own = self.own
        if goal.mode == "offset":
            back = conjugate(own.world)
            return replace(
                goal,
                translation=rotate(own.world, goal.translation) * own.scale,
                rotation=multiply(multiply(own.world, goal.rotation), back),
                axes=_NO_TURN,
            )
        return replace(
            goal,
            translation=own.place(goal.translation, self.constraint.joint),
            rotation=multiply(own.world, goal.rotation),
            axes=_NO_TURN,
        )

    def _letters(self, letters: str) -> str:
        """Return the axes of its goals along which something is held."""
        placed = [
            goal
            for goal in self.constraint.goals
            if not self.props.get(goal.path.rsplit("/", 1)[-1])
        ]
        if set(letters) >= set("xyz") or not placed:
            return letters
        for goal in placed:
            if goal.joint is not None or not np.allclose(np.abs(goal.axes[..., 3]), 1.0):
                raise StaysBehind(
                    f"it holds the axes '{letters}' of a frame that lies otherwise in other bodies"
                )
        turned = self.own.axes(letters)
        if turned != letters and len(placed) < len(self.constraint.goals):
            raise StaysBehind(
                f"it holds the axes '{letters}' of a prop and of the world, whose up axis changes"
            )
        return turned

    def _in_space(self, each: Attribute, value: Any) -> Any:
        """Return places, directions or orientations in the space of the constraint."""
        value = np.asarray(value)
        if each.of:
            value = self.own.facing(value, getattr(self.constraint, each.of))
        if self.props.get(""):
            return value
        space = self.constraint.space
        if space.joint is not None:
            return _inside(self.way(space.joint[0]), space.joint[1], value, each.unit == "length")
        if each.unit == "length":
            return self.own.place(value, self.constraint.joint) if value.size else value
        return _left(self.own.world, value)


def _inside(way: Way, joint: str, value: Any, is_length: bool) -> Floats:
    """Return points, directions or orientations in the frame of a joint."""
    turned = _left(way.frame(joint), np.asarray(value))
    return turned * way.scale if is_length else turned


def _left(turn: Floats, values: Floats) -> Floats:
    """Return orientations or vectors, (…, 4) or (…, 3), turned."""
    if not values.size:
        return values
    return multiply(turn, values) if values.shape[-1] == 4 else np.asarray(rotate(turn, values))

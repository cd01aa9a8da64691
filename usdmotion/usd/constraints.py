"""The constraints of an edit, of any kind, from their prims."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, relations
from usdmotion.errors import SceneError
from usdmotion.usd.attributes import read_fields
from usdmotion.usd.characters import Sitting
from usdmotion.usd.frames import in_metres
from usdmotion.usd.goals import read_goal, space_skeleton
from usdmotion.usd.regions import read_region
from usdmotion.usd.relations import edit_of, is_a, target
from usdmotion.usd.shot import Facts


def constraint_prims(edit: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield the constraints of an edit, at any depth, in the order of the stage."""
    for prim in Usd.PrimRange(edit):
        if is_constraint(prim) and edit_of(prim) == edit:
            yield prim


def goal_prims(constraint: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield the goals of a constraint."""
    for prim in constraint.GetChildren():
        if is_a(prim, "UsdMotionGoal"):
            yield prim


def other_skeletons(edit: Usd.Prim) -> dict[str, Usd.Prim]:
    """Return the Skeletons whose joints an edit's goals, places or distances are relative to."""
    constraints = list(constraint_prims(edit))
    goals = [goal for constraint in constraints for goal in goal_prims(constraint)]
    skeletons = [space_skeleton(prim) for prim in (*constraints, *goals)]
    skeletons += [other for constraint in constraints for other in _named(constraint)]
    return {str(each.GetPath()): each for each in skeletons if each is not None}


def _named(constraint: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield the Skeletons that a constraint of any kind names, but for its space."""
    for relationship in constraint.GetRelationships():
        name = relationship.GetName()
        found = target(constraint, name)
        if name != "usdmotion:space" and is_a(found, "UsdSkelSkeleton"):
            yield found


def read_constraints(
    edit: Usd.Prim,
    skeleton: str,
    kinds: Sequence[type[Constraint]],
    sittings: Mapping[str, Sitting],
    time_codes: Floats,
    facts: Facts,
) -> tuple[Constraint, ...]:
    """Return the constraints of an edit in the order of the stage.

    Args:
        edit: The MotionEdit.
        skeleton: Path of the Skeleton that it solves.
        kinds: What prims can be read as.
        sittings: The characters of the scene by the paths of their skeletons.
        time_codes: The frames.
        facts: Units and rates of the stage.

    Raises:
        SceneError: One is of a kind that nobody knows, or says what cannot be.
    """
    return tuple(
        read_constraint(prim, edit, skeleton, kinds, sittings, time_codes, facts)
        for prim in constraint_prims(edit)
    )


def read_constraint(
    prim: Usd.Prim,
    edit: Usd.Prim,
    skeleton: str,
    kinds: Sequence[type[Constraint]],
    sittings: Mapping[str, Sitting],
    time_codes: Floats,
    facts: Facts,
) -> Constraint:
    """Return one constraint of an edit, as `read_constraints` does.

    Raises:
        SceneError: It is of a kind that nobody knows, or says what cannot be.
    """
    known = {kind.schema: kind for kind in kinds}
    kind = known.get(str(prim.GetTypeName()))
    if kind is None:
        raise SceneError(
            f"<{prim.GetPath()}> is a {prim.GetTypeName()}, which nothing installed here can "
            f"solve; deactivate it, or use one of {', '.join(sorted(known))}"
        )
    constraint = kind(
        path=str(prim.GetPath()),
        skeleton=skeleton,
        goals=tuple(read_goal(goal, sittings, time_codes, facts) for goal in goal_prims(prim)),
        **read_fields(prim, kind, time_codes, facts),
        **_related(prim, kind, time_codes, facts),
    )
    return in_metres(constraint, prim, edit, sittings, time_codes, facts)


def _related(
    prim: Usd.Prim, kind: type[Constraint], time_codes: Floats, facts: Facts
) -> dict[str, Any]:
    """Return the fields of a kind that its prim names another prim for."""
    fields: dict[str, Any] = {}
    for each in relations(kind):
        other = target(prim, each.name)
        if other is not None:
            is_region = each.target == "region"
            path = str(other.GetPath())
            fields[each.field] = read_region(other, time_codes, facts) if is_region else path
    return fields


def is_constraint(prim: Usd.Prim) -> bool:
    """Tell whether a prim is a constraint, of whatever kind."""
    # A type that USD does not know is nothing but a name, and a constraint must not go unseen.
    name = str(prim.GetTypeName())
    return is_a(prim, "UsdMotionConstraint") or (
        name.startswith("Motion") and name.endswith("Constraint")
    )

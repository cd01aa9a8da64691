"""Constraints and goals that say too little to be solved."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.usd.faults.fault import Fault, error, warning
from usdmotion.usd.relations import is_a, names_target, value


def find_empty_distances(prim: Usd.Prim) -> Iterator[Fault]:
    """Find distances to nothing: neither to another joint nor to a goal."""
    has_goal = any(is_a(child, "UsdMotionGoal") for child in prim.GetChildren())
    if not value(prim, "usdmotion:otherJoint", "") and not has_goal:
        yield error(
            prim,
            "NoOtherEnd",
            "is a distance to nothing; set usdmotion:otherJoint or give it a MotionGoal",
        )


def find_missing_regions(prim: Usd.Prim) -> Iterator[Fault]:
    """Find regions without a shape."""
    if not names_target(prim, "usdmotion:region"):
        yield error(
            prim,
            "NoRegion",
            "has no region; name a Plane, Cube, Sphere, Cylinder or Capsule in usdmotion:region",
        )


def find_zero_axes(prim: Usd.Prim) -> Iterator[Fault]:
    """Find axes that point nowhere: of an aim, of a contact that has one."""
    has_axis = value(prim, "usdmotion:kind", "") in ("line", "plane", "slide")
    for name in ("usdmotion:aim", "usdmotion:axis"):
        axis = value(prim, name)
        if axis is not None and not any(axis) and (name == "usdmotion:aim" or has_axis):
            yield error(prim, "ZeroAxis", f"has an {name} of zero; give it a direction")


def find_lost_goals(prim: Usd.Prim) -> Iterator[Fault]:
    """Find goals that are no child of a constraint."""
    if not is_a(prim.GetParent(), "UsdMotionConstraint"):
        yield warning(
            prim, "NoConstraint", "is not the child of a constraint, so nothing wants it; move it"
        )

"""What belongs to what on a stage: a constraint to its edit, an edit to its skeleton."""

from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any

from pxr import Tf, Usd, UsdSkel

ARRAYS = ("translations", "rotations", "scales")
"""Without any of these a SkelAnimation shows the rest pose."""


def is_a(prim: Usd.Prim, name: str) -> bool:
    """Tell whether a prim is of a TfType, or of one derived from it; an expired prim never is."""
    return bool(prim) and bool(prim.IsA(Tf.Type.FindByName(name)))


def value(prim: Usd.Prim, name: str, default: Any = None) -> Any:
    """Return an attribute's value where it has one of its schema's type, else `default`.

    Values of a wrong type are the business of another check; nobody else should stumble over them.
    """
    attribute = prim.GetAttribute(name)
    if not attribute or mistyped(attribute):
        return default
    found = attribute.Get(Usd.TimeCode.EarliestTime())
    return default if found is None else found


def mistyped(attribute: Usd.Attribute) -> str:
    """Return the type that an attribute was written with, where that is not its schema's."""
    definition = attribute.GetPrim().GetPrimDefinition()
    declared = definition.GetPropertyMetadata(attribute.GetName(), "typeName")
    for spec in attribute.GetPropertyStack(Usd.TimeCode.Default()):
        written = str(spec.typeName) if hasattr(spec, "typeName") else "relationship"
        if declared and written != declared:
            return written
    return ""


def floats(values: Any) -> list[float]:
    """Return times or numbers as floats; an older USD holds time codes as objects."""
    return [float(number) for number in values or ()]


def target(prim: Usd.Prim, name: str) -> Usd.Prim | None:
    """Return the first prim that a relationship names, if it is there."""
    relationship = prim.GetRelationship(name)
    for path in relationship.GetForwardedTargets() if relationship else ():
        found = prim.GetStage().GetPrimAtPath(path)
        if found:
            return found
    return None


def names_target(prim: Usd.Prim, name: str) -> bool:
    """Tell whether a relationship is there and names anything."""
    relationship = prim.GetRelationship(name)
    return bool(relationship) and bool(relationship.GetTargets())


def edit_of(prim: Usd.Prim) -> Usd.Prim | None:
    """Return the edit that a prim is a part of: the nearest above it, or itself."""
    return nearest(prim, "UsdMotionEdit")


def constraints_of(edit: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield the constraints of an edit, at any depth, of the kinds that USD knows."""
    for prim in Usd.PrimRange(edit):
        if is_a(prim, "UsdMotionConstraint") and edit_of(prim) == edit:
            yield prim


def travels(prim: Usd.Prim) -> bool:
    """Tell whether a prim is a normalized motion, or one of the constraints that travel with it."""
    return nearest(prim, "UsdMotionNormalized") is not None


def skeleton_of(prim: Usd.Prim) -> Usd.Prim | None:
    """Return the Skeleton that an edit solves, or that a part of an edit is about."""
    named = target(prim, "usdmotion:skeleton")
    if named is not None:
        return named if is_a(named, "UsdSkelSkeleton") else None
    for kind in ("UsdMotionEdit", "UsdMotionDetection"):
        above = nearest(prim, kind)
        if above is not None and above != prim:
            return skeleton_of(above)
    return nearest(prim, "UsdSkelSkeleton")


def joints_of(skeleton: Usd.Prim) -> tuple[str, ...]:
    """Return the joint tokens of a Skeleton, or of a SkelAnimation."""
    return tuple(str(token) for token in value(skeleton, "joints", ()))


def clip_joints(animation: Usd.Prim | None) -> tuple[str, ...]:
    """Return the joints that an animation moves; none where USD shows the rest pose instead."""
    if animation is None:
        return ()
    complete = all(animation.GetAttribute(name).HasAuthoredValue() for name in ARRAYS)
    return joints_of(animation) if complete else ()


def bound_animation(skeleton: Usd.Prim) -> Usd.Prim | None:
    """Return the SkelAnimation that is bound to a Skeleton, by itself or by an ancestor."""
    found = UsdSkel.BindingAPI(skeleton).GetInheritedAnimationSource()
    return found if is_a(found, "UsdSkelAnimation") else None


def suggestion(name: str, known: tuple[str, ...]) -> str:
    """Return what somebody may have meant who wrote a name that is not known."""
    leaves = {other.rsplit("/", 1)[-1]: other for other in reversed(known)}
    if name in leaves:
        return f"did you mean '{leaves[name]}'?"
    close = get_close_matches(name, known, n=1)
    if close:
        return f"did you mean '{close[0]}'?"
    some = ", ".join(known[:6]) + (", …" if len(known) > 6 else "")
    return f"it has {some}" if known else "it has none"


def nearest(prim: Usd.Prim, name: str) -> Usd.Prim | None:
    """Return the nearest prim of a TfType above a prim, or itself; None where there is none."""
    while prim and not prim.IsPseudoRoot():
        if is_a(prim, name):
            return prim
        prim = prim.GetParent()
    return None

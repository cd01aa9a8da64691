"""What is drawn for people to look at, which is nothing of the scene itself."""

from collections.abc import Iterator

from pxr import Sdf, Usd, UsdGeom

from usdmotion.usd.relations import is_a

GUIDES = "Guides"
"""Name of the prim below which it stands, under an edit, a constraint or a detection."""
_OWNERS = ("UsdMotionEdit", "UsdMotionConstraint", "UsdMotionDetection")


def without_guides(prims: Usd.PrimRange) -> Iterator[Usd.Prim]:
    """Yield prims, but for guides and what is below them."""
    rest = iter(prims)
    for prim in rest:
        if is_home(prim):
            rest.PruneChildren()
        else:
            yield prim


def is_home(prim: Usd.Prim) -> bool:
    """Tell whether a prim is one that guides were drawn below, and not somebody else's."""
    if not _is_named(prim.GetName()) or prim.GetTypeName() != "Xform":
        return False
    purpose = UsdGeom.Imageable(prim).GetPurposeAttr()
    return (
        is_owner(prim.GetParent())
        and purpose.HasAuthoredValue()
        and purpose.Get() == UsdGeom.Tokens.guide
    )


def is_drawn(prim: Usd.Prim) -> bool:
    """Tell whether a prim is a guide, or stands below one."""
    while prim and not prim.IsPseudoRoot():
        if is_home(prim):
            return True
        prim = prim.GetParent()
    return False


def is_owner(prim: Usd.Prim) -> bool:
    """Tell whether a prim is one that guides stand below."""
    return any(is_a(prim, kind) for kind in _OWNERS)


def is_home_spec(spec: Sdf.PrimSpec | None) -> bool:
    """Tell whether a spec is that of a prim that guides were drawn below."""
    if spec is None or not _is_named(spec.name) or spec.typeName != "Xform":
        return False
    purpose = spec.attributes.get("purpose")
    return purpose is not None and purpose.default == UsdGeom.Tokens.guide


def _is_named(name: str) -> bool:
    return name.rstrip("0123456789") == GUIDES

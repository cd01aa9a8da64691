"""Grounds that nobody can stand on."""

from collections.abc import Iterator

from pxr import Usd, UsdGeom

from usdmotion.usd.faults.fault import Fault, error
from usdmotion.usd.faults.targets import SHAPES
from usdmotion.usd.relations import is_a

GROUND = "usdmotion:ground"
"""The relationship to the ground of an edit."""
SURFACES = ("UsdGeomMesh", *SHAPES)
"""What can be stood on."""
_SKINNED = "primvars:skel:jointIndices"


def find_wrong_grounds(prim: Usd.Prim) -> Iterator[Fault]:
    """Find grounds that are no surface, and hold none."""
    relationship = prim.GetRelationship(GROUND)
    for path in relationship.GetForwardedTargets() if relationship else ():
        found = prim.GetStage().GetPrimAtPath(path)
        wrong = why_no_ground(found) if found else ""  # that it is not there is said already
        if wrong:
            yield error(prim, "WrongGround", f"names <{path}> in {GROUND}, which {wrong}")


def why_no_ground(prim: Usd.Prim) -> str:
    """Return why a prim cannot be stood on, and what would do; "" where it can."""
    if next(surfaces_under(prim), None) is not None:
        return ""
    kind = str(prim.GetTypeName()) or "typeless prim"
    said = f"is a {kind}"
    if is_a(prim, "UsdGeomMesh"):
        said = "is the skin of a body"
    elif _holds(prim):
        said = f"is a {kind} without a surface below it"
    names = [each.removeprefix("UsdGeom") for each in SURFACES]
    return f"{said}; name a {', '.join(names[:-1])} or {names[-1]}, or a prim that holds some"


def surfaces_under(top: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield what can be stood on: a surface itself, or those below a prim, those of instances too.

    Skins of bodies are none, and neither is what is only drawn as a guide.
    """
    if is_a(top, "UsdGeomGprim") and not _is_surface(top):
        return
    prims = iter(Usd.PrimRange(top, Usd.TraverseInstanceProxies()))
    for prim in prims:
        imageable = UsdGeom.Imageable(prim)
        if prim != top and imageable and imageable.ComputePurpose() == UsdGeom.Tokens.guide:
            prims.PruneChildren()
        elif _is_surface(prim):
            yield prim


def _is_surface(prim: Usd.Prim) -> bool:
    return any(is_a(prim, kind) for kind in SURFACES) and not prim.HasAttribute(_SKINNED)


def _holds(prim: Usd.Prim) -> bool:
    return bool(prim.GetFilteredChildren(Usd.TraverseInstanceProxies()))

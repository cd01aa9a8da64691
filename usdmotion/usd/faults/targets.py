"""Relationships that name nothing, or the wrong kind of prim."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.usd.faults.fault import Fault, error
from usdmotion.usd.relations import is_a, travels

SHAPES = ("UsdGeomPlane", "UsdGeomCube", "UsdGeomSphere", "UsdGeomCylinder", "UsdGeomCapsule")
ANY = ("",)

TARGETS = {
    "usdmotion:skeleton": ("UsdSkelSkeleton",),
    "usdmotion:otherSkeleton": ("UsdSkelSkeleton",),
    "usdmotion:source": ("UsdSkelAnimation",),
    "usdmotion:region": SHAPES,
    "usdmotion:object": ("UsdGeomXformable",),
    "usdmotion:space": ("UsdGeomImageable",),
    "usdmotion:ground": ANY,
}
"""What each relationship names; only the ground may be several prims."""


def find_wrong_targets(prim: Usd.Prim) -> Iterator[Fault]:
    """Find relationships to prims that are not there, not of the right type, or too many."""
    if travels(prim):
        return  # what it names is on the stage that it comes from, or goes to
    for name, kinds in TARGETS.items():
        relationship = prim.GetRelationship(name)
        paths = relationship.GetForwardedTargets() if relationship else []
        if len(paths) > 1 and kinds is not ANY:
            yield error(
                prim, "TooManyTargets", f"names {len(paths)} prims in {name}; name one of them"
            )
        for path in paths:
            found = prim.GetStage().GetPrimAtPath(path)
            if not found:
                yield error(
                    prim,
                    "MissingTarget",
                    f"names <{path}> in {name}, which is not on the stage"
                    "; name a prim that is, or clear it",
                )
            elif kinds is not ANY and not any(is_a(found, kind) for kind in kinds):
                yield error(
                    prim,
                    "WrongTarget",
                    f"names <{path}> in {name}, which is a {found.GetTypeName() or 'typeless prim'}"
                    f"; name a {_names(kinds)}",
                )


def _names(kinds: tuple[str, ...]) -> str:
    names = [kind.removeprefix("UsdSkel").removeprefix("UsdGeom") for kind in kinds]
    names = ["SkelAnimation" if name == "Animation" else name for name in names]
    return " or ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)

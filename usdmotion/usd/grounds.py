"""Surfaces of a stage as ground: meshes, planes, and shapes, alone or under one prim."""

from collections.abc import Sequence

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.ground import Ground, MeshGround, PlaneGround, SeveralGrounds
from usdmotion.usd.faults.grounds import GROUND, surfaces_under, why_no_ground
from usdmotion.usd.relations import is_a, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.surfaces import read_triangles
from usdmotion.usd.transforms import world_matrices


def ground_prims(edit: Usd.Prim, given: Sequence[str] | None) -> tuple[Usd.Prim, ...]:
    """Return the prims that an edit stands on.

    Args:
        edit: The MotionEdit.
        given: Their paths, over what the edit says; None takes that.

    Raises:
        SceneError: One is not there, or nobody can stand on it.
    """
    relationship = edit.GetRelationship(GROUND)
    named = relationship.GetForwardedTargets() if relationship else ()
    stage, prims = edit.GetStage(), []
    for path in named if given is None else given:
        prim = stage.GetPrimAtPath(str(path)) if str(path).startswith("/") else None
        if not prim:
            raise SceneError(f"there is no prim <{path}> to stand on; name one by its path")
        wrong = why_no_ground(prim)
        if wrong:
            raise SceneError(f"<{path}> is to be the ground, and {wrong}")
        prims.append(prim)
    return tuple(prims)


def read_ground(prims: Sequence[Usd.Prim], time_codes: Floats, facts: Facts) -> Ground | None:
    """Return the ground that some prims are, None where there are none.

    A prim that is no surface itself stands for those below it, instances and what moves included.

    Args:
        prims: The prims.
        time_codes: The frames.
        facts: Units, axis and rates of the stage.

    Raises:
        SceneError: One cannot be stood on.
    """
    times = (time_codes - time_codes[0]) / facts.time_codes_per_second
    found: list[Ground] = []
    still: list[tuple[Floats, Ints]] = []
    for prim in (each for top in prims for each in surfaces_under(top)):
        if is_a(prim, "UsdGeomPlane"):
            found.append(_plane(prim, time_codes, times, facts))
            continue
        points, triangles = read_triangles(prim, time_codes, facts)
        if len(points) == 1:
            still.append((points[0], triangles))
        else:
            found.append(MeshGround(points, triangles, facts.up, times))
    if still:
        found.append(_joined(still, facts.up))
    return SeveralGrounds.of(found) if found else None


def _joined(meshes: Sequence[tuple[Floats, Ints]], up: Floats) -> MeshGround:
    """Return what stays as one mesh, so that it is looked up once."""
    firsts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    triangles = [each + first for (_, each), first in zip(meshes, firsts, strict=False)]
    return MeshGround(np.concatenate([each for each, _ in meshes]), np.concatenate(triangles), up)


def _plane(prim: Usd.Prim, time_codes: Floats, times: Floats, facts: Facts) -> PlaneGround:
    matrices = world_matrices(prim, time_codes)
    axes = np.delete(matrices[:, :3, :3], "XYZ".index(str(value(prim, "axis", "Z"))), axis=1)
    normals = np.cross(axes[:, 0], axes[:, 1])
    points = matrices[:, 3, :3] * facts.meters_per_unit
    try:
        return PlaneGround(points, normals, facts.up, times[: len(points)])
    except SceneError as error:
        raise SceneError(f"<{prim.GetPath()}>: {error}") from error

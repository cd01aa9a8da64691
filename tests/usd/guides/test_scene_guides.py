"""What is drawn of edits is where UsdSkel shows things in the world, seen when it is, and small."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdSkel

EDIT = "/Walker/Skeleton/Reaching"
NEAR = 0.12
"""How far what is drawn may be from what it is drawn of: about a millimetre, in centimetres."""


def at(stage, path):
    return stage.GetPrimAtPath(f"{EDIT}/{path}")


def world_points(prim, code=0.0):
    points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(code))
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
    return points @ matrix[:3, :3] + matrix[3, :3]


def joints(stage, code, animation=""):
    """Return where joints are in the world by their tokens, with another animation if named."""
    skeleton = stage.GetPrimAtPath("/Walker/Skeleton")
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(skeleton), Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(skeleton))
    matrices = query.ComputeJointSkelTransforms(Usd.TimeCode(code))
    place = UsdGeom.Xformable(skeleton).ComputeLocalToWorldTransform(code)
    order = [str(token) for token in query.GetJointOrder()]
    return {
        token.rsplit("/", 1)[-1]: np.array((Gf.Matrix4d(matrix) * place).ExtractTranslation())
        for token, matrix in zip(order, matrices, strict=True)
    }


def off(point, polyline):
    """Return how far a point is from a polyline."""
    starts, along = polyline[:-1], np.diff(polyline, axis=0)
    shares = ((point - starts) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30)
    nearest = starts + np.clip(shares, 0.0, 1.0)[:, None] * along
    return np.linalg.norm(nearest - point, axis=1).min()


@pytest.mark.parametrize("code", [1.0, 60.0, 73.0, 145.0])
def test_the_trajectory_of_an_effector_goes_where_usdskel_shows_it(reaching, code):
    way = world_points(at(reaching, "LeftWrist/Guides/After"))
    assert off(joints(reaching, code)["LeftHand"], way) < NEAR


def test_a_goal_is_where_it_is_wanted_and_as_opaque_as_it_is_active(reaching):
    marker = at(reaching, "LeftWrist/Guides/Reach/Marker")
    place = world_points(marker, 73.0).mean(axis=0)
    np.testing.assert_allclose(place, joints(reaching, 73.0)["LeftHand"], atol=NEAR)
    opacity = UsdGeom.PrimvarsAPI(marker).FindPrimvarWithInheritance("displayOpacity")
    assert opacity.Get(1.0)[0] < 0.2 < opacity.Get(73.0)[0] == 1.0


def test_nothing_is_read_from_guides(reaching, reached):
    assert UsdSkel.Root.Find(at(reaching, "Guides")).GetPath() == "/Walker"
    for prim in Usd.PrimRange(at(reaching, "Guides")):
        if prim.IsA(UsdGeom.Imageable):
            assert UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide

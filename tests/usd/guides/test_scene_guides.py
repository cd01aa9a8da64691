"""What is drawn of edits is where UsdSkel shows things in the world, however they are carried."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel

from usdmotion.plugins import host
from usdmotion.report.findings import findings_of
from usdmotion.showing import shown
from usdmotion.usd import outcomes_of

EDIT = "Walker/Skeleton/Reaching"
NEAR = 0.3
"""How far what is drawn may be from what it is drawn of: three millimetres on a grown person."""
TIMES = (1.0, 30.0, 61.0, 73.0, 92.0, 145.0)
"""Of the walk, as it was made."""


class Seen:
    """A stage with guides of a walker, at his own times."""

    def __init__(self, stage, above="/", offset=0.0, scale=1.0):
        self.stage, self.above = stage, above
        self.offset, self.scale = offset, scale

    def code(self, time):
        return Usd.TimeCode(self.offset + self.scale * time)

    def at(self, path):
        return self.stage.GetPrimAtPath(f"{self.above}{EDIT}/{path}")

    def matrix(self, prim, time):
        return np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(self.code(time)))

    def points(self, path, time):
        """Return the points of a guide in the world."""
        prim = self.at(path)
        points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(self.code(time)))
        matrix = self.matrix(prim, time)
        return points @ matrix[:3, :3] + matrix[3, :3]

    @property
    def skeleton(self):
        return self.stage.GetPrimAtPath(f"{self.above}Walker/Skeleton")

    @property
    def size(self):
        """How large a metre of the walker is on the stage."""
        return 100.0 * np.linalg.norm(self.matrix(self.skeleton, 1.0)[0, :3])

    def joints(self, time, animation=None):
        """Return the matrices of joints in the world, by their last names."""
        cache = UsdSkel.Cache()
        cache.Populate(UsdSkel.Root.Find(self.skeleton), Usd.TraverseInstanceProxies())
        skeleton = UsdSkel.Skeleton(self.skeleton)
        moves = UsdSkel.Animation.Get(self.stage, animation) if animation else None
        query = cache.GetSkelQuery(skeleton)
        if moves is None:
            matrices = query.ComputeJointSkelTransforms(self.code(time))
        else:
            local = cache.GetAnimQuery(moves).ComputeJointLocalTransforms(self.code(time))
            matrices = UsdSkel.ConcatJointTransforms(query.GetTopology(), local)
        place = UsdGeom.Xformable(self.skeleton).ComputeLocalToWorldTransform(self.code(time))
        names = [str(token).rsplit("/", 1)[-1] for token in query.GetJointOrder()]
        return {
            name: np.array(Gf.Matrix4d(matrix) * place)
            for name, matrix in zip(names, matrices, strict=True)
        }

    def center_of_mass(self, time):
        """Return it as UsdSkel's joints and the masses of the stage say."""
        masses = np.array(self.skeleton.GetAttribute("usdmotion:masses").Get())
        centers = np.array(self.skeleton.GetAttribute("usdmotion:massCenters").Get())
        matrices = np.array(list(self.joints(time).values()))
        places = np.einsum("ji,jik->jk", np.c_[centers, np.ones(len(centers))], matrices)
        return masses @ places[:, :3] / masses.sum()


@pytest.fixture(scope="module")
def walks(reaching, carried, wrapped, tmp_path_factory):
    """Return the walk as it is, carried, under a layer offset, and referenced by a carrier."""
    folder = tmp_path_factory.mktemp("walks")
    made = Path(reaching.GetRootLayer().realPath)
    layer = Sdf.Layer.CreateNew(str(folder / "later.usda"))
    layer.subLayerPaths.append(str(made))
    layer.subLayerOffsets[0] = Sdf.LayerOffset(10.0, 2.0)
    layer.Save()
    return {
        "plain": Seen(reaching),
        "carried": Seen(carried, "/World/", 10.0, 2.0),
        "later": Seen(Usd.Stage.Open(layer), "/", 10.0, 2.0),
        "wrapped": Seen(wrapped(reaching, "Walker"), "/World/", 10.0, 2.0),
    }


@pytest.fixture(params=["plain", "carried", "later", "wrapped"])
def walk(walks, request):
    return walks[request.param]


@pytest.fixture(scope="module")
def told(reaching):
    """Return what there is to see of `reaching`, and what there is to tell."""
    path = Path(reaching.GetRootLayer().realPath)
    (outcome,) = outcomes_of(reaching, path, host().constraints)
    return shown(outcome), findings_of(outcome)


def off(point, polyline):
    """Return how far a point is from a polyline."""
    starts, along = polyline[:-1], np.diff(polyline, axis=0)
    shares = ((point - starts) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30)
    nearest = starts + np.clip(shares, 0.0, 1.0)[:, None] * along
    return np.linalg.norm(nearest - point, axis=1).min()


@pytest.mark.parametrize("name", ["plain", "carried", "later"])
def test_trajectories_go_where_usdskel_shows_their_joints(walks, name):
    seen = walks[name]
    for time in TIMES:
        after = seen.points("LeftWrist/Guides/After", time)
        before = seen.points("LeftWrist/Guides/Before", time)
        source = f"{seen.above}Walker/Animation"
        assert off(seen.joints(time)["LeftHand"][3, :3], after) < NEAR
        assert off(seen.joints(time, source)["LeftHand"][3, :3], before) < NEAR


def test_a_shot_that_is_referenced_takes_its_trajectories_along(walks):
    seen, plain = walks["wrapped"], walks["plain"]
    for time in TIMES:
        here = seen.points("LeftWrist/Guides/After", time)
        there = plain.points("LeftWrist/Guides/After", time)
        carrier = seen.matrix(seen.stage.GetPrimAtPath("/World"), time)
        np.testing.assert_allclose(here, there @ carrier[:3, :3] + carrier[3, :3], atol=1e-3)


def test_the_centre_of_mass_is_where_usdskel_shows_it_with_a_line_straight_down(walk):
    for time in TIMES:
        (spot,) = walk.points("Balance/Guides/CenterOfMass/Spot", time)
        assert np.linalg.norm(spot - walk.center_of_mass(time)) < NEAR
        line = walk.points("Balance/Guides/CenterOfMass/Drop", time)
        np.testing.assert_allclose(line[0], spot, atol=1e-3)
        assert abs(line[1] - spot)[[0, 2]].max() < 1e-3 and line[1][1] < spot[1]


def test_the_area_below_it_holds_what_bears_the_body(walks, told):
    balance = told[0].edits[0].balance
    seen = walks["plain"]
    for frame, time in enumerate(told[0].scene.time_codes):
        area = seen.points("Balance/Guides/Supports", time)[:, [2, 0]]
        along = np.roll(area, -1, axis=0) - area
        lengths = np.linalg.norm(along, axis=1)
        for point in 100.0 * balance.supports[frame, balance.bearing[frame]][:, [2, 0]]:
            beside = along[:, 0] * (point - area)[:, 1] - along[:, 1] * (point - area)[:, 0]
            assert (beside >= -NEAR * lengths).all()


def test_the_area_is_seen_while_anything_bears_the_body(walks, told):
    balance = told[0].edits[0].balance
    area = UsdGeom.Imageable(walks["plain"].at("Balance/Guides/Supports"))
    for frame, time in enumerate(told[0].scene.time_codes):
        visible = area.ComputeVisibility(time) != UsdGeom.Tokens.invisible
        assert visible == balance.bearing[frame].any()


def test_a_goal_is_where_its_effector_gets_and_as_opaque_as_it_is_active(walk):
    marker = walk.at("LeftWrist/Guides/Reach/Marker")
    opacity = UsdGeom.PrimvarsAPI(marker).FindPrimvarWithInheritance("displayOpacity")
    place = walk.points("LeftWrist/Guides/Reach/Marker", 73.0).mean(axis=0)
    assert np.linalg.norm(place - walk.joints(73.0)["LeftHand"][3, :3]) < NEAR
    assert opacity.Get(walk.code(1.0))[0] < 0.2 < opacity.Get(walk.code(73.0))[0] == 1.0


def test_the_ghost_is_moved_by_the_source_and_ends_at_its_joints(walk):
    mesh = UsdGeom.Mesh(walk.at("Guides/Ghost/Segments"))
    skeleton = UsdSkel.Skeleton(walk.at("Guides/Ghost/Skeleton"))
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(mesh.GetPrim()), Usd.TraverseInstanceProxies())
    query, skinning = cache.GetSkelQuery(skeleton), cache.GetSkinningQuery(mesh.GetPrim())
    low, high = np.array(mesh.GetExtentAttr().Get())
    for time in TIMES:
        points = mesh.GetPointsAttr().Get()
        matrices = query.ComputeSkinningTransforms(walk.code(time))
        assert skinning.ComputeSkinnedPoints(matrices, points, walk.code(time))
        own = np.array(points)
        assert (low <= own.min(axis=0)).all() and (own.max(axis=0) <= high).all()
        place = walk.matrix(skeleton.GetPrim(), time)
        ends = (own @ place[:3, :3] + place[3, :3]).reshape(-1, 6, 3)[:, [0, 5]].reshape(-1, 3)
        joints = walk.joints(time, f"{walk.above}Walker/Animation").values()
        places = np.array([matrix[3, :3] for matrix in joints])
        gaps = np.linalg.norm(ends[:, None] - places, axis=2)
        assert gaps.min(axis=1).max() < 1e-2 and gaps.min(axis=0).max() < 1e-2


def test_the_ghost_has_no_samples_of_its_own(walks):
    layer = walks["plain"].stage.GetRootLayer()
    sampled = []
    layer.Traverse(f"/{EDIT}/Guides/Ghost", sampled.append)
    assert not any(layer.GetNumTimeSamplesForPath(path) for path in sampled)


def test_a_layer_of_guides_is_small(walks):
    for name, most in (("plain", 100_000), ("carried", 130_000)):
        assert len(walks[name].stage.GetRootLayer().ExportToString()) < most

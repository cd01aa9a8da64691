"""Surfaces that skeletons move are where UsdSkel puts them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt

import usdmotion.usd  # noqa: F401
from usdmotion.usd.seeing import Sight
from usdmotion.usd.stages import read_facts

CODES = (1.0, 4.5, 9.0)
_HALF = np.sqrt(0.5)


def arm(
    *, up: str = "Y", unit: float = 1.0, joints: tuple[str, ...] = (), method: str = ""
) -> Usd.Stage:
    """Return a stage with an arm of three joints that bends, skinned to a strip of eight points.

    Args:
        up: Up axis.
        unit: Metres per unit.
        joints: The joints that the mesh names, in its own order; none takes the skeleton's.
        method: How it is skinned; "" says nothing.
    """
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    UsdGeom.SetStageUpAxis(stage, up)
    stage.SetStartTimeCode(1.0)
    stage.SetEndTimeCode(9.0)
    root = UsdSkel.Root.Define(stage, "/Arm")
    root.AddTranslateOp().Set(Gf.Vec3d(3.0, 0.0, 1.0), 1.0)
    root.GetPrim().GetAttribute("xformOp:translate").Set(Gf.Vec3d(5.0, 1.0, 1.0), 9.0)
    root.AddRotateXYZOp().Set(Gf.Vec3f(20.0, 30.0, 40.0))
    root.AddScaleOp().Set(Gf.Vec3f(2.0))
    skeleton = UsdSkel.Skeleton.Define(stage, "/Arm/Skeleton")
    tokens = ["a", "a/b", "a/b/c"]
    rest = [Gf.Matrix4d(1.0)] + 2 * [Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(2.0, 0.0, 0.0))]
    skeleton.CreateJointsAttr(tokens)
    skeleton.CreateRestTransformsAttr(rest)
    skeleton.CreateBindTransformsAttr([rest[0], rest[1], rest[1] * rest[2]])
    animation = UsdSkel.Animation.Define(stage, "/Arm/Skeleton/Animation")
    animation.CreateJointsAttr(tokens)
    animation.CreateTranslationsAttr([(0, 0, 0), (2, 0, 0), (2, 0, 0)])
    animation.CreateScalesAttr([(1, 1, 1)] * 3)
    straight, bent = Gf.Quatf(1.0), Gf.Quatf(_HALF, 0.0, 0.0, _HALF)
    turns = animation.CreateRotationsAttr()
    turns.Set([straight, straight, straight], 1.0)
    turns.Set([straight, bent, straight], 4.5)
    turns.Set([straight, bent, bent], 9.0)
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(
        [animation.GetPath()]
    )
    _skin(stage, "/Arm/Skin", joints or (), method)
    return stage


def _skin(stage: Usd.Stage, path: str, joints: tuple[str, ...], method: str) -> None:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = [(x, y, 0.3 * y) for x in (0.0, 1.9, 2.1, 4.2) for y in (-0.2, 0.2)]
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr([4, 4, 4])
    mesh.CreateFaceVertexIndicesAttr([0, 2, 3, 1, 2, 4, 5, 3, 4, 6, 7, 5])
    mesh.AddTranslateOp().Set(Gf.Vec3d(7.0, 7.0, 7.0))
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets([Sdf.Path("/Arm/Skeleton")])
    tokens = joints or ("a", "a/b", "a/b/c")
    if joints:
        binding.CreateJointsAttr(Vt.TokenArray(list(joints)))
    if method:
        binding.CreateSkinningMethodAttr(method)
    near = {0.0: "a", 1.9: "a", 2.1: "a/b", 4.2: "a/b/c"}
    indices, weights = [], []
    for x, _, _ in points:
        first = near[x] if near[x] in tokens else tokens[-1]
        other = tokens[(tokens.index(first) + 1) % len(tokens)]
        indices += [tokens.index(first), tokens.index(other)]
        weights += [0.7, 0.3]
    binding.CreateJointIndicesPrimvar(False, 2).Set(Vt.IntArray(indices))
    binding.CreateJointWeightsPrimvar(False, 2).Set(Vt.FloatArray(weights))
    binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(0.1, 0.2, 0.3)))


def shaped() -> Usd.Stage:
    """Return the arm with a blend shape that comes in."""
    stage = arm()
    skin = stage.GetPrimAtPath("/Arm/Skin")
    shape = UsdSkel.BlendShape.Define(stage, "/Arm/Skin/Bulge")
    shape.CreateOffsetsAttr([(0.0, 0.5, 0.5), (0.0, -0.5, 0.1)])
    shape.CreatePointIndicesAttr([2, 5])
    UsdSkel.BindingAPI(skin).CreateBlendShapesAttr(["other", "bulge"])
    other = UsdSkel.BlendShape.Define(stage, "/Arm/Skin/Other")
    other.CreateOffsetsAttr([(1.0, 0.0, 0.0)] * 8)
    UsdSkel.BindingAPI(skin).CreateBlendShapeTargetsRel().SetTargets(
        [other.GetPath(), shape.GetPath()]
    )
    animation = UsdSkel.Animation.Get(stage, "/Arm/Skeleton/Animation")
    animation.CreateBlendShapesAttr(["bulge"])
    weights = animation.CreateBlendShapeWeightsAttr()
    weights.Set([0.0], 1.0)
    weights.Set([0.4], 4.5)
    weights.Set([1.0], 9.0)
    return stage


def shifted() -> Usd.Stage:
    """Return the arm below a layer offset, brought in by a reference."""
    beneath = arm()
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    above = UsdGeom.Xform.Define(stage, "/Set/Arm")
    above.AddTranslateOp().Set(Gf.Vec3d(0.0, 4.0, 0.0))
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.TransferContent(beneath.GetRootLayer())
    above.GetPrim().GetReferences().AddReference(
        layer.identifier, "/Arm", Sdf.LayerOffset(0.5, 0.5)
    )
    return stage


def instanced() -> Usd.Stage:
    """Return two instances of the arm, one of which has a motion of its own."""
    beneath = arm()
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.TransferContent(beneath.GetRootLayer())
    still = UsdSkel.Animation.Define(stage, "/Straight")
    still.CreateJointsAttr(["a", "a/b", "a/b/c"])
    still.CreateTranslationsAttr([(0, 0, 0), (3, 0, 0), (2, 0, 0)])
    still.CreateScalesAttr([(1, 1, 1)] * 3)
    still.CreateRotationsAttr([Gf.Quatf(1.0)] * 3)
    skeleton = layer.GetPrimAtPath("/Arm/Skeleton")
    skeleton.RemoveProperty(skeleton.relationships["skel:animationSource"])
    clip = stage.DefinePrim("/Clip")
    clip.GetReferences().AddReference(layer.identifier, "/Arm/Skeleton/Animation")
    for name, source in (("Moved", "/Clip"), ("Still", "/Straight")):
        above = UsdSkel.Root.Define(stage, f"/Set/{name}").GetPrim()
        above.GetReferences().AddReference(layer.identifier, "/Arm")
        above.SetInstanceable(True)
        UsdSkel.BindingAPI.Apply(above).CreateAnimationSourceRel().SetTargets([Sdf.Path(source)])
    return stage


def rigid() -> Usd.Stage:
    """Return the arm with a cube that one joint carries whole."""
    stage = arm()
    cube = UsdGeom.Cube.Define(stage, "/Arm/Box")
    cube.AddTranslateOp().Set(Gf.Vec3d(4.0, 0.0, 0.0))
    binding = UsdSkel.BindingAPI.Apply(cube.GetPrim())
    binding.CreateSkeletonRel().SetTargets([Sdf.Path("/Arm/Skeleton")])
    binding.CreateJointIndicesPrimvar(True, 1).Set(Vt.IntArray([2]))
    binding.CreateJointWeightsPrimvar(True, 1).Set(Vt.FloatArray([1.0]))
    return stage


STAGES: dict[str, Callable[[], Usd.Stage]] = {
    "moving root": arm,
    "Z up, in centimetres": lambda: arm(up="Z", unit=0.01),
    "some joints, in another order": lambda: arm(joints=("a/b/c", "a")),
    "dual quaternions": lambda: arm(method="dualQuaternion"),
    "blend shapes": shaped,
    "layer offset": shifted,
    "instances": instanced,
}


def baked(stage: Usd.Stage, code: float) -> dict[str, np.ndarray]:
    """Return world points [m] of the meshes, with skinning baked into them by UsdSkel."""
    copy = Usd.Stage.Open(Usd.Stage.Open(_singled(stage)).Flatten())
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    interval = Gf.Interval(code, code)
    meshes = [prim for prim in copy.Traverse() if prim.IsA(UsdGeom.Mesh)]
    for prim in list(copy.Traverse()):
        if prim.IsA(UsdSkel.Root):
            assert UsdSkel.BakeSkinning(UsdSkel.Root(prim), interval)
    found = {}
    for prim in meshes:
        points = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get(code))
        matrix = np.array(UsdGeom.XformCache(code).GetLocalToWorldTransform(prim))
        found[str(prim.GetPath())] = unit * (points @ matrix[:3, :3] + matrix[3, :3])
    return found


def _singled(stage: Usd.Stage) -> Sdf.Layer:
    """Return the root layer of a stage without instances, in which nothing could be baked."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.TransferContent(stage.GetRootLayer())
    for prim in stage.Traverse():
        if prim.IsInstance():
            layer.GetPrimAtPath(prim.GetPath()).instanceable = False
    return layer


def seen(stage: Usd.Stage, code: float) -> dict[str, np.ndarray]:
    surfaces = Sight.of(stage, read_facts(stage)).surfaces(code)
    return {each.path: each.points for each in surfaces}


@pytest.mark.parametrize("name", STAGES)
@pytest.mark.parametrize("code", CODES)
def test_points_are_where_usdskel_bakes_them(name, code):
    stage = STAGES[name]()
    known, found = baked(stage, code), seen(stage, code)
    assert known.keys() == found.keys()
    for path in known:
        size = np.ptp(known[path], axis=0).max()
        np.testing.assert_allclose(found[path], known[path], atol=1e-5 * size)


def test_what_bends_is_somewhere_else_later():
    stage = arm()
    first, last = (seen(stage, code)["/Arm/Skin"] for code in (1.0, 9.0))
    spans = [np.linalg.norm(each[0] - each[-1]) for each in (first, last)]
    assert spans[1] < 0.9 * spans[0]


def test_a_shape_that_one_joint_carries_goes_along_whole():
    stage = rigid()
    first, last = (seen(stage, code)["/Arm/Box"] for code in (1.0, 9.0))
    gaps = [np.linalg.norm(each[:, None] - each[None], axis=2) for each in (first, last)]
    np.testing.assert_allclose(gaps[0], gaps[1], atol=1e-6)
    assert np.linalg.norm(first.mean(axis=0) - last.mean(axis=0)) > 1.0


@pytest.mark.parametrize("name", ["CesiumMan.usdz", "skel_dqs.usda", "RiggedFigure.usdz"])
def test_skins_of_others_are_where_usdskel_bakes_them(mocap: Path, name: str):
    stage = Usd.Stage.Open(str(mocap / "usd" / name))
    # Between samples points that are baked go straight, and joints do not.
    clip = next(prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Animation))
    codes = UsdSkel.Animation(clip).GetRotationsAttr().GetTimeSamples()
    code = codes[len(codes) // 2]
    known, found = baked(stage, code), seen(stage, code)
    assert known
    for path in known.keys() & found.keys():
        np.testing.assert_allclose(found[path], known[path], atol=1e-5)

"""What is drawn of a stage is what a renderer would draw."""

from collections.abc import Callable

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

import usdmotion.usd  # noqa: F401
from usdmotion.usd.seeing import SeenSurface, Sight, see_bodies
from usdmotion.usd.stages import open_stage, read_facts


@pytest.fixture
def stage() -> Usd.Stage:
    made = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(made, 0.01)
    return made


def paths(stage: Usd.Stage, code: float = 1.0) -> list[str]:
    return [each.path for each in look(stage, code)]


def look(stage: Usd.Stage, code: float = 1.0) -> tuple[SeenSurface, ...]:
    return Sight.of(stage, read_facts(stage)).surfaces(code)


@pytest.mark.parametrize("kind", ["Cube", "Sphere", "Cylinder", "Capsule", "Cone", "Plane"])
@pytest.mark.parametrize("axis", "XYZ")
def test_shapes_are_as_large_as_usd_says(stage, kind, axis):
    prim = stage.DefinePrim("/Shape", kind)
    if prim.HasAttribute("axis"):
        prim.GetAttribute("axis").Set(axis)
    for name, size in {"width": 3.0, "length": 5.0, "height": 4.0, "radius": 0.5}.items():
        if prim.HasAttribute(name):
            prim.GetAttribute(name).Set(size)
    extent = UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), 1.0)
    (seen,) = look(stage)
    spans = np.array([seen.points.min(axis=0), seen.points.max(axis=0)])
    np.testing.assert_allclose(spans, 0.01 * np.array(extent), atol=1e-9)


def test_hidden_prims_come_and_go(stage):
    UsdGeom.Cube.Define(stage, "/Group/Box")
    stage.DefinePrim("/Group", "Xform")
    visibility = UsdGeom.Imageable(stage.GetPrimAtPath("/Group")).CreateVisibilityAttr()
    visibility.Set("inherited", 1.0)
    visibility.Set("invisible", 5.0)
    assert paths(stage, 1.0) == ["/Group/Box"]
    assert paths(stage, 5.0) == []


def test_guides_are_never_drawn_and_proxies_only_without_what_is_rendered(stage):
    for purpose in ("default", "proxy", "guide"):
        UsdGeom.Cube.Define(stage, f"/{purpose}").CreatePurposeAttr(purpose)
    assert paths(stage) == ["/default", "/proxy"]
    UsdGeom.Cube.Define(stage, "/render").CreatePurposeAttr("render")
    assert paths(stage) == ["/default", "/render"]


def test_a_colour_is_displayed_or_the_materials_or_nobody_says(stage):
    cubes = [UsdGeom.Cube.Define(stage, f"/Cube{number}") for number in range(3)]
    cubes[0].CreateDisplayColorAttr([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
    material = UsdShade.Material.Define(stage, "/Paint")
    shader = UsdShade.Shader.Define(stage, "/Paint/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.1, 0.2, 0.3))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(cubes[1].GetPrim()).Bind(material)
    first, second, third = (each.color for each in look(stage))
    np.testing.assert_allclose(first, (0.5, 0.0, 0.5))
    np.testing.assert_allclose(second, (0.1, 0.2, 0.3), atol=1e-6)
    assert third is None


def test_instances_are_drawn_where_they_stand(stage):
    source = UsdGeom.Xform.Define(stage, "/Source")
    UsdGeom.Cube.Define(stage, "/Source/Box")
    source.GetPrim().SetSpecifier(Sdf.SpecifierClass)
    for number in range(2):
        prim = UsdGeom.Xform.Define(stage, f"/Set/Copy{number}")
        prim.AddTranslateOp().Set(Gf.Vec3d(100.0 * number, 0.0, 0.0))
        prim.GetPrim().GetReferences().AddInternalReference("/Source")
        prim.GetPrim().SetInstanceable(True)
    first, second = look(stage)
    np.testing.assert_allclose(second.points - first.points, [(1.0, 0.0, 0.0)] * 8)


def test_what_an_instancer_scatters_is_where_usd_bounds_it(stage):
    instancer = UsdGeom.PointInstancer.Define(stage, "/Set/Boxes")
    instancer.AddTranslateOp().Set(Gf.Vec3d(0.0, 50.0, 0.0))
    box = UsdGeom.Cube.Define(stage, "/Set/Boxes/Prototypes/Box")
    box.AddScaleOp().Set(Gf.Vec3f(1.0, 2.0, 3.0))
    instancer.CreatePrototypesRel().SetTargets([box.GetPath()])
    instancer.CreateProtoIndicesAttr(Vt.IntArray([0, 0, 0]))
    instancer.CreatePositionsAttr([(0, 0, 0), (300, 0, 0), (0, 0, 900)])
    instancer.CreateOrientationsAttr([Gf.Quath(1.0)] * 2 + [Gf.Quath(0.5, 0.5, 0.5, 0.5)])
    bounds = UsdGeom.BBoxCache(1.0, ["default"]).ComputeWorldBound(instancer.GetPrim())
    box_of_all = bounds.ComputeAlignedRange()
    (seen,) = look(stage)
    assert len(seen.points) == 3 * 8
    np.testing.assert_allclose(seen.points.min(axis=0), 0.01 * np.array(box_of_all.GetMin()))
    np.testing.assert_allclose(seen.points.max(axis=0), 0.01 * np.array(box_of_all.GetMax()))


def test_a_broken_mesh_is_told_of_and_not_drawn(stage):
    mesh = UsdGeom.Mesh.Define(stage, "/Broken")
    mesh.CreatePointsAttr([(0, 0, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    sight = Sight.of(stage, read_facts(stage))
    assert sight.surfaces(1.0) == ()
    assert "</Broken>" in sight.notes["/Broken"]


def test_the_light_mesh_of_our_own_characters_is_known_as_such(arm_shot: Callable[..., object]):
    stage = open_stage(arm_shot())
    (sketch,) = look(stage)
    assert sketch.sketch
    assert sketch.skeleton == "/Arm/Skeleton"
    (body,), notes = see_bodies(stage, np.array([1.0, 2.0]), read_facts(stage))
    assert body.character.path == "/Arm/Skeleton"
    assert body.visible.all()
    assert not notes


def test_a_colour_that_is_said_by_indices_counts_as_often_as_it_is_worn(stage):
    mesh = UsdGeom.Mesh.Define(stage, "/Mesh")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3] * 4)
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2] * 4)
    colors = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, "uniform"
    )
    colors.Set(Vt.Vec3fArray([(1, 0, 0), (0, 0, 1)]))
    colors.SetIndices(Vt.IntArray([0, 0, 0, 1]))
    (seen,) = look(stage)
    np.testing.assert_allclose(seen.color, (0.75, 0.0, 0.25))


def test_a_mesh_without_faces_or_without_anything_is_not_seen(stage):
    UsdGeom.Mesh.Define(stage, "/Nothing")
    mesh = UsdGeom.Mesh.Define(stage, "/Points")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([])
    mesh.CreateFaceVertexIndicesAttr([])
    assert paths(stage) == []

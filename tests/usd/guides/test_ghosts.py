"""Ghosts are like what they are of, and take part in nothing else that it takes part in."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade

from usdmotion.usd.guides.skins import Part, Skins

BALL = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
    timeCodesPerSecond = 24
    startTimeCode = 1
    endTimeCode = 40
)
def Scope "Looks"
{{
    def Material "Red" {{}}
}}
def Xform "Toys"
{{
    def Xform "Ball" ({arc})
    {{
        double3 xformOp:translate.timeSamples = {{
            1: (0, 50, 0), 12: (30, 4, 2), 30: (30, 4, 2), 40: (60, 50, 0)
        }}
        double3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
        {inside}
    }}
}}
{more}
"""
PIECES = """
        def Xform "Half"
        {
            double3 xformOp:translate = (0, 1, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def Sphere "Shell" (prepend apiSchemas = ["MaterialBindingAPI", "PhysicsCollisionAPI"])
            {
                double radius = 1
                float3[] extent = [(-1, -1, -1), (1, 1, 1)]
                rel material:binding = </Looks/Red>
                uniform token purpose = "render"
                color3f[] primvars:displayColor = [(1, 0, 0), (0, 0, 1)] (
                    interpolation = "vertex"
                )
                float[] primvars:displayOpacity = [0.9]
            }
        }
        def Sphere "Shell"
        {
            double radius = 1
        }
        def Sphere "Hidden"
        {
            token visibility = "invisible"
        }
        def Sphere "Handle"
        {
            uniform token purpose = "guide"
        }
        def SphereLight "Lamp" {}
"""


@pytest.fixture
def ghosts(tmp_path, detected):
    """Return what finds the contacts of a ball that lies still, with the ghost of the first."""
    stages = []

    def run(inside=PIECES, arc="", more="", path="/Toys/Ball"):
        shot = tmp_path / "ball.usda"
        shot.write_text(BALL.format(inside=inside, arc=arc, more=more))
        stages.append(detected(shot, prims=[path]))
        detection = stages[-1].GetPrimAtPath("/Toys/Detections/Ball")
        return detection.GetChild("Contact01").GetChild("Guides").GetChild("Ghost")

    return run


def shells(ghost):
    return [prim for prim in Usd.PrimRange(ghost) if prim.IsA(UsdGeom.Sphere)]


def test_a_ghost_has_the_pieces_that_are_seen_and_nothing_else(ghosts):
    ghost = ghosts()
    assert [prim.GetName() for prim in ghost.GetChildren()] == ["Shell", "Shell_"]
    assert all(not prim.GetChildren() for prim in ghost.GetChildren())


def test_pieces_are_where_those_of_the_prop_are(ghosts):
    ghost = ghosts()
    stage = ghost.GetStage()
    props = ("/Toys/Ball/Half/Shell", "/Toys/Ball/Shell")
    for piece, path in zip(shells(ghost), props, strict=True):
        own, other = (
            np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(20.0))
            for prim in (piece, stage.GetPrimAtPath(path))
        )
        np.testing.assert_allclose(own, other, atol=1e-6)


def test_pieces_have_the_colour_of_the_object_and_no_material_purpose_or_physics(ghosts):
    ghost = ghosts()
    number = UsdGeom.Gprim(ghost.GetParent().GetChild("Number")).GetDisplayColorAttr().Get()
    for piece in shells(ghost):
        assert UsdGeom.Imageable(piece).ComputePurpose() == UsdGeom.Tokens.guide
        assert UsdGeom.Gprim(piece).GetDisplayColorAttr().Get() == number
        assert UsdGeom.Gprim(piece).GetDisplayColorPrimvar().GetInterpolation() == "constant"
        assert piece.GetAppliedSchemas() == []
        assert not UsdShade.MaterialBindingAPI(piece).ComputeBoundMaterial()[0]
        opacity = UsdGeom.PrimvarsAPI(piece).FindPrimvarWithInheritance("displayOpacity")
        assert opacity.Get(20.0)[0] == 1.0
        assert opacity.Get(1.0)[0] < 0.5


def test_a_prop_that_is_an_instance_has_a_ghost_too(ghosts):
    toy = f'class Xform "Toy"\n{{\n{PIECES}\n}}'
    ghost = ghosts(inside="", arc="instanceable = true; inherits = </Toy>", more=toy)
    assert len(shells(ghost)) == 2
    assert not ghost.GetStage().GetCompositionErrors()


def test_a_prop_of_very_many_pieces_is_shown_as_a_box(ghosts):
    many = "".join(f'def Sphere "Ball{index}" {{}}\n' for index in range(40))
    ghost = ghosts(inside=many)
    assert ghost.IsA(UsdGeom.Mesh)
    points = np.array(UsdGeom.Mesh(ghost).GetPointsAttr().Get())
    np.testing.assert_allclose(np.abs(points), 2.0, rtol=1e-5)


def test_a_prop_without_shapes_has_no_ghost(ghosts):
    assert not ghosts(inside="")


@pytest.mark.parametrize("name", ["First", "Second"])
def test_a_joint_of_an_instance_has_the_skin_of_its_own(name):
    stage = dense(30)
    for each in ("First", "Second"):
        copy = stage.DefinePrim(f"/{each}")
        copy.GetInherits().AddInherit("/Man")
        copy.SetInstanceable(True)
    bones = stage.GetPrimAtPath(f"/{name}/Bones")
    assert bones.IsInstanceProxy()
    part = Skins(bones).part("hips/hand")
    assert part is not None
    np.testing.assert_allclose(np.linalg.norm(part.points, axis=1), 1.0, atol=1e-3)


def dense(count=3000):
    """Return the skeleton of a stage whose second joint moves a ball of many points."""
    stage = Usd.Stage.CreateInMemory()
    unit = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, {0}, 0, 1) )"
    angles = np.random.default_rng(0).normal(size=(count, 3))
    points = angles / np.linalg.norm(angles, axis=1, keepdims=True) + (0.0, 5.0, 0.0)
    faces = np.arange(3 * (count // 3))
    text = f"""#usda 1.0
def SkelRoot "Man" {{
    def Skeleton "Bones" {{
        uniform token[] joints = ["hips", "hips/hand"]
        uniform matrix4d[] bindTransforms = [{unit.format(0)}, {unit.format(5)}]
        uniform matrix4d[] restTransforms = [{unit.format(0)}, {unit.format(5)}]
    }}
    def Mesh "Skin" (prepend apiSchemas = ["SkelBindingAPI"]) {{
        point3f[] points = {[tuple(point) for point in points.round(5).tolist()]}
        int[] faceVertexCounts = {[3] * (count // 3)}
        int[] faceVertexIndices = {faces.tolist()}
        rel skel:skeleton = </Man/Bones>
        int[] primvars:skel:jointIndices = [1] (elementSize = 1; interpolation = "constant")
        float[] primvars:skel:jointWeights = [1] (elementSize = 1; interpolation = "constant")
    }}
}}"""
    stage.GetRootLayer().ImportFromString(text)
    return stage


def test_of_a_dense_mesh_the_hull_is_shown():
    stage = dense()
    part = Skins(stage.GetPrimAtPath("/Man/Bones")).part("hips/hand")
    assert isinstance(part, Part)
    radii = np.linalg.norm(part.points, axis=1)  # about the joint
    np.testing.assert_allclose(radii, 1.0, atol=1e-3)
    faces = part.points[part.corners.reshape(-1, 3)]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    assert ((normals * faces.mean(axis=1)).sum(axis=1) > 0.0).all()


def test_a_joint_that_nothing_follows_has_no_ghost():
    stage = dense(30)
    assert Skins(stage.GetPrimAtPath("/Man/Bones")).part("hips") is None

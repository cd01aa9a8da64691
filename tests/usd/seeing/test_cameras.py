"""A camera sees what USD says that it sees."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

import usdmotion.usd  # noqa: F401
from usdmotion.errors import SceneError
from usdmotion.usd.seeing import find_camera, see_through
from usdmotion.usd.stages import read_facts

POINTS = np.array([(0.3, 0.5, -6.0), (-1.0, 0.2, -4.0), (0.0, -0.7, -9.0), (2.0, 1.0, -5.0)])
"""Before the camera, in its own frame [units]."""


def camera(projection: str, unit: float = 1.0) -> tuple[Usd.Stage, Usd.Prim]:
    """Return a stage that moves a camera, and the camera, which is gone without its stage."""
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    above = UsdGeom.Xform.Define(stage, "/Rig")
    above.AddTranslateOp().Set(Gf.Vec3d(1.0, 2.0, 3.0), 1.0)
    above.GetPrim().GetAttribute("xformOp:translate").Set(Gf.Vec3d(4.0, 2.0, 3.0), 5.0)
    above.AddScaleOp().Set(Gf.Vec3f(2.0))
    made = UsdGeom.Camera.Define(stage, "/Rig/Camera")
    made.AddRotateXYZOp().Set(Gf.Vec3f(20.0, 40.0, 10.0))
    made.CreateProjectionAttr(projection)
    made.CreateFocalLengthAttr(35.0)
    made.CreateHorizontalApertureAttr(36.0 if projection == "perspective" else 90.0)
    made.CreateVerticalApertureAttr(24.0 if projection == "perspective" else 60.0)
    made.CreateHorizontalApertureOffsetAttr(2.0)
    made.CreateVerticalApertureOffsetAttr(-3.0)
    return stage, made.GetPrim()


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("unit", [1.0, 0.01])
@pytest.mark.parametrize("code", [1.0, 3.0])
def test_places_in_the_frame_are_those_of_usd(projection, unit, code):
    stage, prim = camera(projection, unit)
    frustum = UsdGeom.Camera(prim).GetCamera(code).frustum
    world = [Gf.Vec3d(*each) for each in POINTS]
    rig = Gf.Matrix4d().SetRotate(frustum.GetRotation())
    rig.SetTranslateOnly(frustum.GetPosition())
    world = [rig.Transform(each) for each in world]
    clip = frustum.ComputeViewMatrix() * frustum.ComputeProjectionMatrix()
    known = np.array([clip.Transform(each) for each in world])[:, :2]

    seen = see_through(prim, code, read_facts(stage))
    left, bottom, right, top = seen.window
    flat = seen.flat(unit * np.array(world))
    low, high = np.array((left, bottom)), np.array((right, top))
    np.testing.assert_allclose(2.0 * (flat - low) / (high - low) - 1.0, known, atol=1e-9)


def test_lengths_in_the_picture_shrink_with_distance():
    stage, prim = camera("perspective")
    seen = see_through(prim, 1.0, read_facts(stage))
    eye = seen
    place = np.array(UsdGeom.Camera(prim).GetCamera(1.0).frustum.GetPosition())
    ahead = -np.array(eye.towards)
    points = place + np.array([[2.0], [4.0]]) * ahead
    aside = points + 0.1 * np.array(eye.right)
    lengths = np.linalg.norm(eye.flat(aside) - eye.flat(points), axis=1)
    np.testing.assert_allclose(lengths, 0.1 * eye.size(points))
    assert lengths[0] == pytest.approx(2.0 * lengths[1])
    assert eye.near(points)[0] > eye.near(points)[1]


def test_what_is_behind_a_camera_is_not_before_it():
    stage, prim = camera("perspective")
    seen = see_through(prim, 1.0, read_facts(stage))
    behind = seen.position + seen.towards
    assert not seen.near(behind) < seen.limit
    assert seen.near(seen.position - 5.0 * seen.towards) < seen.limit


@pytest.mark.parametrize("name", ["focalLength", "horizontalAperture", "verticalAperture"])
@pytest.mark.parametrize("length", [0.0, -35.0, float("nan")])
def test_a_camera_that_cannot_be_is_refused(name, length):
    stage, prim = camera("perspective")
    prim.GetAttribute(name).Set(length)
    with pytest.raises(SceneError, match=f"</Rig/Camera>.{name} is .* give it a length above 0"):
        see_through(prim, 1.0, read_facts(stage))


def test_without_perspective_no_focal_length_is_needed():
    stage, prim = camera("orthographic")
    prim.GetAttribute("focalLength").Set(0.0)
    assert see_through(prim, 1.0, read_facts(stage)).window is not None


def test_a_camera_that_is_scaled_to_nothing_is_refused():
    stage, prim = camera("perspective")
    stage.GetPrimAtPath("/Rig").GetAttribute("xformOp:scale").Set(Gf.Vec3f(0.0))
    with pytest.raises(SceneError, match="scaled to nothing at 1"):
        see_through(prim, 1.0, read_facts(stage))


def test_who_names_no_camera_is_told_which_there_are():
    stage, _ = camera("perspective")
    with pytest.raises(SceneError, match=r"</Nowhere> is not on the stage; there are </Rig/Camera"):
        find_camera(stage, "/Nowhere")
    with pytest.raises(SceneError, match="</Rig> is no Camera"):
        find_camera(stage, "/Rig")
    assert find_camera(stage, "/Rig/Camera").GetName() == "Camera"

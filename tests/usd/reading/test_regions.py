"""Shapes of a stage, as regions, are where USD puts them."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from usdmotion.constraints import RegionConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import gaps, rotate

PLACED = """
    double xformOp:rotateY.timeSamples = { 1: 0, 5: 90 }
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (10, 1, 2) }
    double xformOp:rotateX = 30
    float3 xformOp:scale = %s
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY", "xformOp:rotateX",
        "xformOp:scale"]
"""


def region_of(text, save, read, kind, body, scale="(2, 2, 2)"):
    """Return the region that a prim of the stage is read as, and the path of the stage."""
    rock = f'def {kind} "Rock" {{ {body} {PLACED % scale} }}'
    held = text.hold(kind="MotionRegionConstraint", attributes="rel usdmotion:region = </Rock>")
    path = save(text.man(edit=text.edit(held)) + rock, header=text.CENTIMETRES)
    (constraint,) = read(path).scenes[0].constraints
    assert isinstance(constraint, RegionConstraint)
    return constraint.region, path


def over_frames(value, rank):
    """Return a value that may be the same on every frame on each of five."""
    return value if np.ndim(value) > rank else np.array([value] * 5)


def distances(region, points):
    """Return how far world points are from a region on each frame, shape (5, point_count)."""
    extents, places, turns = (
        over_frames(value, 1) for value in (region.extent, region.translation, region.rotation)
    )
    found = []
    for frame, margin in enumerate(over_frames(region.margin, 0)):
        local = rotate(turns[frame] * (-1, -1, -1, 1), points - places[frame])
        extent = np.tile(extents[frame], (len(points), 1))
        found.append(gaps(int(region.shape), extent, local)[1] - margin)
    return np.array(found)


SURFACES = {
    # Points on each surface, in the frame of the prim.
    "Cube": ("double size = 3", [(1.5, 0.2, -0.4), (0.1, -1.5, 1.2), (0, 0.3, 1.5)]),
    "Sphere": ("double radius = 3", [(3, 0, 0), (0, -3, 0), (1, 2, 2)]),
    "Plane": ('uniform token axis = "X"', [(0, 5, 0), (0, -3, 7), (0, 0, 0)]),
    "Cylinder": (
        'double height = 4\ndouble radius = 1\nuniform token axis = "Y"',
        [(1, 0.5, 0), (0.6, -1, 0.8), (0.3, 2, 0.1), (0.1, -2, 0.1)],
    ),
    "Capsule": (
        'double height = 4\ndouble radius = 1\nuniform token axis = "X"',
        [(1.5, 1, 0), (-0.5, 0.6, 0.8), (3, 0, 0), (-2, 0, -1)],
    ),
}


@pytest.mark.parametrize("kind", SURFACES)
def test_what_is_on_the_surface_of_the_prim_is_on_that_of_the_region(text, save, read, kind):
    body, points = SURFACES[kind]
    region, path = region_of(text, save, read, kind, body)
    stage = Usd.Stage.Open(str(path))
    prim = UsdGeom.Xformable(stage.GetPrimAtPath("/Rock"))
    for frame in range(5):
        matrix = prim.ComputeLocalToWorldTransform(frame + 1.0)
        world = np.array([matrix.Transform(Gf.Vec3d(*point)) for point in points]) * 0.01
        np.testing.assert_allclose(distances(region, world)[frame], 0.0, atol=1e-7)
        out = np.array([matrix.Transform(Gf.Vec3d(*point) * 1.1) for point in points]) * 0.01
        assert (distances(region, out)[frame] >= -1e-9).all()


def test_the_outside_of_a_plane_is_where_its_axis_points(text, save, read):
    region, _ = region_of(text, save, read, "Plane", "")
    normal = rotate(np.atleast_2d(region.rotation)[0], np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(distances(region, normal[None])[0], 1.0)


def test_a_cube_may_be_a_box_and_a_size_may_change(text, save, read):
    body = "double size.timeSamples = { 1: 1, 5: 2 }"
    region, _ = region_of(text, save, read, "Cube", body, scale="(1, 2, 3)")
    np.testing.assert_allclose(region.extent[0], (0.005, 0.01, 0.015), rtol=1e-6)
    np.testing.assert_allclose(region.extent[4], (0.01, 0.02, 0.03), rtol=1e-6)


def test_a_cylinder_is_scaled_along_its_axis_by_itself(text, save, read):
    body = 'double height = 4\ndouble radius = 1\nuniform token axis = "X"'
    region, _ = region_of(text, save, read, "Cylinder", body, scale="(3, 2, 2)")
    np.testing.assert_allclose(over_frames(region.extent, 1)[2], (0.02, 0.02, 0.06), rtol=1e-6)


@pytest.mark.parametrize("kind", ["Sphere", "Capsule", "Cylinder"])
def test_what_a_scale_has_made_something_else_is_refused(text, save, read, kind):
    with pytest.raises(SceneError, match=r"</Rock> is scaled unevenly.*make that scale even"):
        region_of(text, save, read, kind, 'uniform token axis = "Z"', scale="(1, 2, 2)")


def test_a_mesh_is_no_region(text, save, read):
    with pytest.raises(SceneError, match="which is a Mesh; name a Plane, Cube"):
        region_of(text, save, read, "Mesh", "")


def test_a_size_below_nothing_is_refused(text, save, read):
    with pytest.raises(SceneError, match="</Rock> has a radius below 0"):
        region_of(text, save, read, "Sphere", "double radius = -1")

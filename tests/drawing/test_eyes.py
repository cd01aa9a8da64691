"""Eyes: a lens sees what the camera of a stage sees."""

import numpy as np
from pxr import Gf

from usdmotion.drawing.eyes import Camera, Perspective

POINTS = np.random.default_rng(0).uniform(-1.0, 1.0, (20, 3))


def test_a_lens_projects_as_the_camera_of_a_stage():
    camera = Gf.Camera()
    camera.transform = (
        Gf.Matrix4d().SetLookAt((3.0, 2.0, 5.0), (0.1, 0.2, 0.0), (0, 1, 0)).GetInverse()
    )
    camera.focalLength, camera.horizontalAperture, camera.verticalAperture = 35.0, 36.0, 24.0
    camera.horizontalApertureOffset, camera.verticalApertureOffset = 3.0, -2.0
    axes = np.array(camera.transform)[:3, :3]
    window = (-15.0, -14.0, 21.0, 10.0)
    eye = Perspective(np.array((3.0, 2.0, 5.0)), *axes, focal=35.0, window=window)
    frustum = camera.frustum
    seen = frustum.ComputeViewMatrix() * frustum.ComputeProjectionMatrix()
    there = np.array([seen.Transform(Gf.Vec3d(*point)) for point in POINTS.tolist()])[:, :2]
    low, high = np.reshape(window, (2, 2))
    np.testing.assert_allclose(
        (eye.flat(POINTS) - low) / (high - low), 0.5 * (there + 1.0), atol=1e-6
    )


def test_a_lens_shows_far_things_smaller_and_knows_which_is_nearer():
    eye = Perspective(np.zeros(3), *np.eye(3), focal=2.0, window=(-1.0, -1.0, 1.0, 1.0))
    near, far = np.array(((0.5, 0.0, -1.0), (0.5, 0.0, -4.0)))
    assert eye.size(near) == 4.0 * eye.size(far) == 2.0
    assert eye.flat(near)[0] == 4.0 * eye.flat(far)[0]
    assert eye.near(far) < eye.near(near) < eye.limit


def test_without_perspective_a_metre_is_a_metre():
    eye = Camera.at(np.array((0.0, 0.0, 1.0)), np.array((0.0, 1.0, 0.0)), 35.0, 20.0)
    seen = np.column_stack([eye.flat(POINTS), eye.near(POINTS)])
    lengths = [np.linalg.norm(np.diff(each, axis=0), axis=1) for each in (seen, POINTS)]
    np.testing.assert_allclose(*lengths)
    assert (eye.size(POINTS) == 1.0).all() and (eye.near(POINTS) < eye.limit).all()

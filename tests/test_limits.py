"""The host measures how far a solver leaves the limits of joints, and says it."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import PositionConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import from_vector, multiply
from usdmotion.limits import sentences
from usdmotion.motion import Body
from usdmotion.solving import Solution
from usdmotion.testing import ARM, arm_scene

ELBOW = "base/shoulder/elbow"


@pytest.fixture
def scene():
    """Return a scene whose elbow may turn by 10 degrees about y; a constraint moves all joints."""
    wrist = PositionConstraint(path="/Arm/Edit/Wrist", skeleton=ARM, joint=f"{ELBOW}/wrist")
    scene = arm_scene([wrist])
    (arm,) = scene.characters
    elbow = arm.skeleton.joints.index(ELBOW)
    low, high = np.array(arm.body.limits_min), np.array(arm.body.limits_max)
    low[elbow, 1], high[elbow, 1] = -10.0, 10.0
    body = replace(arm.body, limits_min=low, limits_max=high)
    return replace(scene, characters=(replace(arm, body=body),))


def elbow_at(scene, degrees):
    """Return the input with its elbow turned from rest about y, in all frames alike at the end."""
    cast = scene.cast
    node = cast.index[(ARM, ELBOW)]
    angles = np.zeros(cast.frame_count)
    angles[: len(degrees)] = degrees
    rotations = np.array(cast.rotations)
    turns = from_vector(np.radians(angles)[:, None] * (0.0, 1.0, 0.0))
    rotations[:, node] = multiply(cast.rest_rotations[node], turns)
    nothing = np.zeros(cast.frame_count, dtype=np.int64)
    return Solution(cast.translations, rotations, nothing, nothing)


def given(scene, solution):
    """Return the scene with the joints of a solution as its input."""
    (arm,) = scene.characters
    motion = replace(arm.motion, rotations=solution.rotations[:, 1:])
    return replace(scene, characters=(replace(arm, motion=motion),))


def test_how_far_a_joint_is_beyond_is_measured_in_degrees(scene):
    solution = elbow_at(scene, (-25.0, 8.0, 12.5))
    beyond = scene.cast.beyond_limits(solution.rotations)
    assert np.allclose(beyond.max(axis=1)[:3], (15.0, 0.0, 2.5))
    assert np.count_nonzero(beyond.max(axis=0) > 1e-9) == 1


def test_a_solver_that_leaves_limits_is_told_by_name(scene):
    (sentence,) = sentences(scene, elbow_at(scene, (25.0, 20.0)), "careless")
    assert "'careless' leaves joints beyond their limits" in sentence
    frames = scene.cast.frame_count
    assert f"{ELBOW} by up to 15.00° on 2 of {frames} frames" in sentence


def test_an_input_that_leaves_limits_is_told_where_the_result_keeps_them(scene):
    outside = given(scene, elbow_at(scene, (13.0, 11.0, 12.0)))
    (sentence,) = sentences(outside, elbow_at(scene, (10.0,)), "careful")
    assert "the result keeps the limits of joints that the input leaves" in sentence
    assert "by up to 3.00° on 3 of" in sentence


def test_nothing_is_said_where_limits_are_kept_or_nobody_moves_the_joint(scene):
    inside, outside = elbow_at(scene, (10.0,)), elbow_at(scene, (50.0,))
    assert list(sentences(given(scene, inside), inside, "any")) == []
    (edit,) = scene.edits
    idle = replace(scene, edits=(replace(edit, constraints=()),))
    assert list(sentences(idle, outside, "any")) == []


def test_limits_that_leave_no_angle_are_refused():
    free = Body.unknown(2)
    for low, high in ((10.0, 5.0), (400.0, 500.0), (np.nan, 5.0), (np.inf, np.inf)):
        limits = np.array(free.limits_min), np.array(free.limits_max)
        limits[0][1, 2], limits[1][1, 2] = low, high
        with pytest.raises(SceneError, match="joint 1 leave it no angle"):
            replace(free, limits_min=limits[0], limits_max=limits[1])

"""Goals, in whatever frame they are given."""

import numpy as np
import pytest

from usdmotion.errors import SceneError


def test_a_goal_is_where_its_parents_in_the_stage_put_it(text, first):
    place = """double3 xformOp:translate = (100, 0, 0)
    double xformOp:rotateZ = 90
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]"""
    (found,) = first(text.hold(text.goal()), xform=place).goals
    np.testing.assert_allclose(found.translation, (0.98, 0.01, 0.03), atol=1e-12)
    half = np.sqrt(0.5)
    np.testing.assert_allclose(found.rotation, (0, 0, half, half), atol=1e-12)
    np.testing.assert_allclose(found.axes, (0, 0, half, half), atol=1e-12)
    assert found.joint is None


PROP = """def Xform "Prop" {
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (0, 0, 40) }
    double xformOp:rotateZ = 90
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]
}"""


def test_a_goal_follows_the_prim_that_is_its_space(text, first):
    (found,) = first(text.hold(text.goal("rel usdmotion:space = </Prop>")), PROP).goals
    assert found.translation.shape == (5, 3)
    np.testing.assert_allclose(found.translation[0], (-0.04, 0.02, 0.06), atol=1e-12)
    np.testing.assert_allclose(found.translation[4], (-0.04, 0.02, 0.46), atol=1e-12)
    assert found.rotation.shape == (4,)


def test_an_offset_is_turned_and_sized_but_not_moved_by_its_space(text, first):
    attributes = 'rel usdmotion:space = </Prop>\nuniform token usdmotion:mode = "offset"'
    (found,) = first(text.hold(text.goal(attributes)), PROP).goals
    assert found.mode == "offset"
    np.testing.assert_allclose(found.translation, (-0.04, 0.02, 0.06), atol=1e-12)
    np.testing.assert_allclose(found.rotation, (0, 0, 0, 1), atol=1e-12)


def test_an_offset_of_an_orientation_is_told_in_the_axes_of_its_space(text, first):
    turned = """def MotionGoal "Goal" {
        double xformOp:rotateX = 90
        uniform token[] xformOpOrder = ["xformOp:rotateX"]
        rel usdmotion:space = </Prop>
        uniform token usdmotion:mode = "offset"
    }"""
    (found,) = first(text.hold(turned), PROP).goals
    half = np.sqrt(0.5)  # about x, in a space that is turned by 90 degrees: about y
    np.testing.assert_allclose(found.rotation, (0, half, 0, half), atol=1e-12)


def test_a_goal_in_the_frame_of_a_joint_is_local_to_it(text, first):
    attributes = 'rel usdmotion:space = </Man/Bones>\nuniform token usdmotion:spaceJoint = "hip"'
    (found,) = first(text.hold(text.goal(attributes)), xform=text.SCALED).goals
    assert found.joint == ("/Man/Bones", "hip")
    np.testing.assert_allclose(found.translation, (0.02, 0.04, 0.06))


def test_a_skeleton_without_a_joint_is_a_space_like_any_prim(text, first):
    (found,) = first(
        text.hold(text.goal("rel usdmotion:space = </Man/Bones>")), xform=text.SCALED
    ).goals
    assert found.joint is None
    np.testing.assert_allclose(found.translation, (0.02, 0.04, 0.06))


def test_a_joint_of_no_skeleton_is_refused(text, first):
    with pytest.raises(SceneError, match="Edit/Hold/Goal> names the joint 'hip' in"):
        first(text.hold(text.goal('uniform token usdmotion:spaceJoint = "hip"')))


def test_several_goals_are_read_in_order_with_their_own_activities(text, first):
    inside = text.goal("double usdmotion:activity = 0.25", "A") + text.goal(
        "uniform timecode[] usdmotion:times = [2, 3]", "B"
    )
    a, b = first(text.hold(inside)).goals
    assert (a.activity, a.times) == (0.25, ())
    np.testing.assert_allclose(b.times, (1 / 24, 2 / 24))

"""A footprint is flat on the ground, around the foot that leaves it, and turns with it."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from usdmotion.guides.soles import sole

FOOT = np.array([(0.1, 0.09, 0.2), (0.1, 0.02, 0.35)])
UP = np.array([0.0, 1.0, 0.0])
ANGLES = st.floats(-3.0, 3.0)


def area(outline):
    return ConvexHull(outline[:, [0, 2]]).volume


def test_it_is_flat_at_the_height_of_the_ground():
    assert (sole(FOOT, UP, 0.013)[:, 1] == 0.013).all()


def test_ankle_and_ball_are_above_it_and_the_heel_and_the_toes_stand_out():
    outline = sole(FOOT, UP, 0.0)
    assert outline[:, 2].min() < 0.17 and outline[:, 2].max() > 0.4
    assert 0.05 < np.ptp(outline[:, 0]) < 0.1 < 0.2 < np.ptp(outline[:, 2]) < 0.32
    np.testing.assert_allclose(outline[:, 0].mean(), 0.1, atol=1e-3)


@given(ANGLES)
def test_it_turns_with_the_foot(angle):
    turn = Rotation.from_rotvec(angle * UP)
    turned = sole(turn.apply(FOOT), UP, 0.0)
    np.testing.assert_allclose(area(turned), area(sole(FOOT, UP, 0.0)), rtol=0.03)
    ahead = turned.mean(axis=0) - turn.apply(FOOT[0])
    np.testing.assert_allclose(np.cross(ahead, turn.apply((0.0, 0.0, 1.0)))[1], 0.0, atol=5e-3)


def test_of_a_foot_of_which_one_point_is_known_it_is_around_that():
    outline = sole(FOOT[1:], UP, 0.0)
    np.testing.assert_allclose(outline[:, [0, 2]].mean(axis=0), FOOT[1, [0, 2]], atol=1e-9)


def test_it_is_seen_from_above_whichever_axis_is_up():
    for up in np.eye(3):
        outline = sole(np.array([np.zeros(3), 0.1 * np.roll(up, 1)]), up, 0.0)
        corners = outline - outline.mean(axis=0)
        turns = np.cross(corners, np.roll(corners, -1, axis=0)) @ up
        assert (turns > 0.0).all()


@given(st.floats(-1e-3, 1e-3), st.floats(-1e-3, 1e-3))
def test_of_a_foot_that_points_straight_down_it_is_around_that(x, z):
    outline = sole(np.array([(0.0, 0.1, 0.0), (x, 0.02, z)]), UP, 0.0)
    assert 0.03 < np.ptp(outline[:, 0]) < 0.1
    assert 0.03 < np.ptp(outline[:, 2]) < 0.1

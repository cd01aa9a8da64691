"""What is left of constraints, in their units."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import ContactConstraint, OrientationConstraint, PositionConstraint
from usdmotion.kernels import from_vector, multiply
from usdmotion.measuring import measure, tolerance
from usdmotion.solving import Problem, Solution
from usdmotion.testing import ARM, arm_scene

WRIST = "base/shoulder/elbow/wrist"


def turned(*constraints, angle=0.02):
    """Return what is left where the wrist is turned about itself and nothing else is changed."""
    scene = arm_scene(constraints)
    problem = Problem.of(scene)
    cast = problem.cast
    rotations = np.array(cast.rotations)
    node = cast.index[(ARM, WRIST)]
    rotations[:, node] = multiply(rotations[:, node], from_vector(np.array([angle, 0.0, 0.0])))
    still = np.zeros(cast.frame_count, dtype=np.int64)
    solution = Solution(cast.translations, rotations, still, still)
    return measure(problem, solution, scene.constraints)


def at_wrist(kind, **fields):
    return kind(path="/It", skeleton=ARM, joint=WRIST, **fields)


def test_a_turn_is_told_in_degrees():
    left = turned(at_wrist(OrientationConstraint))
    assert np.allclose(left, np.degrees(0.02))


def test_a_turn_does_not_move_the_joint_itself():
    assert np.allclose(turned(at_wrist(PositionConstraint)), 0.0)


def test_a_point_beside_it_is_moved_by_the_arc():
    left = turned(at_wrist(PositionConstraint, point=np.array([0.0, 0.3, 0.0])))
    assert np.allclose(left, 0.3 * 0.02, rtol=1e-3)


def test_a_contact_in_metres_counts_the_turn_of_what_it_holds():
    scene = arm_scene()
    cast = scene.cast
    node = cast.index[(ARM, WRIST)]
    contact = at_wrist(
        ContactConstraint,
        location=cast.positions[3, node],
        orientation=cast.orientations[3, node],
    )
    assert turned(contact)[3] == pytest.approx(0.1 * 0.02)


def test_constraints_do_not_mix():
    left = turned(at_wrist(PositionConstraint), at_wrist(OrientationConstraint))
    assert np.allclose(left, [[0.0, np.degrees(0.02)]])


def test_what_counts_as_met_is_a_millimetre_or_a_degree_if_nothing_is_said():
    assert tolerance(at_wrist(PositionConstraint)) == 1e-3
    assert tolerance(at_wrist(OrientationConstraint)) == 1.0
    assert tolerance(replace(at_wrist(PositionConstraint), tolerance=0.02)) == 0.02

"""Two points keep a distance, or a bound of it."""

import numpy as np
import pytest

from usdmotion.constraints import DistanceConstraint, Goal
from usdmotion.errors import SceneError
from usdmotion.kernels import Kind
from usdmotion.solving import Problem
from usdmotion.testing import humanoid_scene

PALM = np.array([0.08, 0.0, 0.02])


def apart(humanoid, cast, other="right_wrist"):
    """Return how far a palm is from another joint [m], shape (frame_count,)."""
    palm = humanoid.point(cast, "left_wrist", PALM)
    return np.linalg.norm(palm - humanoid.point(cast, other), axis=1)


def distance(humanoid, *goals, other="right_wrist", **fields):
    return DistanceConstraint(
        path="/Distance",
        skeleton=humanoid.path,
        joint=humanoid.token("left_wrist"),
        point=PALM,
        other_joint=humanoid.token(other) if other else "",
        goals=goals,
        **fields,
    )


@pytest.mark.parametrize("length", [0.0, 0.1, 0.6])
def test_two_joints_are_as_far_apart_as_is_asked(humanoid, length):
    solved = humanoid.solve(distance(humanoid, distance=length))
    np.testing.assert_allclose(apart(humanoid, solved.after), length, atol=1e-6)
    assert solved.errors.max() < 1e-6


def test_both_chains_are_recruited_unless_it_names_joints(humanoid):
    both = humanoid.solve(distance(humanoid, distance=0.5))
    one = humanoid.solve(
        distance(humanoid, distance=0.5, recruits=humanoid.chain("left_wrist")[:3])
    )
    for solved, moves in ((both, True), (one, False)):
        elbow = humanoid.node("right_elbow")
        moved = np.abs(solved.after.rotations[:, elbow] - solved.before.rotations[:, elbow]).max()
        assert (moved > 1e-3) == moves
        np.testing.assert_allclose(apart(humanoid, solved.after), 0.5, atol=1e-6)


def test_a_length_may_change_over_time(humanoid):
    lengths = np.linspace(0.1, 0.7, humanoid.cast.frame_count)
    solved = humanoid.solve(distance(humanoid, distance=lengths))
    np.testing.assert_allclose(apart(humanoid, solved.after), lengths, atol=1e-6)


def test_no_distance_is_a_point_held_in_all_directions(humanoid):
    for bound, kind in (("equal", Kind.POINT), ("atMost", Kind.POINT), ("atLeast", Kind.DISTANCE)):
        scene = humanoid_scene([distance(humanoid, bound=bound)])
        assert Problem.of(scene).table.kind.tolist() == [kind]


@pytest.mark.parametrize(("bound", "length"), [("atLeast", 0.2), ("atMost", 2.0)])
def test_a_bound_that_is_kept_asks_for_nothing(humanoid, bound, length):
    solved = humanoid.solve(distance(humanoid, distance=length, bound=bound))
    np.testing.assert_allclose(solved.after.rotations, solved.before.rotations, atol=1e-15)
    assert not solved.solution.iterations.any()
    assert solved.errors.max() == 0.0


def test_a_bound_that_is_crossed_is_gone_back_to_and_no_farther(humanoid):
    before = apart(humanoid, humanoid.cast)
    length = float(np.median(before))
    for bound, wanted in (("atLeast", np.maximum), ("atMost", np.minimum)):
        solved = humanoid.solve(distance(humanoid, distance=length, bound=bound))
        found = apart(humanoid, solved.after)
        np.testing.assert_allclose(found, wanted(before, length), atol=2e-4)
        assert solved.errors.max() < 1e-6


def test_a_distance_may_be_from_a_goal(humanoid):
    where = np.array([0.3, 1.2, 0.5])
    solved = humanoid.solve(distance(humanoid, Goal(translation=where), other=None, distance=0.15))
    palm = humanoid.point(solved.after, "left_wrist", PALM)
    np.testing.assert_allclose(np.linalg.norm(palm - where, axis=1), 0.15, atol=1e-6)


def test_as_a_goal_fades_the_distance_asked_for_becomes_the_original(humanoid):
    where = np.array([0.3, 1.2, 0.5])
    before = np.linalg.norm(humanoid.point(humanoid.cast, "left_wrist", PALM) - where, axis=1)
    goal = Goal(translation=where, activity=0.25)
    solved = humanoid.solve(distance(humanoid, goal, other=None, distance=0.15))
    palm = humanoid.point(solved.after, "left_wrist", PALM)
    found = np.linalg.norm(palm - where, axis=1)
    np.testing.assert_allclose(found, 0.25 * 0.15 + 0.75 * before, atol=1e-6)


def test_a_distance_to_nothing_and_an_unknown_bound_are_refused(humanoid):
    with pytest.raises(SceneError, match="</Distance> is a distance to nothing"):
        humanoid.solve(distance(humanoid, other=None))
    with pytest.raises(SceneError, match="use equal, atLeast, atMost"):
        humanoid.solve(distance(humanoid, bound="about"))

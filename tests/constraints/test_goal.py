"""The composite goal (2003, section 3.3): P = A Σ aᵢPᵢ / Σ aᵢ + (1 − A) P_o, A = max aᵢ."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from usdmotion.constraints import Constraint, Goal, OrientationConstraint, PositionConstraint
from usdmotion.constraints.goal import Shares
from usdmotion.errors import SceneError
from usdmotion.kernels import conjugate, forward, from_vector, multiply, residuals, to_vector
from usdmotion.solving import Problem
from usdmotion.testing import ARM, arm_scene

TOKEN = "base/shoulder/elbow/wrist"
WRIST = PositionConstraint(path="/Arm/Edit/wrist", skeleton=ARM, joint=TOKEN)
TURN = OrientationConstraint(path="/Arm/Edit/turn", skeleton=ARM, joint=TOKEN)
SCENE = arm_scene(frame_count=5)
NODE = SCENE.cast.index[ARM, TOKEN]
ORIGINAL = SCENE.cast.positions[:, NODE]
TIMES = SCENE.cast.times

activities = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=4)
vectors = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)


def target(*goals: Goal) -> np.ndarray:
    (task,) = replace(WRIST, goals=goals).tasks(SCENE.cast)
    return task.target


def left(constraint: Constraint) -> np.ndarray:
    """Return what the input motion leaves of a constraint, shape (frame_count,)."""
    problem = Problem.of(arm_scene([constraint], frame_count=5))
    cast = problem.cast
    poses = forward(cast.parents, cast.translations, cast.rotations)
    return residuals(problem.table, *poses)[:, 0]


@given(activities)
def test_shares_sum_to_the_largest_activity(each: list[float]) -> None:
    shares = Shares.of([Goal(activity=activity) for activity in each], TIMES)
    np.testing.assert_allclose(sum(shares.weights), max(each), atol=1e-12)
    np.testing.assert_allclose(shares.blend, max(each))


@given(st.lists(st.tuples(st.floats(0.0, 1.0), vectors), min_size=1, max_size=4))
def test_the_target_is_the_composite_formula(each: list[tuple[float, np.ndarray]]) -> None:
    found = target(*(Goal(activity=activity, translation=at) for activity, at in each))
    blend, total = max(a for a, _ in each), sum(a for a, _ in each)
    mean = sum(a * at for a, at in each) / total if total > 0.0 else np.zeros(3)
    np.testing.assert_allclose(found, blend * mean + (1.0 - blend) * ORIGINAL, atol=1e-9)


def test_no_goal_preserves_the_original_trajectory() -> None:
    np.testing.assert_array_equal(target(), ORIGINAL)
    assert left(WRIST).max() < 1e-12


def test_a_goal_that_is_off_preserves_it_too() -> None:
    np.testing.assert_allclose(target(Goal(activity=0.0, translation=np.ones(3))), ORIGINAL)


@given(vectors, st.floats(0.0, 1.0))
def test_an_offset_goal_adds_to_the_original_trajectory(shift: np.ndarray, share: float) -> None:
    found = target(Goal(mode="offset", activity=share, translation=shift))
    np.testing.assert_allclose(found, ORIGINAL + share * shift, atol=1e-12)


def test_a_goal_in_a_joints_frame_rides_on_the_joint() -> None:
    elbow = SCENE.cast.index[ARM, "base/shoulder/elbow"]
    where = np.array(SCENE.cast.translations[0, NODE])
    assert elbow == SCENE.cast.parents[NODE]
    riding = Goal(joint=(ARM, "base/shoulder/elbow"), translation=where)
    assert left(replace(WRIST, goals=(riding,))).max() < 1e-12
    off_by = replace(riding, translation=np.add(where, (0.0, 0.0, 0.25)))
    np.testing.assert_allclose(left(replace(WRIST, goals=(off_by,))), 0.25, atol=1e-12)


def test_an_offset_in_a_joints_frame_is_turned_and_not_moved() -> None:
    shift = np.array([0.0, 0.1, 0.0])
    riding = Goal(mode="offset", joint=(ARM, "base/shoulder/elbow"), translation=shift)
    np.testing.assert_allclose(left(replace(WRIST, goals=(riding,))), 0.1, atol=1e-12)


@pytest.mark.parametrize(("axes", "wanted"), [("xyz", 5.0), ("xy", 3.0), ("y", 0.0), ("z", 4.0)])
def test_only_the_held_axes_count(axes: str, wanted: float) -> None:
    goal = Goal(mode="offset", translation=np.array([3.0, 0.0, 4.0]))
    found = left(replace(WRIST, goals=(goal,), axes=axes))
    np.testing.assert_allclose(found, wanted, atol=1e-12)


def test_held_axes_are_those_of_the_goals_space() -> None:
    quarter = from_vector(np.array([0.0, np.pi / 2, 0.0]))
    goal = Goal(mode="offset", translation=np.array([3.0, 0.0, 4.0]), axes=quarter)
    np.testing.assert_allclose(left(replace(WRIST, goals=(goal,), axes="x")), 4.0, atol=1e-12)


@pytest.mark.parametrize("axes", ["", "w", "xq"])
def test_axes_that_are_none_are_refused(axes: str) -> None:
    with pytest.raises(SceneError, match=r"holds the axes '.*'; name some of 'xyz'"):
        replace(WRIST, axes=axes).demand(SCENE.cast)


def test_some_axes_of_goals_in_different_spaces_are_refused() -> None:
    quarter = from_vector(np.array([0.0, np.pi / 2, 0.0]))
    goals = (Goal(), Goal(axes=quarter))
    with pytest.raises(SceneError, match="goals in different spaces"):
        replace(WRIST, goals=goals, axes="xy").demand(SCENE.cast)


def angle_to(constraint: Constraint, wanted: np.ndarray) -> float:
    """Return how far a constraint's target is from an orientation [degrees]."""
    (task,) = constraint.tasks(SCENE.cast)
    turns = to_vector(multiply(task.original, conjugate(wanted)))
    return float(np.degrees(np.linalg.norm(turns, axis=-1).max()))


@given(vectors, vectors, st.floats(0.01, 1.0), st.floats(0.01, 1.0))
def test_orientations_are_the_chordal_mean_then_a_slerp_from_the_original(
    one: np.ndarray, other: np.ndarray, share_one: float, share_other: float
) -> None:
    turns = Rotation.from_rotvec([0.3 * one, 0.3 * other])
    goals = tuple(
        Goal(activity=share, rotation=turn.as_quat())
        for turn, share in zip(turns, (share_one, share_other), strict=True)
    )
    mean = turns.mean([share_one, share_other])
    original = Rotation.from_quat(SCENE.cast.orientations[:, NODE])
    blend = max(share_one, share_other)
    way = (mean * original.inv()).as_rotvec()
    wanted = Rotation.from_rotvec(blend * way) * original
    assert angle_to(replace(TURN, goals=goals), wanted.as_quat()) < 1e-6


def test_an_offset_orientation_turns_the_original() -> None:
    quarter = from_vector(np.array([0.0, 0.4, 0.0]))
    goal = Goal(mode="offset", rotation=quarter)
    np.testing.assert_allclose(left(replace(TURN, goals=(goal,))), 0.4, atol=1e-12)


def test_a_free_axis_lets_turns_about_it_go() -> None:
    axis = np.array([1.0, 0.0, 0.0])
    twist = multiply(SCENE.cast.orientations[:, NODE], from_vector(0.7 * axis[None]))
    held = replace(TURN, goals=(Goal(rotation=twist),))
    np.testing.assert_allclose(left(held), 0.7, atol=1e-9)
    assert left(replace(held, free_axis=axis)).max() < 1e-9


def test_an_offset_orientation_in_a_moving_frame_is_refused() -> None:
    riding = Goal(mode="offset", joint=(ARM, "base"))
    with pytest.raises(SceneError, match="make its mode 'position'"):
        replace(TURN, goals=(riding,)).demand(SCENE.cast)

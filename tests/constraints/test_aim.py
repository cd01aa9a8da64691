"""An axis points where it is told to."""

import numpy as np
import pytest

from usdmotion.constraints import AimConstraint, Goal
from usdmotion.errors import SceneError
from usdmotion.kernels import rotate

AXIS = np.array([0.0, 0.6, 0.8])
EYE = np.array([0.02, 0.05, 0.1])


def aim(humanoid, *goals, joint="head", **fields):
    return AimConstraint(
        path="/Aim",
        skeleton=humanoid.path,
        joint=humanoid.token(joint),
        point=EYE,
        aim=2.5 * AXIS,
        goals=goals,
        **fields,
    )


def sight(humanoid, cast, joint="head"):
    """Return where the eye is and where it looks, each of shape (frame_count, 3)."""
    node = humanoid.node(joint)
    eye = humanoid.point(cast, joint, EYE)
    return eye, rotate(cast.orientations[:, node], AXIS)


def off(directions, ways):
    """Return the largest angle between directions [degrees]."""
    ways = ways / np.linalg.norm(ways, axis=-1, keepdims=True)
    return np.degrees(np.arccos(np.clip(np.sum(directions * ways, axis=-1), -1.0, 1.0))).max()


@pytest.mark.parametrize("where", [(1.0, 1.5, 2.0), (-2.0, 0.5, 0.5), (0.3, 1.9, 0.4)])
def test_the_axis_points_at_the_goal_from_its_point(humanoid, where):
    solved = humanoid.solve(aim(humanoid, Goal(translation=np.array(where))))
    eye, direction = sight(humanoid, solved.after)
    assert off(direction, where - eye) < 1e-3
    assert solved.errors.max() < 1e-3


def test_without_goals_it_points_where_it_did(humanoid):
    turn = humanoid.lift("head", 0.1, priority=1)
    solved = humanoid.solve(turn, aim(humanoid, priority=2))
    _, before = sight(humanoid, solved.before)
    _, after = sight(humanoid, solved.after)
    assert off(after, before) < 1e-3
    assert np.abs(solved.after.positions - solved.before.positions).max() > 0.05


def test_a_goal_in_a_joint_is_followed_as_it_is_moved(humanoid):
    hand = humanoid.lift("left_wrist", 0.2)
    goal = Goal(joint=(humanoid.path, humanoid.token("left_wrist")))
    solved = humanoid.solve(hand, aim(humanoid, goal, priority=2, recruits=humanoid.chain("head")))
    eye, direction = sight(humanoid, solved.after)
    wrist = solved.after.positions[:, humanoid.node("left_wrist")]
    assert off(direction, wrist - eye) < 1e-3


def test_half_a_goal_is_a_point_between_it_and_where_it_looked(humanoid):
    where = np.array([1.0, 1.5, 2.0])
    solved = humanoid.solve(aim(humanoid, Goal(translation=where, activity=0.5)))
    eye, before = sight(humanoid, solved.before)
    aimed = eye + before * np.linalg.norm(where - eye, axis=1)[:, None]
    now, direction = sight(humanoid, solved.after)
    assert off(direction, 0.5 * (where + aimed) - now) < 1e-3


def test_a_goal_that_is_off_asks_for_nothing(humanoid):
    goal = Goal(translation=np.array([1.0, 1.5, 2.0]), activity=0.0)
    solved = humanoid.solve(aim(humanoid, goal))
    np.testing.assert_allclose(solved.after.positions, solved.before.positions, atol=1e-6)


def test_turning_about_the_axis_is_free(humanoid):
    where = np.array([1.0, 1.5, 2.0])
    roll = humanoid.turn("head", (0.0, 0.0, 1.0))
    solved = humanoid.solve(aim(humanoid, Goal(translation=where)), roll)
    eye, direction = sight(humanoid, solved.after)
    assert off(direction, where - eye) < 1e-3


def test_no_axis_is_refused(humanoid):
    nowhere = AimConstraint(
        path="/Aim", skeleton=humanoid.path, joint=humanoid.token("head"), aim=np.zeros(3)
    )
    with pytest.raises(SceneError, match="</Aim> aims along no axis"):
        humanoid.solve(nowhere)

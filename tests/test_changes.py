"""Which frames a change reaches: those on which it asks for something else, and no others."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import Constraint, Goal, PositionConstraint, Scene, SceneError
from usdmotion.changes import changed, hull, same_levels
from usdmotion.constraints import TrajectoryConstraint
from usdmotion.testing import ARM, arm_scene

COUNT = 48
GOAL = Goal(translation=np.array([0.4, 1.5, 0.2]), times=(0.5, 0.7, 0.9, 1.1))
"""Active on the open interval of frames 12 to 26."""
WRIST = PositionConstraint(
    path="/Arm/Edit/wrist", skeleton=ARM, joint="base/shoulder/elbow/wrist", goals=(GOAL,)
)
ELBOW = PositionConstraint(
    path="/Arm/Edit/elbow", skeleton=ARM, joint="base/shoulder/elbow", priority=2, times=(1.0, 1.5)
)
NOTHING = (0, 0)


def reached(before: list[Constraint], after: list[Constraint]) -> tuple[int, int]:
    found = changed(*(arm_scene(each, frame_count=COUNT) for each in (before, after)))
    return found.start, found.stop


def with_goal(**fields: object) -> Constraint:
    return replace(WRIST, goals=(replace(GOAL, **fields),))


def test_what_is_equal_reaches_nothing() -> None:
    assert reached([WRIST, ELBOW], [WRIST, ELBOW]) == NOTHING
    assert reached([WRIST], [with_goal(translation=np.array(GOAL.translation))]) == NOTHING


def test_a_goal_reaches_where_it_has_a_part() -> None:
    assert reached([WRIST, ELBOW], [with_goal(translation=np.ones(3)), ELBOW]) == (13, 27)


def test_a_goal_that_is_moved_in_time_reaches_from_where_it_was_to_where_it_is() -> None:
    assert reached([WRIST], [with_goal(times=(1.5, 1.6, 1.7, 1.8))]) == (13, 44)
    assert reached([WRIST], [with_goal(times=(0.5, 0.7, 1.3, 1.5))]) == (22, 36)


def test_a_constraint_that_recruits_a_limited_joint_reaches_where_the_input_is_beyond() -> None:
    def limited(constraints: list[Constraint], degrees: float) -> Scene:
        scene = arm_scene(constraints, frame_count=COUNT)
        (arm,) = scene.characters
        most = np.array(arm.body.limits_max)
        most[1, 2] = degrees
        return replace(scene, characters=(replace(arm, body=replace(arm.body, limits_max=most)),))

    late = replace(ELBOW, times=(1.0, 1.5))
    cast = limited([], 22.8).cast
    assert np.flatnonzero(cast.beyond_limits(cast.rotations).any(axis=1)).tolist() == [6, 30]
    assert changed(limited([], 22.8), limited([late], 22.8)) == slice(6, 37)
    assert changed(limited([], 23.0), limited([late], 23.0)) == slice(24, 37)


def test_a_goal_reaches_no_further_than_its_constraint() -> None:
    short = replace(WRIST, times=(0.75, 0.8))
    moved = replace(short, goals=(replace(GOAL, translation=np.ones(3)),))
    assert reached([short], [moved]) == (18, 20)


def test_activity_reaches_where_it_is_another_one() -> None:
    activity = np.ones(COUNT)
    activity[30:33] = 0.5
    assert reached([WRIST], [replace(WRIST, activity=activity)]) == (30, 33)
    assert reached([ELBOW], [replace(ELBOW, activity=activity)]) == (30, 33)
    assert reached([ELBOW], [replace(ELBOW, times=(1.0, 1.25))]) == (31, 37)


@pytest.mark.parametrize(
    "fields",
    [
        {"recruits": ("base/shoulder",)},
        {"weight": 2.0},
        {"point": np.array([0.0, 0.1, 0.0])},
        {"axes": "xy"},
        {"joint": "base/shoulder"},
        {"goals": (Goal(translation=np.ones(3)),)},
    ],
    ids=str,
)
def test_anything_else_reaches_wherever_the_constraint_is_active(fields: dict[str, object]) -> None:
    assert reached([WRIST, ELBOW], [WRIST, replace(ELBOW, **fields)]) == (24, 37)


def test_what_comes_or_goes_reaches_where_it_is_active() -> None:
    assert reached([WRIST], [WRIST, ELBOW]) == (24, 37)
    assert reached([WRIST, ELBOW], [WRIST]) == (24, 37)
    assert reached([WRIST], [WRIST, replace(ELBOW, weight=0.0)]) == NOTHING


def test_a_goal_in_another_joint_reaches_everywhere() -> None:
    assert reached([WRIST], [with_goal(joint=(ARM, "base"))]) == (0, COUNT)


def test_a_rank_reaches_where_both_are_active_that_change_places() -> None:
    assert reached([WRIST, ELBOW], [WRIST, replace(ELBOW, priority=7)]) == NOTHING
    assert reached([WRIST, ELBOW], [WRIST, replace(ELBOW, priority=1)]) == (24, 37)
    assert reached([WRIST, ELBOW], [replace(WRIST, priority=3), ELBOW]) == (24, 37)


def test_a_trajectory_reaches_where_its_curve_is_another_one() -> None:
    curve = TrajectoryConstraint(
        path="/Arm/Edit/curve",
        skeleton=ARM,
        joint="base/shoulder/elbow/wrist",
        times=(0.5, 1.5),
        keys=(0.8, 1.0, 1.2),
        points=np.array([[0.5, 1.5, 0.1], [0.4, 1.6, 0.2], [0.5, 1.4, 0.2]]),
    )
    points = np.array(curve.points)
    points[2] += 0.1
    # The tangent at the second point depends on the third, but not that at the first.
    assert reached([curve], [replace(curve, points=points)]) == (20, 36)


def test_what_cannot_be_is_refused_though_it_is_never_active() -> None:
    with pytest.raises(SceneError, match="names the joint 'tail'"):
        reached([WRIST], [WRIST, replace(ELBOW, joint="tail", times=(8.0, 9.0))])


def test_levels_are_told_by_who_is_on_them() -> None:
    def scene(*constraints: Constraint) -> Scene:
        return arm_scene(constraints)

    assert same_levels(scene(WRIST, ELBOW), scene(WRIST, replace(ELBOW, priority=9)))
    assert not same_levels(scene(WRIST, ELBOW), scene(WRIST, replace(ELBOW, priority=1)))
    assert not same_levels(scene(WRIST, ELBOW), scene(WRIST))


def test_a_hull_leaves_out_what_is_empty() -> None:
    assert hull([slice(5, 5), slice(7, 9), slice(2, 3)]) == slice(2, 9)
    assert hull([slice(4, 4)]) == slice(0, 0)

"""The table of tasks: what constraints become for a solver."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import (
    AimConstraint,
    Constraint,
    DistanceConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    Region,
    RegionConstraint,
)
from usdmotion.kernels import Kind, Shape
from usdmotion.solving import Problem
from usdmotion.tasks import levels
from usdmotion.testing import ARM, arm_scene

WRIST = PositionConstraint(
    path="/Arm/Edit/wrist", skeleton=ARM, joint="base/shoulder/elbow/wrist", priority=10
)
ELBOW = OrientationConstraint(
    path="/Arm/Edit/elbow", skeleton=ARM, joint="base/shoulder/elbow", priority=2
)


def table_of(*constraints: Constraint):  # type: ignore[no-untyped-def]
    return Problem.of(arm_scene(constraints, frame_count=4)).table


def test_tasks_stand_in_the_order_of_their_ranks() -> None:
    table = table_of(WRIST, ELBOW, replace(WRIST, priority=2))
    assert table.level.tolist() == [0, 0, 1]
    assert table.constraint.tolist() == [1, 2, 0]
    assert table.kind.tolist() == [Kind.ROTATION, Kind.POINT, Kind.POINT]
    assert list(levels(table)) == [0, 1]


def test_only_the_order_of_priorities_counts() -> None:
    near = table_of(replace(WRIST, priority=2), replace(ELBOW, priority=1))
    far = table_of(replace(WRIST, priority=900), replace(ELBOW, priority=-3))
    for name, column in near._asdict().items():
        np.testing.assert_array_equal(column, getattr(far, name), err_msg=name)


def test_no_constraints_make_an_empty_table_of_the_right_shapes() -> None:
    table = table_of()
    assert table.kind.shape == (0,)
    assert table.weight.shape == (4, 0)
    assert table.recruits.shape == (0, 5)
    assert table.term_point.shape == (4, 0, 3)
    assert table.first_term.tolist() == table.first_goal.tolist() == [0]
    assert list(levels(table)) == []


def test_terms_and_goals_belong_to_their_task() -> None:
    riding = Goal(joint=(ARM, "base"))
    table = table_of(replace(WRIST, goals=(riding, riding)), replace(ELBOW, goals=(riding,)))
    assert table.first_term.tolist() == [0, 1, 4]
    assert table.first_goal.tolist() == [0, 1, 1]
    assert table.term_node.tolist() == [3, 4, 1, 1]


@pytest.mark.parametrize(("weight", "wanted"), [(2.5, 2.5), (-1.0, 0.0)])
def test_weights_reach_the_table_and_are_never_negative(weight: float, wanted: float) -> None:
    assert table_of(replace(WRIST, weight=weight)).weight.tolist() == [[wanted]] * 4


def test_activity_is_its_own_times_the_easing_of_the_key_times() -> None:
    half = replace(WRIST, activity=0.5, times=(1 / 24, 2 / 24))
    assert table_of(half).activity[:, 0].tolist() == [0.0, 0.5, 0.5, 0.0]


def test_recruits_are_the_named_joints_or_else_the_chain_to_the_root() -> None:
    assert table_of(WRIST).recruits.tolist() == [[False, True, True, True, True]]
    named = replace(WRIST, recruits=("base/shoulder",))
    assert table_of(named).recruits.tolist() == [[False, False, True, False, False]]


def test_bounds_and_shapes_stand_beside_their_tasks() -> None:
    region = Region(shape=Shape.CYLINDER, extent=np.array([0.1, 0.1, 0.4]))
    table = table_of(
        DistanceConstraint(
            path="/Far",
            skeleton=ARM,
            joint=WRIST.joint,
            other_joint="base",
            bound="atLeast",
            distance=np.array([0.1, 0.2, 0.3, 0.4]),
        ),
        RegionConstraint(path="/In", skeleton=ARM, joint=WRIST.joint, region=region, side="inside"),
        AimConstraint(path="/Aim", skeleton=ARM, joint=WRIST.joint, goals=(Goal(),)),
    )
    assert table.kind.tolist() == [Kind.DISTANCE] * 3 + [Kind.AIM]
    assert table.bound.tolist() == [1, -1, -1, 0]
    assert table.distance[:, 0].tolist() == [0.1, 0.2, 0.3, 0.4]
    assert table.shape.tolist() == [Shape.BOX, Shape.CYLINDER, Shape.BOX, Shape.BOX]
    assert table.extent[0].tolist() == [
        [0.0] * 3, [0.1, 0.1, np.inf], [np.inf, np.inf, 0.4], [0.0] * 3
    ]  # fmt: skip
    assert table.free_axis[3].tolist() == [0.0, 0.0, 1.0]


def test_a_table_above_another_asks_for_both_in_this_order() -> None:
    upper, lower = (Problem.of(arm_scene([each])).table for each in (WRIST, ELBOW))
    joined = upper.above(lower)
    other = Problem.of(arm_scene([WRIST, replace(ELBOW, priority=11)])).table
    for name, column, wanted in zip(joined._fields, joined, other, strict=True):
        assert np.array_equal(column, wanted), name

"""What all kinds of constraint share."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint, attributes, built_in
from usdmotion.errors import SceneError
from usdmotion.testing import ARM, arm_scene

CAST = arm_scene(frame_count=5).cast
SECOND = 1 / 24
WRIST = PositionConstraint(path="/Arm/Edit/wrist", skeleton=ARM, joint="base/shoulder/elbow/wrist")


def test_every_kind_of_this_package_is_found_by_its_schema() -> None:
    schemas = [kind.schema for kind in built_in()]
    assert schemas == sorted(schemas)
    assert {"MotionPositionConstraint", "MotionOrientationConstraint"} <= set(schemas)


def test_attributes_are_named_as_the_schema_names_them() -> None:
    names = {each.field: each.name for each in attributes(PositionConstraint)}
    assert names["priority"] == "usdmotion:priority"
    assert names["axes"] == "usdmotion:axes"
    assert "path" not in names
    orientation = next(kind for kind in built_in() if "Orientation" in kind.schema)
    assert "usdmotion:freeAxis" in {each.name for each in attributes(orientation)}


def test_units_and_animation_travel_with_the_attribute() -> None:
    found = {each.field: each for each in attributes(PositionConstraint)}
    assert found["point"].unit == "length"
    assert found["times"].unit == "time"
    assert found["activity"].animated
    assert not found["priority"].animated


@pytest.mark.parametrize(
    ("changes", "plateau"),
    [
        ({}, [1, 1, 1, 1, 1]),
        ({"times": (SECOND, 3 * SECOND)}, [0, 1, 1, 1, 0]),
        ({"activity": 0.5}, [0, 0, 0, 0, 0]),
        ({"goals": (Goal(times=(0.0, SECOND)),)}, [1, 1, 0, 0, 0]),
        ({"goals": (Goal(times=(0.0, SECOND)),), "times": (SECOND, 1.0)}, [0, 1, 0, 0, 0]),
        ({"goals": (Goal(activity=0.4),), "times": (SECOND, 1.0)}, [0, 1, 1, 1, 1]),
        ({"goals": (Goal(times=(0, 0)), Goal(times=(SECOND, SECOND)))}, [1, 1, 0, 0, 0]),
    ],
)
def test_it_is_judged_where_it_and_one_of_its_goals_are_fully_on(
    changes: dict[str, object], plateau: list[int]
) -> None:
    constraint = replace(WRIST, **changes)
    assert constraint.demand(CAST).plateau.astype(int).tolist() == plateau


def test_what_moves_it_is_its_chain_and_the_joints_above_its_goals() -> None:
    riding = replace(WRIST, joint="base/shoulder", goals=(Goal(joint=(ARM, "base")),))
    assert WRIST.demand(CAST).moves == {1, 2, 3, 4}
    assert riding.demand(CAST).moves == {1, 2}


@pytest.mark.parametrize(
    "changes",
    [{"joint": "paw"}, {"recruits": ("paw",)}, {"goals": (Goal(joint=(ARM, "paw")),)}],
)
def test_a_joint_that_is_not_there_is_refused_by_the_name_of_who_asks(
    changes: dict[str, object],
) -> None:
    with pytest.raises(SceneError, match="</Arm/Edit/wrist> names the joint 'paw'"):
        replace(WRIST, **changes).demand(CAST)


def test_activities_beyond_their_range_are_held_in_it() -> None:
    loud = replace(WRIST, activity=np.array([-1.0, 0.0, 0.5, 1.0, 2.0]))
    assert loud.demand(CAST).activity.tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]

"""Constraints and goals with other values: what cannot be is refused in a sentence."""

import numpy as np
import pytest

from usdmotion.constraints import (
    Constraint,
    Goal,
    PositionConstraint,
    TrajectoryConstraint,
    altered,
    built_in,
    sound,
)
from usdmotion.errors import SceneError

GOAL = Goal(path="/Edit/wrist/goal", times=(0.1, 0.2))
WRIST = PositionConstraint(path="/Edit/wrist", skeleton="/Arm", joint="wrist", goals=(GOAL,))
FRAMES = 7


def test_values_become_what_their_kind_has() -> None:
    goal = altered(
        GOAL, FRAMES, translation=[1, 2, 3], rotation=(0, 0, 2, 0), times=[1, 2, 3, 4], activity=1
    )
    assert goal.translation.dtype == np.float64
    assert goal.rotation.tolist() == [0.0, 0.0, 1.0, 0.0]
    assert goal.times == (1.0, 2.0, 3.0, 4.0)
    assert goal.activity == 1.0 and isinstance(goal.activity, float)
    assert goal.path == GOAL.path


def test_what_is_said_frame_by_frame_has_a_value_for_each() -> None:
    course = np.arange(21.0).reshape(7, 3)
    assert np.array_equal(altered(GOAL, FRAMES, translation=course).translation, course)
    assert np.array_equal(altered(WRIST, FRAMES, activity=np.ones(7)).activity, np.ones(7))


def test_an_array_that_is_written_to_later_is_none_of_ours() -> None:
    place = np.zeros(3)
    goal = altered(GOAL, FRAMES, translation=place)
    place += 1.0
    assert not goal.translation.any()


def test_a_list_of_points_may_be_of_any_length() -> None:
    curve = TrajectoryConstraint(path="/Edit/curve", skeleton="/Arm")
    assert altered(curve, FRAMES, points=np.zeros((4, 3))).points.shape == (4, 3)
    with pytest.raises(SceneError, match="as its points; give nx3 numbers"):
        altered(curve, FRAMES, points=np.zeros((4, 2)))


@pytest.mark.parametrize(
    ("fields", "wanted"),
    [
        ({"translation": [1.0, 2.0]}, "3 numbers, or 3 numbers for each of the 7 frames"),
        ({"translation": np.zeros((6, 3))}, "3 numbers, or 3 numbers for each of the 7 frames"),
        ({"translation": [1.0, np.nan, 0.0]}, "3 numbers"),
        ({"translation": "there"}, "3 numbers"),
        ({"translation": None}, "3 numbers"),
        ({"rotation": np.zeros(4)}, "4 numbers"),
        ({"activity": np.ones(6)}, "a number, or a number for each of the 7 frames"),
        ({"activity": np.inf}, "a number"),
        ({"times": (1.0, 2.0, 3.0)}, "none, two, or t0 t1 t2 t3, the earliest first"),
        ({"times": (2.0, 1.0)}, "none, two, or t0 t1 t2 t3, the earliest first"),
        ({"times": 1.0}, "none, two, or t0 t1 t2 t3"),
        ({"mode": "near"}, "position or offset"),
    ],
    ids=str,
)
def test_a_goal_cannot_have_just_anything(fields: dict[str, object], wanted: str) -> None:
    (name,) = fields
    with pytest.raises(SceneError, match=f"</Edit/wrist/goal> cannot have .* as its {name}; give"):
        altered(GOAL, FRAMES, **fields)
    with pytest.raises(SceneError, match=wanted):
        altered(GOAL, FRAMES, **fields)


@pytest.mark.parametrize(
    ("fields", "wanted"),
    [
        ({"priority": 1.5}, "a whole number"),
        ({"priority": "first"}, "a whole number"),
        ({"tolerance": np.nan}, "a number"),
        ({"joint": 3}, "text"),
        ({"recruits": 3}, "a list"),
        ({"goals": [GOAL, 3]}, "a list of goals"),
        ({"goals": GOAL}, "a list of goals"),
    ],
    ids=str,
)
def test_a_constraint_cannot_have_just_anything(fields: dict[str, object], wanted: str) -> None:
    with pytest.raises(SceneError, match=f"</Edit/wrist> cannot have .* give {wanted}"):
        altered(WRIST, FRAMES, **fields)


def test_a_field_that_is_not_there_is_answered_with_those_that_are() -> None:
    with pytest.raises(SceneError, match=r"has no 'colour' .* it has path, skeleton"):
        altered(WRIST, FRAMES, colour="red")


@pytest.mark.parametrize("kind", built_in(), ids=lambda kind: kind.schema)
def test_a_constraint_of_any_kind_is_sound_as_it_is_by_default(kind: type[Constraint]) -> None:
    constraint = kind(path="/Edit/each", skeleton="/Arm", goals=(Goal(),))
    again = sound(constraint, FRAMES)
    for name, value in vars(constraint).items():
        if name != "goals":
            assert np.array_equal(getattr(again, name), value), name


def test_goals_are_looked_at_with_their_constraint() -> None:
    with pytest.raises(SceneError, match="</Edit/wrist/goal> cannot have"):
        sound(altered(WRIST, FRAMES, goals=(Goal(path=GOAL.path, mode="near"),)), FRAMES)

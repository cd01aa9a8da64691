"""A constraint on some of its frames asks for what it asks for there."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.cast import Cast
from usdmotion.constraints import (
    Constraint,
    Goal,
    Region,
    Space,
    TrajectoryConstraint,
    built_in,
    during,
)
from usdmotion.kernels import TaskTable, from_vector
from usdmotion.tasks import tabulate
from usdmotion.testing import ARM, arm_scene

SCENE = arm_scene(frame_count=30)
CAST = SCENE.cast
FRAMES = slice(9, 17)
RANDOM = np.random.default_rng(5)
NEEDED = {
    "MotionTrajectoryConstraint": {
        "times": (0.21, 0.91),
        "keys": (0.4, 0.7),
        "points": np.array([[0.5, 1.5, 0.1], [0.4, 1.6, 0.2]]),
    },
    "MotionCenterOfMassConstraint": {
        "supports": ("base", "base/shoulder", "base/shoulder/elbow"),
        "displacement": RANDOM.normal(size=(30, 3)),
    },
    "MotionDistanceConstraint": {
        "other_joint": "base",
        "other_point": RANDOM.normal(size=(30, 3)),
        "distance": np.maximum(np.linspace(-0.3, 0.4, 30), 0.0),
    },
    "MotionRegionConstraint": {
        "region": Region(
            extent=RANDOM.uniform(0.1, 0.5, size=(30, 3)),
            margin=np.linspace(0.1, 0.2, 30),
            translation=RANDOM.normal(size=(30, 3)),
            rotation=from_vector(RANDOM.normal(size=(30, 3))),
        )
    },
}
"""What a kind does not go without, and what it has for each frame."""


def kinds() -> list[type[Constraint]]:
    return list(built_in())


def of_kind(kind: type[Constraint]) -> Constraint:
    """Return a constraint in which everything changes over time that may."""
    walking = Goal(
        translation=RANDOM.normal(size=(30, 3)),
        rotation=from_vector(RANDOM.normal(size=(30, 3))),
        activity=np.linspace(0.1, 1.0, 30),
        times=(0.1, 0.3, 0.6, 0.9),
    )
    constraint = kind(
        path="/Arm/Edit/each",
        skeleton=ARM,
        joint="base/shoulder/elbow/wrist",
        point=RANDOM.normal(size=(30, 3)),
        weight=np.linspace(1.0, 2.0, 30),
        activity=np.linspace(0.5, 1.0, 30),
        goals=(walking, Goal()),
        **NEEDED.get(kind.schema, {}),
    )
    if hasattr(constraint, "space"):
        moving = Space(RANDOM.normal(size=(30, 3)), from_vector(RANDOM.normal(size=(30, 3))))
        constraint = replace(constraint, space=moving)
    return constraint


def table(constraint: Constraint, cast: Cast) -> TaskTable:
    return tabulate([constraint.demand(cast)], cast.frame_count, cast.node_count)


@pytest.mark.parametrize("kind", kinds(), ids=lambda kind: kind.schema)
@pytest.mark.parametrize("frames", [FRAMES, slice(0, 4), slice(25, 30), slice(12, 13)], ids=str)
def test_part_of_what_a_kind_asks_is_what_it_asks_of_a_part(
    kind: type[Constraint], frames: slice
) -> None:
    constraint = of_kind(kind)
    seen = constraint.needs(CAST.times, frames)
    found = table(during(constraint, seen), CAST.during(seen))
    inner = found.during(slice(frames.start - seen.start, frames.stop - seen.start))
    wanted = table(constraint, CAST).during(frames)
    on = wanted.activity > 0.0
    for name, column in inner._asdict().items():
        other = getattr(wanted, name)
        if name in ("target", "original", "blend"):
            column, other = column[on], other[on]
        np.testing.assert_array_equal(column, other, err_msg=name)


@pytest.mark.parametrize("kind", kinds(), ids=lambda kind: kind.schema)
def test_outside_its_span_nothing_is_asked(kind: type[Constraint]) -> None:
    constraint = replace(of_kind(kind), times=(0.21, 0.91))
    if "keys" not in vars(constraint):
        constraint = replace(constraint, times=(0.21, 0.3, 0.5, 0.91))
    span = constraint.span(CAST.times)
    activity = constraint.demand(CAST).activity
    assert (span.start, span.stop) == (6, 22)
    assert not activity[: span.start].any() and not activity[span.stop :].any()
    assert activity[span.start + 1 : span.stop - 1].all()


def test_what_is_the_same_throughout_is_the_same_object() -> None:
    constraint = replace(of_kind(TrajectoryConstraint), weight=1.0, activity=1.0, point=np.zeros(3))
    still = replace(constraint, goals=(Goal(),), space=Space())
    assert during(still, FRAMES) is still


def test_as_many_frames_as_a_point_has_axes_are_told_from_a_point() -> None:
    point, course = np.arange(3.0), np.arange(9.0).reshape(3, 3)
    assert during(Goal(translation=point), slice(1, 3)).translation is point
    assert np.array_equal(during(Goal(translation=course), slice(1, 3)).translation, course[1:])

"""A scene on some of its frames."""

from dataclasses import replace

import numpy as np

from usdmotion import PositionConstraint, Scene
from usdmotion.solving import Problem
from usdmotion.testing import ARM, arm_scene

WRIST = PositionConstraint(
    path="/Arm/Edit/wrist", skeleton=ARM, joint="base/shoulder/elbow/wrist", times=(0.0, 0.5)
)


def paths(scene: Scene) -> list[str]:
    return [each.path for each in scene.constraints]


def test_a_part_of_a_scene_has_the_motion_and_the_times_of_these_frames() -> None:
    scene, frames = arm_scene([WRIST], frame_count=24), slice(5, 9)
    part = scene.during(frames)
    assert np.array_equal(part.cast.positions, scene.cast.positions[frames])
    assert np.array_equal(part.time_codes, scene.time_codes[frames])
    assert np.array_equal(part.times, scene.times[frames])


def test_what_asks_for_nothing_in_a_part_is_not_in_it() -> None:
    later = replace(WRIST, path="/later", times=(0.6, 0.9))
    throughout = replace(WRIST, path="/throughout", times=())
    scene = arm_scene([WRIST, later, throughout], frame_count=24)
    assert paths(scene.during(slice(0, 5))) == [WRIST.path, "/throughout"]
    assert paths(scene.during(slice(15, 20))) == ["/later", "/throughout"]


def test_a_part_has_the_levels_of_the_whole() -> None:
    ranks = [replace(WRIST, path=f"/{rank}", priority=rank) for rank in (1, 2, 3)]
    middle = replace(WRIST, path="/middle", priority=2, times=(0.6, 0.9))
    part = arm_scene([*ranks, middle], frame_count=24).during(slice(15, 20))
    assert paths(part) == ["/1", "/3", "/middle"]
    assert Problem.of(part).table.level.tolist() == [0, 1, 2]

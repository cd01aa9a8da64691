"""2003, figure 1: the elbow is where it is asked to be, the forearm points where it cannot go."""

import numpy as np
import pytest

from usdmotion.demos import elbow_and_wrist
from usdmotion.demos.walker import SKELETON


@pytest.fixture
def solved(demo, solve):
    return solve(demo("elbow_and_wrist"), SKELETON)


@pytest.fixture
def there(solved):
    _, start, end, _ = elbow_and_wrist.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    assert there.sum() == end - start + 1
    return there


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def test_the_elbow_is_at_its_goal_on_the_plateau(solved, there):
    moved = solved.after.point("LeftForeArm") - solved.before.point("LeftForeArm")
    assert solved.millimetres((moved - elbow_and_wrist.ELBOW)[there]) <= 0.01


def test_the_forearm_points_at_the_goal_that_it_cannot_reach(solved, there):
    elbow, wrist = solved.after.point("LeftForeArm"), solved.after.point("LeftHand")
    goal = solved.before.point("LeftHand") + elbow_and_wrist.WRIST
    assert np.linalg.norm((wrist - goal)[there], axis=1).min() >= 0.1
    along = np.sum(unit(wrist - elbow) * unit(goal - elbow), axis=1)[there]
    assert np.degrees(np.arccos(np.clip(along, -1.0, 1.0))).max() <= 0.1


def test_no_joint_jumps(solved):
    for name in elbow_and_wrist.RECRUITED:
        after, before = solved.after.speed(name), solved.before.speed(name)
        assert after.max() <= before.max() + 5.0
        assert np.abs(np.diff(after)).max() <= 2.0


def test_only_the_arm_moves(solved):
    for index, token in enumerate(solved.before.joints):
        if token.rsplit("/", 1)[-1] not in elbow_and_wrist.RECRUITED:
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])


def test_outside_its_times_it_is_the_walk(solved):
    first, _, _, last = elbow_and_wrist.FRAMES
    away = (solved.after.times <= first) | (solved.after.times >= last + 8)
    apart = solved.after.world[away, :, 3, :3] - solved.before.world[away, :, 3, :3]
    assert solved.millimetres(apart) <= 0.1

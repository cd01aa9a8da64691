"""Solving some frames again is as good as solving them all."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from usdmotion import Constraint, Goal, PositionConstraint, Problem, Scene, Solution
from usdmotion.changes import changed
from usdmotion.constraints import TrajectoryConstraint
from usdmotion.plugins import host
from usdmotion.resuming import MET, Kept, met, pose, solve_again
from usdmotion.solving import resumes
from usdmotion.testing import HUMANOID, humanoid_scene

COUNT = 96
WRIST = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"
SOLVER = host().solver("prioritized_ik")()


def hold(name: str, token: str, priority: int, **fields: object) -> Constraint:
    kind = fields.pop("kind", PositionConstraint)
    return kind(path=f"/{name}", skeleton=HUMANOID, joint=token, priority=priority, **fields)


def reaching(x: float) -> Scene:
    """Return feet that stay, a wrist with a goal on frames 25 to 47, and a head to keep below."""
    goal = Goal(mode="offset", translation=np.array([x, 0.1, 0.2]), times=(1.0, 1.4, 1.6, 2.0))
    feet = [
        hold(side, f"pelvis/{side}_hip/{side}_knee/{side}_ankle", 1) for side in ("left", "right")
    ]
    curve = hold(
        "curve",
        "pelvis/spine/chest/right_shoulder/right_elbow",
        4,
        kind=TrajectoryConstraint,
        times=(0.5, 3.0),
        keys=(1.5,),
        points=np.array([[-0.4, 1.3, 0.2]]),
    )
    hand, head = hold("hand", WRIST, 2, goals=(goal,)), hold("head", "pelvis/spine/chest/head", 3)
    return humanoid_scene([*feet, hand, head, curve], frame_count=COUNT)


@pytest.mark.parametrize("frames", [slice(0, 6), slice(10, 11), slice(30, 60), slice(90, 96)])
def test_the_problem_of_some_frames_is_that_part_of_the_whole(frames: slice) -> None:
    scene = reaching(0.1)
    part, whole = pose(scene, frames), Problem.of(scene).during(frames)
    assert np.array_equal(part.cast.rotations, whole.cast.rotations)
    on = whole.table.activity > 0.0
    assert np.array_equal(part.table.activity, whole.table.activity)
    assert np.array_equal(part.table.target[on], whole.table.target[on])


@pytest.mark.parametrize("x", [0.1, 2.0], ids=["within reach", "out of reach"])
@pytest.mark.parametrize("new", [0.15, 1.5])
def test_what_is_solved_again_is_what_a_whole_solve_finds(x: float, new: float) -> None:
    before, after = reaching(x), reaching(new)
    kept = Kept.of(SOLVER.solve(Problem.of(before)))
    frames = changed(before, after)
    found = solve_again(SOLVER, partial(pose, after), kept, frames)
    whole = SOLVER.solve(Problem.of(after))
    solved = slice(frames.start, frames.start + sum(len(each.stops) for each in found))
    assert solved.stop < COUNT, "the solutions have to meet"
    for name in ("translations", "rotations", "iterations", "stops", "carried"):
        again = np.concatenate([getattr(each, name) for each in found])
        assert np.array_equal(again, getattr(whole, name)[solved]), name
    behind = slice(solved.stop, None)
    apart = np.abs(kept.during(behind).rotations - whole.rotations[behind])
    assert apart.max() <= 10.0 * MET
    assert np.array_equal(kept.rotations[: frames.start], whole.rotations[: frames.start])


def test_what_is_asked_at_the_ends_of_a_clip_is_solved_too() -> None:
    scene = reaching(0.1)
    whole = SOLVER.solve(Problem.of(scene))
    nothing = Kept.of(replace(whole, rotations=np.roll(whole.rotations, 1, axis=0)))
    (found,) = solve_again(SOLVER, partial(pose, scene), nothing, slice(0, COUNT))
    assert np.array_equal(found.rotations, whole.rotations)


def of_one_frame(**arrays: np.ndarray) -> Solution:
    zeros = np.zeros(1, dtype=np.int64)
    plain = {"translations": np.zeros((1, 2, 3)), "rotations": np.ones((1, 2, 4)) / 2.0}
    return Solution(**plain | {"iterations": zeros, "stops": zeros} | arrays)  # type: ignore[arg-type]


def test_two_solutions_have_met_where_poses_and_what_is_handed_on_are_the_same() -> None:
    one = of_one_frame(carried=np.ones((1, 1, 2)))
    assert met(one, one)
    assert met(one, of_one_frame(rotations=-one.rotations, carried=one.carried))
    assert not met(one, of_one_frame(rotations=one.rotations + 2 * MET, carried=one.carried))
    assert not met(one, of_one_frame(translations=one.translations + 2 * MET))
    assert not met(one, of_one_frame(carried=np.ones((1, 1, 2)) + 2 * MET))


def test_what_is_not_known_of_a_frame_does_not_keep_solutions_apart() -> None:
    one = of_one_frame(carried=np.ones((1, 1, 2)))
    assert met(one, of_one_frame(carried=np.zeros((1, 1, 2))))
    assert met(one, of_one_frame(carried=np.ones((1, 2, 2))))
    assert met(one, of_one_frame())


def test_a_solver_says_itself_whether_it_resumes() -> None:
    assert resumes(SOLVER)
    assert not resumes(object())  # type: ignore[arg-type]

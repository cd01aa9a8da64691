"""What is written for others says what our table says, and their answers are measured by us."""

import numpy as np
from comparison.exchange import Answer, answered, errors, given, turned
from comparison.rounds import Task
from reaching import WITHIN_REACH

from usdmotion.kernels import multiply
from usdmotion.plugins import host


def test_the_clip_has_the_targets_and_the_ranks_of_our_table(task: Task) -> None:
    with np.load(task.folder / "clip.npz") as clip:
        assert np.array_equal(clip["targets"], task.problem.table.target)
        assert clip["levels"].tolist() == [0, 0, 0, 0, 1, 2]
        assert clip["names"].tolist()[-1] == "com"


def test_the_input_misses_the_wrist_by_its_offset_and_nothing_else(task: Task) -> None:
    left = errors(task.problem, given(task.problem)).max(axis=0)
    assert np.allclose(left[[0, 1, 2, 3, 5]], 0.0, atol=1e-12)
    assert np.isclose(left[4], np.linalg.norm(WITHIN_REACH))
    assert turned(task.problem, given(task.problem)).max() == 0.0


def test_our_own_answer_comes_through_unchanged(task: Task) -> None:
    solution = host().solver("prioritized_ik")().solve(task.problem)
    answer = answered(task.problem, solution.translations, solution.rotations)
    assert errors(task.problem, answer).max() < 1e-5


def test_turns_are_told_in_degrees(task: Task) -> None:
    before = given(task.problem)
    turns = np.array(before.turns)
    turns[:, 3] = multiply(turns[:, 3], np.array((np.sin(0.1), 0.0, 0.0, np.cos(0.1))))
    away = turned(task.problem, Answer(before.root, turns))
    assert np.allclose(away[:, 3], np.degrees(0.2))
    assert np.allclose(np.delete(away, 3, axis=1), 0.0)

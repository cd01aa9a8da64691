"""The loop that every library runs in."""

from dataclasses import replace

import numpy as np
import pytest
from comparison.runners.contest import Clip, Rules, nearer, solve

RULES = Rules(tolerance=1e-3, still=1e-3, limit=60, reach=0.1, turn=0.3, look_first=False)


class Halving:
    """One point that each step brings half the way to where it is aimed."""

    def __init__(self, clip: Clip, turn: float = 1.0) -> None:
        self.clip, self.turn = clip, turn
        self.place = np.zeros((1, 3))
        self.aims: list[np.ndarray] = []

    def start(self, frame: int) -> float:
        return 0.0

    def aim(self, targets: np.ndarray) -> None:
        self.aims.append(targets)

    def step(self, turn: float) -> float:
        self.place = 0.5 * (self.place + self.aims[-1])
        return self.turn

    def places(self) -> np.ndarray:
        return self.place

    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        return self.place[0], np.array([[0.0, 0.0, 0.0, 1.0]])


def clip(*targets: float) -> Clip:
    """Return a clip whose only point is to be so far along x."""
    along = np.zeros((len(targets), 1, 3))
    along[:, 0, 0] = targets
    turns = np.tile((0.0, 0.0, 0.0, 1.0), (len(targets), 1, 1))
    return Clip(along[:, 0], turns, ["point"], along, [0])


def test_a_frame_is_left_when_every_task_is_within_tolerance() -> None:
    asked = clip(0.06)
    answer = solve(asked, Halving(asked), RULES)
    assert answer["steps"] == [6]
    assert 0.0 < answer["stepping"] < answer["seconds"]


def test_a_frame_is_left_when_nothing_moves_or_at_the_limit() -> None:
    asked = clip(0.06)
    assert solve(asked, Halving(asked, turn=1e-4), RULES)["steps"] == [1]
    assert solve(asked, Halving(asked), replace(RULES, limit=2))["steps"] == [2]


def test_what_obeys_needs_a_step_unless_one_may_look_first() -> None:
    asked = clip(0.0, 0.0)
    assert solve(asked, Halving(asked), RULES)["steps"] == [1, 1]
    assert solve(asked, Halving(asked), replace(RULES, look_first=True))["steps"] == [0, 0]
    moved = clip(0.06)
    assert solve(moved, Halving(moved), replace(RULES, look_first=True))["steps"] == [6]


def test_a_far_target_is_approached_in_steps() -> None:
    asked = clip(1.0)
    halving = Halving(asked)
    solve(asked, halving, RULES)
    aims = [aim[0, 0] for aim in halving.aims]
    assert aims == pytest.approx([1.0, *np.arange(0.6, 0.99, 0.05), 1.0])
    assert halving.place[0, 0] == pytest.approx(1.0, abs=1e-3)


def test_shortened_ways_keep_their_directions() -> None:
    ways = np.array([[3.0, 0.0, 4.0], [0.0, 0.01, 0.0]])
    assert np.allclose(nearer(ways, 0.5), [[0.3, 0.0, 0.4], [0.0, 0.01, 0.0]])

"""A walk, what it asks, and a runner that has no library."""

from pathlib import Path

import compare
import pytest
from comparison.exchange import export
from comparison.rounds import RUNNERS, Task
from reaching import character, reaching

from usdmotion.demos.gait import Walk, walk

RULES = compare.RULES | {"limit": 3}
KEEP = f"""
import sys
sys.path.insert(0, {str(RUNNERS)!r})
from contest import serve


class Keep:
    def __init__(self, path, clip, settings):
        self.clip, self.turn = clip, settings["turn"]

    def start(self, frame):
        self.frame = frame
        return 0.0

    def aim(self, targets):
        self.targets = targets

    def step(self, turn):
        return self.turn

    def places(self):
        return self.clip.targets[self.frame] + 1.0

    def pose(self):
        return self.clip.root[self.frame], self.clip.turns[self.frame]


serve(Keep, "numpy")
"""


@pytest.fixture(scope="session")
def walking() -> Walk:
    return walk(1.0)


@pytest.fixture
def task(walking: Walk, tmp_path: Path) -> Task:
    """Return the clip within reach, written for runners."""
    problem = reaching(walking)
    export(problem, character(walking), compare.NAMES, tmp_path / "clip")
    return Task("Within reach", problem, tmp_path / "clip", RULES, "within_reach")


@pytest.fixture
def keep(tmp_path: Path) -> Path:
    """Return a runner that gives the input back."""
    script = tmp_path / "keep.py"
    script.write_text(KEEP, encoding="utf-8")
    return script

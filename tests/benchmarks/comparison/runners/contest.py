"""The loop that every library runs in: frames in order, steps until the tasks are met.

Runs in the environment of the library, with nothing but NumPy beside it.
"""

import json
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from time import perf_counter
from typing import Any, Protocol

import numpy as np

COM = "com"
"""Name of the target of the centre of mass."""


@dataclass(frozen=True)
class Rules:
    """When a frame is left, and how far a step may go."""

    tolerance: float
    """Every task is nearer than this [m] …"""
    still: float
    """… or a step turned no joint by more than this [rad] …"""
    limit: int
    """… or so many steps were made."""
    reach: float
    """A target farther than this is approached in steps [m]."""
    turn: float
    """No joint turns by more in one step [rad]."""
    look_first: bool
    """Whether a frame that obeys from the start, in its input posture, needs no step."""


@dataclass(frozen=True, eq=False)
class Clip:
    """What is asked, as `exchange.export` wrote it."""

    root: np.ndarray
    turns: np.ndarray
    names: list[str]
    targets: np.ndarray
    levels: list[int]

    @classmethod
    def load(cls, path: Path) -> "Clip":
        """Read a clip."""
        with np.load(path) as file:
            arrays = {name: file[name] for name in file.files}
        lists = {name: arrays[name].tolist() for name in ("names", "levels")}
        return cls(**(arrays | lists))

    @property
    def joints(self) -> list[str]:
        """Return the names of the model's joints, in the order of the turns."""
        return ["root_joint", *(f"joint{joint}" for joint in range(1, self.turns.shape[1]))]


class Contestant(Protocol):
    """One library with the tasks and settings that it was given."""

    def start(self, frame: int) -> float:
        """Take the input posture, with the displacement of the frame before.

        Returns:
            The largest turn of that displacement [rad].
        """

    def aim(self, targets: np.ndarray) -> None:
        """Set where each task is asked for [m], (T, 3)."""

    def step(self, turn: float) -> float:
        """Make one iteration with so large a turn at most; return the largest asked for [rad]."""

    def places(self) -> np.ndarray:
        """Return where each task's point is [m], (T, 3)."""

    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the root's position (3,) and every joint's turn, xyzw, (J, 4)."""


def solve(clip: Clip, contestant: Contestant, rules: Rules) -> dict[str, Any]:
    """Solve a clip; return what it took and what came out.

    The clock runs from the first frame's posture to the last frame's pose.
    """
    poses, steps, stepping, far = [], [], 0.0, 0.0
    start = perf_counter()
    for frame, targets in enumerate(clip.targets):
        turn = contestant.start(frame)
        contestant.aim(targets)
        obeys = False
        if rules.look_first or far > rules.reach:
            far = approach(contestant, targets, rules.reach, far)
            obeys = rules.look_first and far <= rules.tolerance and turn <= rules.still
        spent = 0
        while not obeys and spent < rules.limit:
            before = perf_counter()
            turn = contestant.step(rules.turn)
            stepping += perf_counter() - before
            spent += 1
            far = approach(contestant, targets, rules.reach, far)
            obeys = far <= rules.tolerance or turn <= rules.still
        steps.append(spent)
        poses.append(contestant.pose())
    return {
        "seconds": perf_counter() - start,
        "stepping": stepping,
        "steps": steps,
        "root": np.array([root for root, _ in poses]),
        "turns": np.array([turns for _, turns in poses]),
    }


def approach(contestant: Contestant, targets: np.ndarray, reach: float, before: float) -> float:
    """Aim where the targets are, or on the way to those out of reach; return the farthest [m].

    Args:
        contestant: Aims at the targets already, unless some were out of reach.
        targets: (T, 3).
        reach: How far at most [m].
        before: What this returned the last time.
    """
    away = targets - contestant.places()
    far = float(np.sqrt(np.einsum("ij,ij->i", away, away).max()))
    if far > reach:
        contestant.aim(targets - away + nearer(away, reach))
    elif before > reach:
        contestant.aim(targets)
    return far


def nearer(away: np.ndarray, reach: float) -> np.ndarray:
    """(T, 3), none longer than the reach."""
    lengths = np.linalg.norm(away, axis=1)
    return away * np.minimum(1.0, reach / np.maximum(lengths, 1e-12))[:, None]


Maker = Callable[[Path, Clip, dict[str, Any]], Contestant]
"""Takes the model, the clip and the settings."""


def serve(make: Maker, *packages: str) -> None:
    """Solve what is asked for, line by line of standard input, until there is no more.

    A line has a folder with model.xml and clip.npz, rules, settings, and the file to write the
    answer to; the reply has the times.
    """
    replies = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    versions = ", ".join(f"{package} {version(package)}" for package in packages)
    print(json.dumps({"versions": versions}), file=replies, flush=True)
    for line in sys.stdin:
        asked = json.loads(line)
        folder = Path(asked["folder"])
        clip = Clip.load(folder / "clip.npz")
        contestant = make(folder / "model.xml", clip, asked["settings"])
        answer = solve(clip, contestant, Rules(**asked["rules"]))
        np.savez(asked["answer"], root=answer.pop("root"), turns=answer.pop("turns"))
        print(json.dumps(answer), file=replies, flush=True)

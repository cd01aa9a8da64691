"""What each library is given: its tasks, its weights, its QP solver, chosen for it by trial."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

Settings = Mapping[str, Any]


@dataclass(frozen=True)
class Contestant:
    """One library, used in one way; settings are those of its runner."""

    library: str
    way: str
    """How it is used, in a few words."""
    tasks: str
    """What it is given, to be printed, so that the comparison can be judged."""
    within_reach: Settings
    """Settings that met every task in the fewest and cheapest steps."""
    out_of_reach: Settings
    """Settings that kept the feet best among those that bring the wrist as near as ours, or almost.

    Found on a grid over the costs of the levels, the posture and the damping.
    """
    aim: float | None = None
    """How many times faster our clip is to be."""

    @property
    def name(self) -> str:
        """Return what the tables call it."""
        return f"{self.library}, {self.way}"


def _quadratic(costs: list[float], posture: float, damping: float, hard: int) -> Settings:
    return {
        "costs": costs,
        "posture": posture,
        "damping": damping,
        "hard": hard,
        "solver": "daqp",
    }


def _placo(costs: list[float], posture: float, damping: float, hard: int) -> Settings:
    return {"costs": costs, "posture": posture, "damping": damping, "hard": hard}


_POINTS = (
    "five points (a task of three rows of ours, cheaper than its FrameTask of six), ComTask, "
    "PostureTask to the input"
)
_HARD = f"feet as equality rows of the QP; {_POINTS}"
_PLACO = (
    "five PositionTasks, CoMTask, a RelativeOrientationTask to the input for each joint (its "
    "JointsTask knows hinges only), regularization"
)
_EQUAL = [1.0, 1.0, 1.0]

CONTESTANTS = (
    Contestant(
        "placo",
        "soft",
        _PLACO,
        _placo(_EQUAL, 1e-4, 1e-6, 0),
        _placo([1e4, 1.0, 1e-2], 1e-2, 0.1, 0),
        aim=7.0,
    ),
    Contestant(
        "placo",
        "feet hard",
        f"feet hard; {_PLACO}",
        _placo(_EQUAL, 1e-4, 1e-6, 1),
        _placo([1.0, 1.0, 1e-2], 1e-2, 0.1, 1),
    ),
    Contestant(
        "mink",
        "weighted",
        _POINTS,
        _quadratic(_EQUAL, 1e-2, 0.0, 0),
        _quadratic([100.0, 1.0, 0.01], 1e-2, 10.0, 0),
        aim=15.0,
    ),
    Contestant(
        "mink",
        "feet hard",
        _HARD,
        _quadratic(_EQUAL, 1e-2, 0.0, 1),
        _quadratic([1.0, 1.0, 0.1], 1e-1, 10.0, 1),
    ),
    Contestant(
        "pink",
        "weighted",
        _POINTS,
        _quadratic(_EQUAL, 1e-2, 0.0, 0),
        _quadratic([100.0, 1.0, 0.01], 1e-2, 10.0, 0),
        aim=20.0,
    ),
    Contestant(
        "pink",
        "feet hard",
        _HARD,
        _quadratic(_EQUAL, 1e-2, 0.0, 1),
        _quadratic([1.0, 1.0, 0.1], 1e-1, 10.0, 1),
    ),
)
"""Everybody, by library; costs are by rank: feet, wrist, centre of mass."""

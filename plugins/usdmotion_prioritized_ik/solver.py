"""The solver as the host sees it: options, and the wrapper around the kernel."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion.options import option
from usdmotion.solving import Problem, Solution
from usdmotion_prioritized_ik.clip import Carried, Input, Pose, Settings, solve_clip
from usdmotion_prioritized_ik.stack import Stack, make_stack


@dataclass(frozen=True)
class PrioritizedIK:
    """Solves every frame by strict priority, joint angles preserved last (2003, 2004)."""

    name: ClassVar[str] = "prioritized_ik"

    iterations: int = option(
        60, "Most iterations on one frame before its finish.", minimum=1, maximum=10000
    )
    finish: int = option(
        30, "Most iterations of each part of the finish, which has one for every level.", minimum=0
    )
    posture: float = option(
        0.5, "How fast joints return to their input angles, per iteration.", minimum=0, maximum=1
    )
    root: float = option(
        0.0, "How fast the root returns to its input position, per iteration.", minimum=0, maximum=1
    )
    damping: float = option(1e-4, "Smallest damping of a level [m].", minimum=1e-9)
    curvature: float = option(
        0.3, "What the squared damping grows by per metre of error [m].", minimum=0
    )
    rank: float = option(1e-3, "Shortest independent row of a Jacobian [m].", minimum=1e-9)
    turn_limit: float = option(0.3, "Largest turn of a joint in one iteration [rad].", minimum=1e-3)
    reach_limit: float = option(
        0.3, "Largest error that one iteration makes up for [m or rad].", minimum=1e-3
    )
    error_change: float = option(
        1e-5, "Change of every error below which a frame is settled [m or rad].", minimum=0
    )
    posture_change: float = option(
        1e-3, "Turn of every joint below which a frame is settled [rad].", minimum=0
    )

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks in rank order."""
        cast, table = problem.cast, problem.table
        translations = np.array(cast.translations)
        rotations = np.array(cast.rotations)
        iterations = np.zeros(cast.frame_count, dtype=np.int64)
        stops = np.zeros(cast.frame_count, dtype=np.int64)
        if len(table.kind) and problem.recruited.any():
            solve_clip(
                Input(
                    cast.parents,
                    cast.translates,
                    1.0 - cast.stiffness,
                    cast.translations,
                    cast.rotations,
                ),
                table,
                self._settings(),
                _pose(problem),
                _carried(problem),
                _stack(problem),
                translations,
                rotations,
                iterations,
                stops,
            )
        return Solution(translations, rotations, iterations, stops)

    def _settings(self) -> Settings:
        return Settings(**{name: getattr(self, name) for name in Settings._fields})


def _column_count(problem: Problem) -> int:
    recruited = problem.recruited
    return int(3 * recruited.sum() + 3 * (recruited & problem.cast.translates).sum())


def _stack(problem: Problem) -> Stack:
    rows = 3 * len(problem.table.kind) + 3
    return make_stack(rows, _column_count(problem), int(problem.table.level[-1]) + 1)


def _carried(problem: Problem) -> Carried:
    levels, nodes = int(problem.table.level[-1]) + 1, problem.cast.node_count
    return Carried(
        valid=np.zeros(levels, dtype=np.bool_),
        translations=np.zeros((levels, nodes, 3)),
        rotations=np.zeros((levels, nodes, 4)),
    )


def _pose(problem: Problem) -> Pose:
    nodes, tasks = problem.cast.node_count, len(problem.table.kind)
    columns = _column_count(problem)
    return Pose(
        translations=np.zeros((nodes, 3)),
        rotations=np.zeros((nodes, 4)),
        positions=np.zeros((nodes, 3)),
        orientations=np.zeros((nodes, 4)),
        saved_translations=np.zeros((nodes, 3)),
        saved_rotations=np.zeros((nodes, 4)),
        recruited=np.zeros(nodes, dtype=np.bool_),
        columns=np.zeros(nodes, dtype=np.int64),
        on=np.zeros(tasks, dtype=np.bool_),
        kept=np.zeros((tasks, 3)),
        errors=np.zeros(tasks),
        posture=np.zeros(columns),
        block=np.zeros((3, columns)),
        row_errors=np.zeros(3),
    )

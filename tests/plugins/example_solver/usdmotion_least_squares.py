"""A solver for usdmotion in one module: damped least squares, one level after another.

It starts every frame at the input pose and steps down the levels, each in what the ones above it
leave free. What curvature leaks upwards meanwhile is mended by doing it again with fewer levels.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion import Bools, Floats, Ints, Problem, Solution, Solver, hookimpl, option
from usdmotion.kernels import (
    TaskTable,
    conjugate,
    forward,
    from_vector,
    is_slack,
    kernel,
    multiply,
    number_columns,
    reference,
    rotate,
    task_error,
    task_rows,
)

_LONGEST_STEP = 0.3


@dataclass(frozen=True)
class LeastSquares:
    """Damped least squares with projection, in plain NumPy: short, not fast."""

    name: ClassVar[str] = "least_squares"
    iterations: int = option(
        40, "Most iterations on one frame for each count of levels.", minimum=1
    )
    damping: float = option(0.01, "Damping of the inverse that moves [m].", minimum=1e-6)
    rank: float = option(0.01, "Shortest direction that counts as held [m].", minimum=1e-6)

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks in rank order."""
        cast = problem.cast
        translations, rotations = np.array(cast.translations), np.array(cast.rotations)
        iterations = np.zeros(cast.frame_count, dtype=np.int64)
        if problem.recruited.any():
            for frame in range(cast.frame_count):
                one = _Frame(problem, frame, translations[frame], rotations[frame])
                iterations[frame] = self._descend(one, problem.table)
        return Solution(translations, rotations, iterations, np.ones_like(iterations))

    def _descend(self, frame: "_Frame", table: TaskTable) -> int:
        spent = 0
        for depth in range(int(table.level.max()) + 1, 0, -1):
            for _ in range(self.iterations):
                spent += 1
                step = self._step(*frame.rows(), np.repeat(table.level, 3), depth)
                frame.move(step)
                if np.abs(step).max() < 1e-9:
                    break
        return spent

    def _step(self, rows: Floats, errors: Floats, levels: Ints, depth: int) -> Floats:
        step = np.zeros(rows.shape[1])
        free = np.eye(rows.shape[1])
        for level in range(depth):
            held, wanted = rows[levels == level], errors[levels == level]
            inside = held @ free
            u, sizes, v = np.linalg.svd(inside, full_matrices=False)
            wanted = u.T @ (wanted - held @ step)
            step = step + v.T @ (sizes / (sizes**2 + self.damping**2) * wanted)
            used = v[sizes > self.rank]
            free = free - used.T @ used
        longest = float(np.abs(step).max())
        return step if longest < _LONGEST_STEP else step * (_LONGEST_STEP / longest)


class _Frame:
    """The pose of one frame, and what its tasks ask of it."""

    def __init__(self, problem: Problem, frame: int, translations: Floats, rotations: Floats):
        """Take the arrays of a pose, which are moved in place."""
        self._cast, self._table, self._frame = problem.cast, problem.table, frame
        self._translations, self._rotations = translations, rotations
        self._columns = np.zeros(problem.cast.node_count, dtype=np.int64)
        self._width = _number(problem.recruited, problem.cast.translates, self._columns)
        activity = problem.table.activity[frame]
        self._kept = np.zeros((len(activity), 3))
        # What eases in or out keeps a share of the error that it starts with.
        self._kept = self._measure()[2] * (1.0 - activity)[:, None]

    def rows(self) -> tuple[Floats, Floats]:
        """Return the rows of all tasks, three each, and their errors."""
        rows, errors, _ = self._measure()
        return rows, errors

    def _measure(self) -> tuple[Floats, Floats, Floats]:
        cast, tasks = self._cast, len(self._table.kind)
        rows, errors = np.zeros((3 * tasks, self._width)), np.zeros(3 * tasks)
        vectors = np.zeros((tasks, 3))
        positions, orientations = forward(
            cast.parents, self._translations[None], self._rotations[None]
        )
        _measure(
            self._table, self._frame, cast.parents, cast.translates, self._columns,
            positions[0], orientations[0], self._kept, rows, errors, vectors,
        )  # fmt: skip
        self._orientations = orientations[0]
        return rows, errors, vectors

    def move(self, step: Floats) -> None:
        """Turn every recruited joint, and move the root, by a step."""
        for node in np.flatnonzero(self._columns >= 0):
            column, parent = self._columns[node], self._cast.parents[node]
            into = conjugate(self._orientations[parent])
            turn = from_vector(rotate(into, step[column : column + 3]))
            turned = multiply(turn, self._rotations[node])
            self._rotations[node] = turned / np.linalg.norm(turned)
            if self._cast.translates[node]:
                self._translations[node] += rotate(into, step[column + 3 : column + 6])


@kernel
def _number(recruited: Bools, translates: Bools, columns: Ints) -> int:
    """(N,), (N,) into (N,)."""
    return number_columns(recruited, translates, columns)


@kernel
def _measure(
    table: TaskTable,
    frame: int,
    parents: Ints,
    translates: Bools,
    columns: Ints,
    positions: Floats,
    orientations: Floats,
    kept: Floats,
    rows: Floats,
    errors: Floats,
    vectors: Floats,
) -> None:
    """(N, 3), (N, 4), (T, 3) into (3T, C), (3T,), (T, 3): weighted rows; absent tasks have none."""
    tasks, block = reference(table), np.empty((3, rows.shape[1]))
    for task in range(table.kind.shape[0]):
        error = task_error(tasks, frame, task, positions, orientations)
        slack = is_slack(tasks, task, error)
        for axis in range(3):
            vectors[task, axis] = 0.0 if slack else error[axis]
        if table.activity[frame, task] == 0.0 or slack:
            continue
        first = 3 * task
        wanted = (error[0] - kept[task, 0], error[1] - kept[task, 1], error[2] - kept[task, 2])
        task_rows(
            tasks, frame, task, parents, translates, columns, rows.shape[1], positions,
            orientations, wanted, rows[first : first + 3], errors[first : first + 3], block,
        )  # fmt: skip
        scale = np.sqrt(table.weight[frame, task])
        rows[first : first + 3] *= scale
        errors[first : first + 3] *= scale


@hookimpl
def register_solvers() -> Iterable[type[Solver]]:
    """Return the one solver."""
    return [LeastSquares]

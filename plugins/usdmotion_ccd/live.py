"""Performances: what is asked frame by frame, solved forward only, group beside group."""

import os
from queue import SimpleQueue
from threading import Thread
from weakref import finalize

import numpy as np

from usdmotion import Pose
from usdmotion.kernels import Prepared, TaskTable, apart
from usdmotion_ccd.frames import solve_groups
from usdmotion_ccd.ranking import solve_ranks, step
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import Parts

SHARES = 4
"""Into how many shares the work of a thread is cut, so that none waits long for another."""

_Job = tuple[Prepared, tuple[int, int, int, int], "SimpleQueue[None]"]


class Ensemble:
    """The groups of a problem, and the threads that solve them side by side.

    A group writes to nothing that another one reads, so it is all the same who solves which.
    """

    def __init__(self, parts: Parts, plan: Schedule, threads: int) -> None:
        """Share the groups out among so many threads; 0 are as many as there are cores."""
        call = apart(step, work=parts)
        handed = parts, call, apart(solve_ranks, work=parts, step=call), plan
        self._solve = Prepared(apart(solve_groups, handed=handed), handed)
        threads = threads or _cores()
        self._shares = _shares(plan, threads)
        self._asked: SimpleQueue[_Job | None] = SimpleQueue()
        # Threads of its own, because those of a pool leave garbage behind at every step.
        for _ in range(min(threads, len(self._shares)) if len(self._shares) > 1 else 0):
            Thread(target=_work, args=(self._asked,), daemon=True).start()
            finalize(self, self._asked.put, None)

    def solve(self, first: int, last: int) -> None:
        """Solve the frames from one to before another."""
        if len(self._shares) == 1:
            self._solve(first, last, *self._shares[0])
            return
        done: SimpleQueue[None] = SimpleQueue()  # Who is interrupted leaves no tokens to the next.
        for share in self._shares:
            self._asked.put((self._solve, (first, last, *share), done))
        for _ in self._shares:
            done.get()


class CyclicPerformance:
    """A performance of a problem; every frame is solved from its input alone."""

    def __init__(self, parts: Parts, plan: Schedule, threads: int) -> None:
        """Take the parts of a problem of one frame, which are written to from now on."""
        table, given, found, *_ = parts
        self._ensemble = Ensemble(parts, plan, threads)
        self._table = table
        self._input = Pose(given.translations[0], given.rotations[0])
        self._output = Pose(found.translations[0], found.rotations[0])

    @property
    def table(self) -> TaskTable:
        """What is asked of the coming frame."""
        return self._table

    @property
    def input(self) -> Pose:
        """Where the input motion is on it."""
        return self._input

    @property
    def output(self) -> Pose:
        """The solved pose of the frame that was stepped to last."""
        return self._output

    def step(self) -> None:
        """Solve the coming frame."""
        self._ensemble.solve(0, 1)


def _work(asked: "SimpleQueue[_Job | None]") -> None:
    """Solve shares until there is none."""
    while (job := asked.get()) is not None:
        solve, numbers, done = job
        solve(*numbers)
        done.put(None)
        # What is held on to here would live as long as the thread waits.
        del job, solve, done


def _cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _shares(plan: Schedule, threads: int) -> list[tuple[int, int]]:
    """Return the first group of each share and the one after its last, alike in work."""
    groups = len(plan.first_visit) - 1
    work = np.append(0, np.cumsum(1 + np.diff(plan.first_task)[plan.visits]))[plan.first_visit]
    count = 1 if threads == 1 else max(min(SHARES * threads, groups), 1)
    ends = np.searchsorted(work, work[-1] * np.arange(1, count + 1) / count).tolist()
    pairs = zip([0, *ends], ends, strict=False)
    return [(start, stop) for start, stop in pairs if start < stop]

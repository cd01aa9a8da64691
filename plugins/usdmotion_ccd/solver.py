"""The solver as the host sees it: options, and the wrapper around the kernel."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from usdmotion import Performance, Problem, Solution, option
from usdmotion.kernels import OVER_FRAMES
from usdmotion_ccd.live import CyclicPerformance, Ensemble
from usdmotion_ccd.planning import plan_moves
from usdmotion_ccd.schedule import Schedule, schedule
from usdmotion_ccd.state import Asked, Clip, Parts, Pose, Saved, Settings, Together, Told, Tree


@dataclass(frozen=True)
class CyclicDescent:
    """Adapts every frame by groups of the body, the trunk last, each rank in turn (2005)."""

    name: ClassVar[str] = "ccd"
    resumes: ClassVar[bool] = True

    iterations: int = option(
        30, "Most iterations on one rank of one frame.", minimum=1, maximum=10000
    )
    tolerance: float = option(
        2e-6, "Error below which a constraint is met [m or rad].", minimum=1e-9
    )
    damping: float = option(
        0.1,
        "Largest turn in one iteration of a joint that is not of a limb [rad]: the less, the more "
        "evenly such joints share a turn.",
        minimum=1e-3,
    )
    settled: float = option(
        1e-3,
        "Share of its squared error that an iteration has to take from a rank to go on.",
        minimum=0,
        maximum=1,
    )
    shift_after: int = option(
        5,
        "Iterations that turn joints alone, before the root is shifted too; for the centre of "
        "mass it is shifted at once.",
        minimum=0,
    )
    threads: int = option(
        0,
        "How many threads solve characters that do not look at each other; 0 is one for each core. "
        "The answer is the same.",
        minimum=0,
        maximum=256,
    )

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks in rank order."""
        known, plan = problem.known, schedule(np.array(problem.cast.parents), problem.table)
        parts = make_parts(problem, plan, self)
        found, told = parts[2], parts[3]
        first, last = len(known.stops) if known else 0, problem.cast.frame_count
        Ensemble(parts, plan, self.threads).solve(first, last)
        iterations, stops = told.iterations.sum(axis=1), told.stops.max(axis=1)
        if known:
            found.translations[:first] = known.translations
            found.rotations[:first] = known.rotations
            iterations[:first], stops[:first] = known.iterations, known.stops
        return Solution(found.translations, found.rotations, iterations, stops)

    def start(self, problem: Problem) -> Performance:
        """Return a performance whose first step is the first frame of a problem."""
        first = problem.during(slice(0, 1))
        own = {name: np.array(getattr(first.table, name)) for name in OVER_FRAMES}
        first = replace(first, table=first.table._replace(**own))
        plan = schedule(np.array(first.cast.parents), first.table)
        return CyclicPerformance(make_parts(first, plan, self), plan, self.threads)


def make_parts(problem: Problem, plan: Schedule, settings: CyclicDescent) -> Parts:
    """Return a solve's input, and room for all that it needs on the way."""
    cast, table = problem.cast, problem.table
    tree, ranks, moves = plan_moves(problem, plan)
    frames, nodes, tasks = cast.frame_count, cast.node_count, len(table.kind)
    characters, count = len(plan.first_node) - 1, len(moves.kind)
    found = Clip(np.array(cast.translations), np.array(cast.rotations))
    told = Told(*(np.zeros((frames, characters), dtype=np.int64) for _ in range(2)))
    return (
        table,
        Clip(np.array(cast.translations), np.array(cast.rotations)),
        found,
        told,
        tree,
        ranks,
        moves,
        Settings(*(getattr(settings, name) for name in Settings._fields)),
        Pose(*(np.zeros((nodes, size)) for size in (3, 4, 3, 4))),
        Saved(np.zeros((3, nodes, 3)), np.zeros((3, nodes, 4))),
        Asked(
            on=np.zeros(tasks, dtype=np.bool_),
            base=np.zeros((tasks, 3)),
            kept=np.zeros((tasks, 3)),
            free=np.zeros((tasks, 3)),
            pinned=np.zeros(nodes, dtype=np.bool_),
            gains=np.ones(count),
            shifted=np.zeros((count, 3)),
            stretches=np.ones(count),
            basis=np.zeros((characters, 3, 3)),
        ),
        make_together(problem, tree, plan, count),
    )


def make_together(problem: Problem, tree: Tree, plan: Schedule, count: int) -> Together:
    """Return room for the steps of all joints."""
    cast, freedom = problem.cast, tree.freedom
    moves = problem.recruited & (tree.enter >= 0) & (freedom > 0.0)
    columns = np.full(cast.node_count, -1, dtype=np.int64)
    characters = len(plan.first_node) - 1
    widths = np.zeros(characters, dtype=np.int64)
    owner = np.cumsum(cast.parents < 0) - 1
    sizes = np.where(cast.translates, 6, 3)
    for node in np.flatnonzero(moves).tolist():
        columns[node] = widths[owner[node]]
        widths[owner[node]] += sizes[node]
    width = int(widths.max(initial=1))
    each = np.ones((characters, width))
    for node in np.flatnonzero(moves).tolist():
        each[owner[node], columns[node] : columns[node] + sizes[node]] = freedom[node]
    rows = 3 * int(np.diff(plan.first_task).max(initial=1))
    return Together(
        translates=np.array(cast.translates),
        columns=columns,
        widths=widths,
        freedom=each,
        rows=np.zeros((characters, rows, width)),
        errors=np.zeros((characters, rows)),
        solved=np.zeros((characters, rows)),
        fixed=np.zeros((characters, width)),
        frozen=np.zeros(count, dtype=np.bool_),
        damping=np.zeros((characters, rows)),
        gram=np.zeros((characters, rows, rows)),
        block=np.zeros((characters, 3, width)),
        step=np.zeros((characters, width)),
    )

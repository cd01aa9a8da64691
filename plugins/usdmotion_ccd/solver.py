"""The solver as the host sees it: options, and the wrapper around the kernel."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from usdmotion import Performance, Problem, Solution, option
from usdmotion.kernels import OVER_FRAMES
from usdmotion_ccd.live import CyclicPerformance, Ensemble
from usdmotion_ccd.making import make_parts
from usdmotion_ccd.schedule import schedule
from usdmotion_ccd.state import Settings


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
    stretch: float = option(
        0.95,
        "Share of its length up to which a limb is stretched before what carries it helps, so that "
        "no elbow snaps straight.",
        minimum=0.5,
        maximum=1.0,
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
        parts = make_parts(problem, plan, self._settings)
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
        return CyclicPerformance(make_parts(first, plan, self._settings), plan, self.threads)

    @property
    def _settings(self) -> Settings:
        return Settings(*(getattr(self, name) for name in Settings._fields))

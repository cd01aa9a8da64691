"""What a figure is, and how it is measured."""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np


@dataclass(frozen=True)
class Figure:
    """One line of the table."""

    what: str
    seconds: float
    beside: str
    yardstick: float
    aim: float
    """Largest ratio that is aimed at."""

    @property
    def ratio(self) -> float:
        return self.seconds / self.yardstick


def least(call: Callable[[], object], times: int = 5) -> float:
    """Return the shortest of some runs, after one that warms up [s]."""
    call()
    runs = []
    for _ in range(times):
        start = perf_counter()
        call()
        runs.append(perf_counter() - start)
    return min(runs)


def products() -> float:
    """Return how long forty products of two 400 × 400 matrices take on one thread [s]."""
    a, b = np.random.default_rng(0).normal(size=(2, 400, 400))
    return least(lambda: [a @ b for _ in range(40)])

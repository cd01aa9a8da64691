"""Cyclic coordinate descent by groups of the body, live (2005)."""

from collections.abc import Iterable

from usdmotion import Solver, hookimpl
from usdmotion_ccd.solver import CyclicDescent

__all__ = ["CyclicDescent", "register_solvers"]


@hookimpl
def register_solvers() -> Iterable[type[Solver]]:
    """Return the one solver."""
    return [CyclicDescent]

"""Cyclic coordinate descent by groups of the body, live (2005)."""

from collections.abc import Iterable

from usdmotion import Solver, hookimpl


@hookimpl
def register_solvers() -> Iterable[type[Solver]]:
    """Return the solver of this package."""
    return []

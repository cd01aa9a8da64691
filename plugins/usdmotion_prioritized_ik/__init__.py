"""Prioritized inverse kinematics of whole clips (Le Callennec and Boulic 2003, 2004)."""

from collections.abc import Iterable

from usdmotion import Solver, hookimpl
from usdmotion_prioritized_ik.solver import PrioritizedIK

__all__ = ["PrioritizedIK", "register_solvers"]


@hookimpl
def register_solvers() -> Iterable[type[Solver]]:
    """Return the one solver."""
    return [PrioritizedIK]

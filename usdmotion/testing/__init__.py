"""The contracts of solvers and readers as tests that anyone can run, and small scenes for them.

Nothing here needs USD. A check fails by an AssertionError that says in one sentence what is
promised and was not kept.
"""

from usdmotion.testing.readers import check_reader
from usdmotion.testing.scenes import ARM, HUMANOID, arm_scene, humanoid_scene, moved, posed
from usdmotion.testing.solvers import SOLVER_CHECKS, check_solver

__all__ = [
    "ARM",
    "HUMANOID",
    "SOLVER_CHECKS",
    "arm_scene",
    "check_reader",
    "check_solver",
    "humanoid_scene",
    "moved",
    "posed",
]

"""The contracts of plugins as tests that anyone can run, and small scenes and searches for them.

Nothing here needs USD. A check fails by an AssertionError that says in one sentence what is
promised and was not kept.
"""

from usdmotion.testing.detectors import DETECTOR_CHECKS, check_detector
from usdmotion.testing.live import LIVE_CHECKS, check_live
from usdmotion.testing.readers import check_reader
from usdmotion.testing.scenes import (
    ARM,
    HUMANOID,
    arm_scene,
    crowd_scene,
    humanoid_scene,
    member,
    moved,
    posed,
)
from usdmotion.testing.searches import STANDS, flying_search, resting_search, stepping_search
from usdmotion.testing.solvers import SOLVER_CHECKS, check_solver

__all__ = [
    "ARM",
    "DETECTOR_CHECKS",
    "HUMANOID",
    "LIVE_CHECKS",
    "SOLVER_CHECKS",
    "STANDS",
    "arm_scene",
    "check_detector",
    "check_live",
    "check_reader",
    "check_solver",
    "crowd_scene",
    "flying_search",
    "humanoid_scene",
    "member",
    "moved",
    "posed",
    "resting_search",
    "stepping_search",
]

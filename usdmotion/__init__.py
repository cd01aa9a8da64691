"""Make captured motion fit the shot, in USD, without touching the original.

These are the public names, for scripts and for plugins; `usdmotion.kernels`, `usdmotion.s4d` and
`usdmotion.testing` are public too. Nothing is imported before it is asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usdmotion.arrays import Bools, Floats, Ints
    from usdmotion.asking import Example
    from usdmotion.capture import Capture, Cluster, Event, ForcePlate, Markers
    from usdmotion.cast import Cast, Character, Joint
    from usdmotion.constraints import (
        Constraint,
        Goal,
        OrientationConstraint,
        PositionConstraint,
        attribute,
        relation,
    )
    from usdmotion.constraints.goal import composite_point, composite_turn
    from usdmotion.curves import Spline, ease
    from usdmotion.detecting import Contact, Detected, Detector, NoisePattern, Search, Template
    from usdmotion.errors import (
        FileError,
        InputError,
        OptionError,
        PluginError,
        SceneError,
        UsdMotionError,
    )
    from usdmotion.ground import Ground
    from usdmotion.hookspecs import hookimpl
    from usdmotion.motion import Body, Motion, Placement, Skeleton
    from usdmotion.options import configured, option
    from usdmotion.pipeline import detect, import_motion, inspect, normalize, retarget, solve
    from usdmotion.plugins import host
    from usdmotion.recording import Reader, Recording
    from usdmotion.s4d import NormalizedMotion
    from usdmotion.scene import Edit, Scene
    from usdmotion.session import Session
    from usdmotion.solving import Live, Performance, Pose, Problem, Solution, Solver, cue
    from usdmotion.tasks import (
        AimTask,
        Axes,
        Demand,
        DistanceTask,
        PointTask,
        RotationTask,
        Term,
        TurnGoal,
    )

__all__ = [
    "AimTask",
    "Axes",
    "Body",
    "Bools",
    "Capture",
    "Cast",
    "Character",
    "Cluster",
    "Constraint",
    "Contact",
    "Demand",
    "Detected",
    "Detector",
    "DistanceTask",
    "Edit",
    "Event",
    "Example",
    "FileError",
    "Floats",
    "ForcePlate",
    "Goal",
    "Ground",
    "InputError",
    "Ints",
    "Joint",
    "Live",
    "Markers",
    "Motion",
    "NoisePattern",
    "NormalizedMotion",
    "OptionError",
    "OrientationConstraint",
    "Performance",
    "Placement",
    "PluginError",
    "PointTask",
    "Pose",
    "PositionConstraint",
    "Problem",
    "Reader",
    "Recording",
    "RotationTask",
    "Scene",
    "SceneError",
    "Search",
    "Session",
    "Skeleton",
    "Solution",
    "Solver",
    "Spline",
    "Template",
    "Term",
    "TurnGoal",
    "UsdMotionError",
    "attribute",
    "composite_point",
    "composite_turn",
    "configured",
    "cue",
    "detect",
    "ease",
    "hookimpl",
    "host",
    "import_motion",
    "inspect",
    "normalize",
    "option",
    "relation",
    "retarget",
    "solve",
]

_ROOMS = (
    "errors",
    "arrays",
    "options",
    "motion",
    "ground.contract",
    "capture",
    "recording",
    "cast",
    "tasks",
    "curves",
    "constraints.goal",
    "constraints",
    "scene",
    "solving",
    "detecting",
    "asking",
    "hookspecs",
    "s4d.normalized",
    "plugins",
    "session",
    "pipeline",
)
"""Where the names are at home, the lowest room first: a name imports no room above its own.

`s4d` is low, and late because it takes longer to import than all that every plugin wants.
"""


def __getattr__(name: str) -> object:
    if name in __all__:
        for room in _ROOMS:
            found = vars(import_module(f"{__name__}.{room}"))
            if name in found:
                return found[name]
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__

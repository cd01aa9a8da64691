"""Numba kernels: arrays in, arrays out; metres, radians, quaternions xyzw.

`kernel` marks what Python calls; `shared` and `summing` what only kernels call; `apart` and
`reference` keep a large kernel quick to compile, and `Prepared` keeps it quick to call.
"""

from usdmotion.kernels.compiling import kernel, shared, summing
from usdmotion.kernels.jacobians import number_columns, task_rows
from usdmotion.kernels.kinematics import forward, place, relative, world_points
from usdmotion.kernels.limits import beyond_limits, limit_boxes, within_limits
from usdmotion.kernels.parts import Reference, apart, reference
from usdmotion.kernels.polylines import telling
from usdmotion.kernels.prepared import Prepared
from usdmotion.kernels.residuals import is_slack, residuals, task_error
from usdmotion.kernels.rotations import (
    chordal_mean,
    compose,
    conjugate,
    from_vector,
    multiply,
    rotate,
    slerp,
    to_vector,
)
from usdmotion.kernels.shapes import gaps
from usdmotion.kernels.table import OVER_FRAMES, Kind, Shape, TaskTable

__all__ = [
    "OVER_FRAMES",
    "Kind",
    "Prepared",
    "Reference",
    "Shape",
    "TaskTable",
    "apart",
    "beyond_limits",
    "chordal_mean",
    "compose",
    "conjugate",
    "forward",
    "from_vector",
    "gaps",
    "is_slack",
    "kernel",
    "limit_boxes",
    "multiply",
    "number_columns",
    "place",
    "reference",
    "relative",
    "residuals",
    "rotate",
    "shared",
    "slerp",
    "summing",
    "task_error",
    "task_rows",
    "telling",
    "to_vector",
    "within_limits",
    "world_points",
]

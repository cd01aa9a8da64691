"""Numba kernels: arrays in, arrays out; metres, radians, quaternions xyzw.

`kernel` marks what Python calls; `inlined`, `shared` and `summing` what only kernels call.
"""

from usdmotion.kernels.compiling import inlined, kernel, shared, summing
from usdmotion.kernels.jacobians import number_columns, task_rows
from usdmotion.kernels.kinematics import forward, place, relative, world_points
from usdmotion.kernels.residuals import residuals, task_error
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
from usdmotion.kernels.table import Kind, TaskTable

__all__ = [
    "Kind",
    "TaskTable",
    "chordal_mean",
    "compose",
    "conjugate",
    "forward",
    "from_vector",
    "inlined",
    "kernel",
    "multiply",
    "number_columns",
    "place",
    "relative",
    "residuals",
    "rotate",
    "shared",
    "slerp",
    "summing",
    "task_error",
    "task_rows",
    "to_vector",
    "world_points",
]

"""Numba kernels: arrays in, arrays out; metres, radians, quaternions xyzw.

`kernel` marks what Python calls, `inlined` what only kernels call.
"""

from usdmotion.kernels.compiling import inlined, kernel
from usdmotion.kernels.kinematics import forward, relative, world_points
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
    "relative",
    "rotate",
    "slerp",
    "to_vector",
    "world_points",
]

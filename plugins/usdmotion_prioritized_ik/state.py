"""Everything that the kernels of this solver pass around: F frames, N nodes, T tasks, L levels."""

from typing import NamedTuple

from usdmotion import Bools, Floats, Ints
from usdmotion.kernels import Reference, TaskTable
from usdmotion_prioritized_ik.bounds import Bounds
from usdmotion_prioritized_ik.descent import Descend
from usdmotion_prioritized_ik.holding import Holding
from usdmotion_prioritized_ik.stack import Stack


class Motion(NamedTuple):
    """The input motion, which becomes the solved one frame by frame."""

    translations: Floats
    """(F, N, 3)"""
    rotations: Floats
    """(F, N, 4)"""
    iterations: Ints
    """(F,) how many were spent."""
    stops: Ints
    """(F,) why each frame was left."""
    carried: Floats
    """(F, L - 1, N, 3 + 4) `Carried` after each frame, but for the last level; zeros are none."""


class Given(NamedTuple):
    """What stays the same."""

    parents: Ints
    """(N,)"""
    translates: Bools
    """(N,) nodes that also translate."""
    freedom: Floats
    """(N,) 1 − stiffness: how willingly a node moves."""
    first_task: Ints
    """(L + 1,) the tasks of level l are first_task[l] to first_task[l + 1]."""
    recruited: Bools
    """(N,) nodes that any task may move on any frame."""
    times: Floats
    """(F,) [s]"""
    shares: Floats
    """(F,) of the input's joint velocities in what is preserved, joint angles being the rest."""


class Limits(NamedTuple):
    """The joints that a solve moves whose turns are limited: K of the nodes."""

    nodes: Ints
    """(K,)"""
    rests: Floats
    """(K, 4) orientation at rest, from which turns are measured, in the parent's frame."""
    low: Floats
    """(K, 3) least rotation vector from rest [rad]."""
    high: Floats
    """(K, 3) greatest one [rad]."""


class Settings(NamedTuple):
    """The solver's options, as numbers."""

    iterations: int
    finish: int
    posture: float
    root: float
    damping: float
    curvature: float
    rank: float
    turn_limit: float
    reach_limit: float
    error_change: float
    posture_change: float
    velocity: float
    change: float
    root_change: float
    change_rank: int


class Pose(NamedTuple):
    """The pose of the frame that is being solved, and what moves it."""

    translations: Floats
    """(N, 3) in the parent's frame."""
    rotations: Floats
    """(N, 4) in the parent's frame."""
    positions: Floats
    """(N, 3) in the world."""
    orientations: Floats
    """(N, 4) in the world."""
    columns: Ints
    """(N,) first column of each node that may move, -1 for the others."""
    course_translations: Floats
    """(N, 3) where each node comes to if it goes on from the frame before as the input does …"""
    course_rotations: Floats
    """(N, 4) … and how it is turned then."""


class Saved(NamedTuple):
    """A pose to come back to."""

    translations: Floats
    """(N, 3)"""
    rotations: Floats
    """(N, 4)"""


class Carried(NamedTuple):
    """The displacement found on the frame before, for the first 1, 2, … L levels."""

    valid: Bools
    """(L,)"""
    translations: Floats
    """(L, N, 3) to be added to the input's."""
    rotations: Floats
    """(L, N, 4) to be applied before the input's."""


class Asked(NamedTuple):
    """Which tasks take part in a solve, and what is left of them."""

    on: Bools
    """(T,)"""
    kept: Floats
    """(T, 3) the error that a task is to leave, so that it is let go or not asked in vain."""
    errors: Floats
    """(T,) how far each is from that [m or rad]."""
    block: Floats
    """(3, C) scratch."""


class Work(NamedTuple):
    """All of it, by reference."""

    motion: Reference[Motion]
    given: Reference[Given]
    table: Reference[TaskTable]
    settings: Reference[Settings]
    pose: Reference[Pose]
    saved: Reference[Saved]
    carried: Reference[Carried]
    asked: Reference[Asked]
    stack: Reference[Stack]
    limits: Reference[Limits]
    bounds: Reference[Bounds]
    holding: Reference[Holding]
    descend: Descend


Parts = tuple[
    Motion,
    Given,
    TaskTable,
    Settings,
    Pose,
    Saved,
    Carried,
    Asked,
    Stack,
    Limits,
    Bounds,
    Holding,
    Descend,
]
"""What `Work` refers to, and the function that it hands over."""

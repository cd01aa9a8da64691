"""Tasks: what a constraint of any kind is made of, and the table of them that solvers read."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels import Kind, Shape, TaskTable

_IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Term:
    """A point fixed to a node, times a factor."""

    node: int
    point: Floats
    """In the node's frame [m], shape (3,) or (frame_count, 3)."""
    coefficient: Floats | float = 1.0
    """A number, or shape (frame_count,)."""


@dataclass(frozen=True, eq=False)
class Axes:
    """The directions along which a point is held."""

    held: tuple[bool, bool, bool] = (True, True, True)
    node: int = -1
    """Node in whose frame the axes are, -1 for the world."""
    rotation: Floats = field(default_factory=lambda: _IDENTITY)
    """Their orientation in that frame, shape (4,) or (frame_count, 4)."""


@dataclass(frozen=True, eq=False)
class PointTask:
    """Asks that the sum of some points be at a target."""

    terms: tuple[Term, ...]
    target: Floats
    """World position, or difference of positions [m], shape (frame_count, 3)."""
    axes: Axes = field(default_factory=Axes)


@dataclass(frozen=True, eq=False)
class TurnGoal:
    """An orientation in a frame, as one part of a composite goal."""

    rotation: Floats
    """xyzw, shape (4,) or (frame_count, 4)."""
    weight: Floats
    """Shape (frame_count,)."""
    node: int = -1
    """Node in whose frame it is, -1 for the world."""


@dataclass(frozen=True, eq=False)
class RotationTask:
    """Asks that a node, turned by an offset, have an orientation."""

    node: int
    goals: tuple[TurnGoal, ...]
    original: Floats
    """World orientation kept where no goal is active, shape (frame_count, 4)."""
    blend: Floats
    """0 the original, 1 the mean of the goals, shape (frame_count,)."""
    offset: Floats = field(default_factory=lambda: _IDENTITY)
    free_axis: Floats = field(default_factory=lambda: np.zeros(3))


@dataclass(frozen=True, eq=False)
class DistanceTask:
    """Asks that the sum of some points be so far from a shape, or that far at least or at most."""

    terms: tuple[Term, ...]
    target: Floats
    """World position, or difference of positions, of the shape [m], shape (frame_count, 3)."""
    distance: Floats | float
    """What is asked [m], a number or shape (frame_count,)."""
    bound: int = 0
    """0 exactly so far; 1 at least, -1 at most: these cost nothing until they are touched."""
    shape: Shape = Shape.BOX
    extent: Floats = field(default_factory=lambda: np.zeros(3))
    """Half its size along its axes [m], shape (3,) or (frame_count, 3); may be infinite."""
    rotation: Floats = field(default_factory=lambda: _IDENTITY)
    """How it lies in the world, xyzw, shape (4,) or (frame_count, 4)."""


@dataclass(frozen=True, eq=False)
class AimTask:
    """Asks that an axis of the first term's node point from the terms to the target."""

    terms: tuple[Term, ...]
    target: Floats
    """World position, or difference of positions [m], shape (frame_count, 3)."""
    axis: Floats
    """In the frame of the first term's node, shape (3,)."""


Task = PointTask | DistanceTask | RotationTask | AimTask


@dataclass(frozen=True, eq=False)
class Demand:
    """The tasks of one constraint, with what they share."""

    tasks: tuple[Task, ...]
    priority: int
    weight: Floats
    """Shape (frame_count,)."""
    activity: Floats
    """Shape (frame_count,)."""
    recruits: Bools
    """Shape (node_count,)."""
    moves: frozenset[int]
    """Nodes whose movement changes what the tasks measure: the effector's, a moving target's."""
    plateau: Bools
    """Frames on which the constraint is to be judged, shape (frame_count,)."""


Columns = dict[str, NDArray[Any]]
"""Some columns of a table by their names."""
_KINDS = {
    PointTask: Kind.POINT,
    DistanceTask: Kind.DISTANCE,
    RotationTask: Kind.ROTATION,
    AimTask: Kind.AIM,
}
_NOWHERE = np.zeros(3)
_ALL = Axes()
_NO_DISTANCE = DistanceTask(terms=(), target=_NOWHERE, distance=0.0)
_NO_ROTATION = RotationTask(node=-1, goals=(), original=_IDENTITY, blend=np.zeros(()))


def tabulate(demands: Sequence[Demand], frame_count: int, node_count: int) -> TaskTable:
    """Return the table of all tasks, in rank order; only the order of the priorities counts."""
    order = sorted(range(len(demands)), key=lambda index: demands[index].priority)
    rows = [(index, task) for index in order for task in demands[index].tasks]
    tasks = [task for _, task in rows]
    constraint = [index for index, _ in rows]
    return TaskTable(
        kind=_ints(_KINDS[type(task)] for task in tasks),
        constraint=_ints(constraint),
        **_shared_columns(demands, constraint, frame_count, node_count),
        **_point_columns(tasks, frame_count),
        **_distance_columns(tasks, frame_count),
        **_term_columns([_terms(task) for task in tasks], frame_count),
        **_rotation_columns(tasks, frame_count),
        **_goal_columns([_goals(task) for task in tasks], frame_count),
    )


def _shared_columns(
    demands: Sequence[Demand], constraint: Sequence[int], frame_count: int, node_count: int
) -> Columns:
    """Return what the tasks of a constraint have in common."""
    ranks = sorted({demand.priority for demand in demands})
    owners = [demands[index] for index in constraint]
    activities = [owner.activity * (owner.weight > 0.0) for owner in owners]
    return {
        "level": _ints(ranks.index(owner.priority) for owner in owners),
        "weight": _over_frames([owner.weight for owner in owners], frame_count),
        "activity": _over_frames(activities, frame_count),
        "recruits": _stack([owner.recruits for owner in owners], node_count, np.bool_),
    }


def _point_columns(tasks: Sequence[Task], frame_count: int) -> Columns:
    axes = [task.axes if isinstance(task, PointTask) else _ALL for task in tasks]
    targets = [_NOWHERE if isinstance(task, RotationTask) else task.target for task in tasks]
    turns = [
        task.rotation if isinstance(task, DistanceTask) else each.rotation
        for task, each in zip(tasks, axes, strict=True)
    ]
    return {
        "target": _over_frames(targets, frame_count, 3),
        "axes": _stack([np.array(each.held) for each in axes], 3, np.bool_),
        "axes_node": _ints(each.node for each in axes),
        "axes_rotation": _over_frames(turns, frame_count, 4),
    }


def _distance_columns(tasks: Sequence[Task], frame_count: int) -> Columns:
    distances = [task if isinstance(task, DistanceTask) else _NO_DISTANCE for task in tasks]
    return {
        "shape": _ints(each.shape for each in distances),
        "extent": _over_frames([each.extent for each in distances], frame_count, 3),
        "distance": _over_frames([each.distance for each in distances], frame_count),
        "bound": _ints(each.bound for each in distances),
    }


def _rotation_columns(tasks: Sequence[Task], frame_count: int) -> Columns:
    turns = [task if isinstance(task, RotationTask) else _NO_ROTATION for task in tasks]
    free = [
        task.axis if isinstance(task, AimTask) else turn.free_axis
        for task, turn in zip(tasks, turns, strict=True)
    ]
    return {
        "offset": _stack([turn.offset for turn in turns], 4, np.float64),
        "free_axis": _stack(free, 3, np.float64),
        "original": _over_frames([turn.original for turn in turns], frame_count, 4),
        "blend": _over_frames([turn.blend for turn in turns], frame_count),
    }


def _term_columns(groups: Sequence[Sequence[Term]], frame_count: int) -> Columns:
    terms = [term for group in groups for term in group]
    return {
        "first_term": _starts(groups),
        "term_node": _ints(term.node for term in terms),
        "term_point": _over_frames([term.point for term in terms], frame_count, 3),
        "term_coefficient": _over_frames([term.coefficient for term in terms], frame_count),
    }


def _goal_columns(groups: Sequence[Sequence[TurnGoal]], frame_count: int) -> Columns:
    goals = [goal for group in groups for goal in group]
    return {
        "first_goal": _starts(groups),
        "goal_node": _ints(goal.node for goal in goals),
        "goal_rotation": _over_frames([goal.rotation for goal in goals], frame_count, 4),
        "goal_weight": _over_frames([goal.weight for goal in goals], frame_count),
    }


def _terms(task: Task) -> tuple[Term, ...]:
    return (Term(task.node, _NOWHERE),) if isinstance(task, RotationTask) else task.terms


def _goals(task: Task) -> tuple[TurnGoal, ...]:
    return task.goals if isinstance(task, RotationTask) else ()


def _ints(values: Iterable[int]) -> Ints:
    return np.array(list(values), dtype=np.int64)


def _starts(groups: Sequence[Sequence[object]]) -> Ints:
    return np.cumsum([0, *(len(group) for group in groups)], dtype=np.int64)


def _stack(
    values: Sequence[Floats | Bools], length: int, dtype: type[np.generic]
) -> NDArray[np.generic]:
    """Return arrays of one length, one a row; none make a table of no rows."""
    stacked: NDArray[np.generic] = np.empty((len(values), length), dtype=dtype)
    for row, value in enumerate(values):
        stacked[row] = value
    return stacked


def _over_frames(values: Sequence[Floats | float], frame_count: int, *shape: int) -> Floats:
    """Return arrays one a column, the same on every frame where they have only one."""
    stacked = np.empty((frame_count, len(values), *shape))
    for index, value in enumerate(values):
        stacked[:, index] = value
    return stacked


def levels(table: TaskTable) -> Iterator[int]:
    """Yield each level that a table has, the first enforced first."""
    yield from sorted(set(table.level.tolist()))

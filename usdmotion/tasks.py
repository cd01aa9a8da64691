"""Tasks: what a constraint of any kind is made of, and the table of them that solvers read."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels import Kind, TaskTable

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


Task = PointTask | RotationTask


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


def tabulate(demands: Sequence[Demand], frame_count: int, node_count: int) -> TaskTable:
    """Return the table of all tasks, in rank order; only the order of the priorities counts."""
    ranks = {rank: level for level, rank in enumerate(sorted({d.priority for d in demands}))}
    order = sorted(range(len(demands)), key=lambda index: demands[index].priority)
    rows = [(index, demands[index], task) for index in order for task in demands[index].tasks]
    owners = [demand for _, demand, _ in rows]
    tasks = [task for _, _, task in rows]
    terms = [_terms(task) for task in tasks]
    goals = [task.goals if isinstance(task, RotationTask) else () for task in tasks]
    every_term = [term for each in terms for term in each]
    every_goal = [goal for each in goals for goal in each]
    axes = [task.axes if isinstance(task, PointTask) else Axes() for task in tasks]

    def over(values: Sequence[Floats | float], *shape: int) -> Floats:
        return _over_frames(values, frame_count, *shape)

    def turns(name: str, default: Floats) -> list[Floats]:
        return [getattr(task, name, default) for task in tasks]

    nothing = np.zeros(3)
    return TaskTable(
        kind=_ints([Kind.ROTATION if isinstance(t, RotationTask) else Kind.POINT for t in tasks]),
        level=_ints([ranks[demand.priority] for demand in owners]),
        constraint=_ints([index for index, _, _ in rows]),
        weight=over([demand.weight for demand in owners]),
        activity=over([d.activity * (d.weight > 0.0) for d in owners]),
        recruits=_stack([demand.recruits for demand in owners], node_count, dtype=np.bool_),
        axes=_stack([np.array(each.held) for each in axes], 3, dtype=np.bool_),
        axes_node=_ints([each.node for each in axes]),
        axes_rotation=over([each.rotation for each in axes], 4),
        first_term=_starts(terms),
        term_node=_ints([term.node for term in every_term]),
        term_point=over([term.point for term in every_term], 3),
        term_coefficient=over([term.coefficient for term in every_term]),
        target=over(turns("target", nothing), 3),
        offset=_stack(turns("offset", _IDENTITY), 4),
        free_axis=_stack(turns("free_axis", nothing), 3),
        first_goal=_starts(goals),
        goal_node=_ints([goal.node for goal in every_goal]),
        goal_rotation=over([goal.rotation for goal in every_goal], 4),
        goal_weight=over([goal.weight for goal in every_goal]),
        original=over(turns("original", _IDENTITY), 4),
        blend=over(turns("blend", np.zeros(frame_count))),
    )


def _terms(task: Task) -> tuple[Term, ...]:
    if isinstance(task, PointTask):
        return task.terms
    return (Term(task.node, np.zeros(3)),)


def _ints(values: Sequence[int]) -> Ints:
    return np.array(values, dtype=np.int64)


def _starts(groups: Sequence[Sequence[object]]) -> Ints:
    return np.cumsum([0, *(len(group) for group in groups)], dtype=np.int64)


def _stack(values: Sequence[Floats | Bools], length: int, dtype: type = np.float64) -> Floats:
    stacked = np.empty((len(values), length), dtype=dtype)
    for row, value in zip(stacked, values, strict=True):
        row[:] = value
    return stacked


def _over_frames(values: Sequence[Floats | float], frame_count: int, *shape: int) -> Floats:
    stacked = np.empty((frame_count, len(values), *shape))
    for index, value in enumerate(values):
        stacked[:, index] = value
    return stacked


def levels(table: TaskTable) -> Iterator[int]:
    """Yield each level that a table has, the first enforced first."""
    yield from sorted(set(table.level.tolist()))

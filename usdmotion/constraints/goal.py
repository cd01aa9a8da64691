"""Goals, and the composite that several of them make (2003, section 3.3)."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast, Joint
from usdmotion.constraints.attributes import attribute
from usdmotion.curves import between, ease
from usdmotion.errors import SceneError
from usdmotion.kernels import chordal_mean, multiply, slerp, world_points
from usdmotion.tasks import Axes, PointTask, RotationTask, Term, TurnGoal


def _identity() -> Floats:
    return np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False, kw_only=True)
class Goal:
    """Where a constraint wants its effector to be, and when."""

    path: str = ""
    mode: str = attribute("position")
    """`position`: be there; `offset`: be that far from the original trajectory."""
    activity: Floats | float = attribute(1.0, animated=True)
    """Its part in the composite goal in 0..1, one number or shape (frame_count,)."""
    times: tuple[float, ...] = attribute((), unit="time")
    """Key times of its easing [s]: none, two, or four."""
    translation: Floats = field(default_factory=lambda: np.zeros(3))
    """Position or offset [m], shape (3,) or (frame_count, 3); in the world, or in `joint`."""
    rotation: Floats = field(default_factory=_identity)
    """Orientation xyzw, shape (4,) or (frame_count, 4); in the world, or in `joint`."""
    joint: Joint | None = None
    """The joint in whose frame it is given; None is the world."""
    axes: Floats = field(default_factory=_identity)
    """World orientation of the space it was given in, shape (4,) or (frame_count, 4)."""

    def share(self, times: Floats) -> Floats:
        """Return its activity with its easing at some times, shape (frame_count,)."""
        return np.asarray(self.activity * ease(times, self.times))

    def span(self, times: Floats) -> slice:
        """Return the frames outside of which it has no part, whatever its activity is."""
        return between(times, self.times)


@dataclass(frozen=True, eq=False)
class Shares:
    """How much each goal and the original trajectory count: P = Σ wᵢ Pᵢ + (1 − A) P_o."""

    weights: tuple[Floats, ...]
    """w_i = A a_i / Σ a, each of shape (frame_count,)."""
    blend: Floats
    """A = max a_i, shape (frame_count,)."""

    @classmethod
    def of(cls, goals: Sequence[Goal], times: Floats) -> "Shares":
        """Return the shares of some goals (DESIGN, section 6; 2003, section 3.3)."""
        if not goals:
            return cls((), np.zeros(len(times)))
        active = np.array([goal.share(times) for goal in goals])
        blend = active.max(axis=0)
        total = active.sum(axis=0)
        scale = np.divide(blend, total, out=np.zeros_like(total), where=total > 0.0)
        return cls(tuple(active * scale), blend)

    @classmethod
    def full(cls, goals: Sequence[Goal], times: Floats) -> "Shares":
        """Return the shares of some goals as if their mean were fully on."""
        active = np.array([goal.share(times) for goal in goals])
        active[:, active.sum(axis=0) <= 0.0] = 1.0
        return cls(tuple(active / active.sum(axis=0)), np.ones(len(times)))


def trajectory(cast: Cast, terms: Sequence[Term]) -> Floats:
    """Return the sum of some terms in the input motion [m], shape (frame_count, 3)."""
    total = np.zeros((cast.frame_count, 3))
    for term in terms:
        place = world_points(
            cast.positions[:, term.node], cast.orientations[:, term.node], term.point
        )
        total += np.reshape(term.coefficient, (-1, 1)) * place
    return total


def composite_point(
    cast: Cast,
    goals: Sequence[Goal],
    effector: Sequence[Term],
    original: Floats,
    held: str,
    path: str,
    shares: Shares | None = None,
) -> PointTask:
    """Return the task that brings an effector to the composite of its goals.

    Args:
        cast: Who takes part.
        goals: The goals; none keeps the original trajectory.
        effector: The constrained point, or those whose sum is constrained.
        original: Its world trajectory in the input motion [m], shape (frame_count, 3).
        held: The axes along which it is held, of "xyz".
        path: Whom to name in an error.
        shares: How much each goal counts; None is what their activities say.
    """
    shares = shares or Shares.of(goals, cast.times)
    target = (1.0 - shares.blend)[:, None] * original
    terms = list(effector)
    for goal, weight in zip(goals, shares.weights, strict=True):
        if goal.mode == "offset":
            target = target + weight[:, None] * original
        if goal.joint is None:
            target = target + weight[:, None] * goal.translation
            continue
        node = cast.node(goal.joint, goal.path or path)
        terms.append(Term(node, goal.translation, -weight))
        if goal.mode == "offset":
            terms.append(Term(node, np.zeros(3), weight))
    return PointTask(tuple(terms), target, _axes(cast, goals, held, path))


def composite_turn(
    cast: Cast, goals: Sequence[Goal], node: int, offset: Floats, free_axis: Floats, path: str
) -> RotationTask:
    """Return the task that brings a joint to the composite orientation of its goals.

    It is the weighted chordal mean of the goals, then a slerp from the original by max a_i.
    """
    shares = Shares.of(goals, cast.times)
    original = multiply(cast.orientations[:, node], offset)
    parts = []
    for goal, weight in zip(goals, shares.weights, strict=True):
        if goal.joint is None:
            rotation = np.broadcast_to(goal.rotation, original.shape)
            if goal.mode == "offset":
                rotation = multiply(rotation, original)
            parts.append(TurnGoal(rotation, weight))
        elif goal.mode == "offset":
            raise SceneError(
                f"<{goal.path or path}> offsets an orientation in a moving joint's frame; "
                "make its mode 'position', or give it a prim as its space"
            )
        else:
            joint = cast.node(goal.joint, goal.path or path)
            parts.append(TurnGoal(goal.rotation, weight, joint))
    blend = shares.blend
    if parts and all(part.node < 0 for part in parts):
        mean = _mean(parts, original)
        original = slerp(original, mean, blend)
        parts, blend = [], np.zeros_like(blend)
    return RotationTask(node, tuple(parts), original, blend, offset, free_axis)


def _mean(parts: Sequence[TurnGoal], original: Floats) -> Floats:
    weights = np.stack([part.weight for part in parts], axis=-1)
    turns = np.stack([part.rotation for part in parts], axis=-2)
    some = weights.sum(axis=-1) > 0.0
    mean = np.array(original)
    mean[some] = chordal_mean(turns[some], weights[some])
    return mean


def _axes(cast: Cast, goals: Sequence[Goal], held: str, path: str) -> Axes:
    if set(held) - set("xyz") or not held:
        raise SceneError(f"<{path}> holds the axes '{held}'; name some of 'xyz'")
    mask = ("x" in held, "y" in held, "z" in held)
    if all(mask) or not goals:
        return Axes(mask)
    first = goals[0]
    same = all(
        goal.joint == first.joint and np.array_equal(goal.axes, first.axes) for goal in goals
    )
    if not same:
        raise SceneError(
            f"<{path}> holds the axes '{held}' of goals in different spaces; "
            "put its goals in one space, or hold 'xyz'"
        )
    node = -1 if first.joint is None else cast.node(first.joint, path)
    return Axes(mask, node, first.axes)

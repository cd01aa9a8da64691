"""Which frames a change of a scene can reach: those on which it asks for something else."""

import dataclasses
from collections.abc import Iterable, Mapping

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.cast import Cast
from usdmotion.constraints import Constraint, Goal, during
from usdmotion.kernels import OVER_FRAMES, TaskTable
from usdmotion.scene import Scene
from usdmotion.tasks import tabulate

_OF_A_GOAL = {"translation", "rotation", "activity", "times"}
"""What a goal can change without a trace where it has no part."""
_OF_THE_SCENE = {"level", "constraint"}
"""Columns that depend on the other constraints."""


def changed(before: Scene, after: Scene) -> slice:
    """Return the frames from the first to the last on which two scenes ask for different things.

    Only constraints are compared, path by path, and those that are the same object are not looked
    at. What is looked at are the frames of what was changed, however long the clip is.

    Args:
        before: A scene.
        after: The same characters at the same times.

    Raises:
        SceneError: A constraint that was changed or added cannot be.
    """
    old, new = ({each.path: each for each in scene.constraints} for scene in (before, after))
    touched = [path for path in {**old, **new} if old.get(path) is not new.get(path)]
    spans = [_asking(after, old.get(path), new.get(path)) for path in touched]
    spans += [_outranking(after.times, old, new, path) for path in touched]
    return hull(spans)


def hull(spans: Iterable[slice]) -> slice:
    """Return the shortest span that holds some; nothing where all of them are empty."""
    some = [span for span in spans if span.start < span.stop]
    return (
        slice(min(each.start for each in some), max(each.stop for each in some))
        if some
        else (slice(0, 0))
    )


def same_levels(before: Scene, after: Scene) -> bool:
    """Tell whether two scenes have the same constraints on each level."""
    return _levels(before) == _levels(after)


def _levels(scene: Scene) -> list[list[str]]:
    ranks: dict[int, list[str]] = {}
    for each in scene.constraints:
        ranks.setdefault(each.priority, []).append(each.path)
    return [ranks[priority] for priority in sorted(ranks)]


def _asking(scene: Scene, old: Constraint | None, new: Constraint | None) -> slice:
    """Return the frames on which one constraint asks for something else, or is new or gone."""
    times, pair = scene.times, [each for each in (old, new) if each is not None]
    window = _window(times, old, new)
    # One frame at least is looked at, so that what cannot be is refused wherever it is active.
    looked = slice(window.start, max(window.stop, window.start + 1))
    if looked.start >= len(times):
        looked = slice(len(times) - 1, len(times))
    frames = hull(each.needs(times, looked) for each in pair)
    cast = Cast.of([each.during(frames) for each in scene.characters])
    inner = slice(looked.start - frames.start, looked.stop - frames.start)
    tables = [
        tabulate([during(each, frames).demand(cast)], cast.frame_count, cast.node_count).during(
            inner
        )
        for each in pair
    ]
    different = np.flatnonzero(_different(tables))
    asking = slice(0, 0)
    if len(different):
        asking = slice(looked.start + int(different[0]), looked.start + int(different[-1]) + 1)
    return hull([asking, _beyond_limits(scene, tables)])


def _beyond_limits(scene: Scene, tables: list[TaskTable]) -> slice:
    """Return the frames on which the input is beyond limits of what only one of two recruits.

    A solver may keep them on every frame, as soon as any constraint recruits the joint.
    """
    recruits = [table.recruits.any(axis=0) for table in tables]
    anew = recruits[0] ^ recruits[1] if len(recruits) == 2 else recruits[0]
    if not anew.any():
        return slice(0, 0)
    cast = Cast.of([each.during(slice(0, 1)) for each in scene.characters])
    limited = ((cast.limits_min > -180.0) | (cast.limits_max < 180.0)).any(axis=1)
    if not (anew & limited).any():
        return slice(0, 0)
    beyond = scene.cast.beyond_limits(scene.cast.rotations)[:, anew]
    frames = np.flatnonzero(beyond.any(axis=1))
    return slice(int(frames[0]), int(frames[-1]) + 1) if len(frames) else slice(0, 0)


def _different(tables: list[TaskTable]) -> Bools:
    """Return the frames on which one of two tables, or the only one, asks for what is its own."""
    active: Bools = np.any([(table.activity > 0.0).any(axis=1) for table in tables], axis=0)
    if len(tables) == 1 or not _same_tasks(*tables):
        return active
    one, other = tables
    apart = np.zeros(len(active), dtype=np.bool_)
    for name in OVER_FRAMES:
        unequal = getattr(one, name) != getattr(other, name)
        apart |= unequal.reshape(len(active), -1).any(axis=1)
    return np.asarray(active & apart)


def _same_tasks(one: TaskTable, other: TaskTable) -> bool:
    """Tell whether tables differ at most in what they have for each frame."""
    names = set(TaskTable._fields) - set(OVER_FRAMES) - _OF_THE_SCENE
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


def _window(times: Floats, old: Constraint | None, new: Constraint | None) -> slice:
    """Return the frames outside of which a constraint is certain to ask for what it asked for."""
    spans = hull(each.span(times) for each in (old, new) if each is not None)
    if old is None or new is None or not _only_goals_moved(old, new):
        return spans
    pairs = zip(old.goals, new.goals, strict=True)
    moved = [each for pair in pairs for each in pair if pair[0] is not pair[1]]
    window = _common(spans, hull(each.span(times) for each in moved))
    # A kind that looks at other frames may look at its goals' there, too.
    return window if new.needs(times, window) == old.needs(times, window) == window else spans


def _only_goals_moved(old: Constraint, new: Constraint) -> bool:
    return (
        type(old) is type(new)
        and _same_but(old, new, {"goals"})
        and len(old.goals) == len(new.goals)
        and all(
            _same_but(one, other, _OF_A_GOAL)
            for one, other in zip(old.goals, new.goals, strict=True)
        )
    )


def _same_but(one: Constraint | Goal, other: Constraint | Goal, names: set[str]) -> bool:
    """Tell whether two values of one kind differ at most in some of their fields."""
    fields = (field.name for field in dataclasses.fields(one) if field.name not in names)
    return all(_equal(getattr(one, name), getattr(other, name)) for name in fields)


def _equal(one: object, other: object) -> bool:
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return bool(np.array_equal(one, other))  # type: ignore[arg-type]
    return one == other


def _outranking(
    times: Floats, old: Mapping[str, Constraint], new: Mapping[str, Constraint], path: str
) -> slice:
    """Return the frames on which a constraint meets one that it stands to in another rank now."""
    was, now = old.get(path), new.get(path)
    if was is None or now is None or was.priority == now.priority:
        return slice(0, 0)
    meetings = []
    for name, other in new.items():
        before = old.get(name)
        if before is None or name == path:
            continue
        if _sign(was.priority - before.priority) != _sign(now.priority - other.priority):
            meetings.append(_common(now.span(times), other.span(times)))
    return hull(meetings)


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)


def _common(one: slice, other: slice) -> slice:
    start = max(one.start, other.start)
    return slice(start, max(start, min(one.stop, other.stop)))

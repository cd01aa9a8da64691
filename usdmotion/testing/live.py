"""The contract of a solver that can be stepped, one promise a function."""

import gc
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.kernels import OVER_FRAMES, forward, residuals
from usdmotion.solving import Live, Performance, Problem, Solver, cue
from usdmotion.testing.scenes import crowd_scene, member

_WRISTS = [f"pelvis/spine/chest/{s}_shoulder/{s}_elbow/{s}_wrist" for s in ("left", "right")]
_MILLIMETRE = 1e-3
_CROWD = 40
_STEPS = 8

Poses = tuple[Floats, Floats]
"""Translations, shape (frame_count, node_count, 3), and rotations of all nodes."""


def check_live(solver: Solver) -> None:
    """If it can be stepped, it keeps every promise of `LIVE_CHECKS`.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    if isinstance(solver, Live):
        for check in LIVE_CHECKS:
            check(solver)


def check_stepping(solver: Live) -> None:
    """Stepped through all frames of a problem it gives what `solve` gives."""
    problem = Problem.of(crowd_scene(_fight()))
    _same(
        _performed(solver, problem),
        _solved(solver, problem),
        "stepped through all frames of a problem it must give what `solve` gives, to the last bit",
    )


def check_arrays(solver: Live) -> None:
    """Its table, input and output stay the same arrays, and are not the problem's."""
    problem = Problem.of(crowd_scene(_fight()))
    before = [np.array(each) for each in _inputs(problem)]
    performance = solver.start(problem)
    _check_first_frame(performance, problem)
    arrays = _arrays(performance)
    for frame in range(problem.cast.frame_count):
        cue(performance, problem, frame)
        performance.step()
        same = all(old is new for old, new in zip(arrays, _arrays(performance), strict=True))
        assert same, "the table, the input and the output must be the same arrays on every frame"
    cue(performance, _changed(problem, "target"), 0)
    kept = all(map(np.array_equal, before, _inputs(problem)))
    assert kept, "a performance must not write into the problem that it was started with"


def check_asked(solver: Live) -> None:
    """It does what is written into its table and its input, whatever it was started with."""
    problem = Problem.of(crowd_scene(_fight()))
    for column in ("target", "term_point", "weight", "activity", "input"):
        other = _changed(problem, column)
        wanted = _solved(solver, other)
        told = f"another {column} that is written in between two steps must be honoured"
        assert not _equal(wanted, _solved(solver, problem)), f"{told} by `solve` too"
        _same(_performed(solver, problem, other), wanted, told)


def check_forward(solver: Live) -> None:
    """What changes on a frame changes nothing on the frames before it."""
    problem = Problem.of(crowd_scene(_fight()))
    middle = problem.cast.frame_count // 2
    for column in ("target", "activity", "input"):
        other = _changed(problem, column, first=middle)
        for poses in (_solved, _performed):
            told = f"another {column} must change nothing on the frames before it"
            early = [each[:middle] for each in poses(solver, other)]
            _same(early, [each[:middle] for each in poses(solver, problem)], told)


def check_now(solver: Live) -> None:
    """A target in the frame of another character's joint is where that joint is now."""
    for follower in (0, 1):
        leader = 1 - follower
        problem = Problem.of(
            crowd_scene([_swing(leader), _follow("follow", follower, leader, priority=1)])
        )
        translations, rotations = _performed(solver, problem)
        world = forward(problem.cast.parents, translations, rotations)
        left = residuals(problem.table, *world)
        assert left.max() <= _MILLIMETRE, (
            "a target in the frame of another character's joint must be where that joint is on the "
            f"same frame, and not be missed by {left.max() * 1e3:.3f} mm"
        )


def check_beside(solver: Live) -> None:
    """Performances that go on beside each other do not disturb each other."""
    problem = Problem.of(crowd_scene(_fight()))
    other = _changed(problem, "target")
    one, two = solver.start(problem), solver.start(other)
    found: list[list[Poses]] = [[], []]
    for frame in range(problem.cast.frame_count):
        for performance, asked, poses in ((one, problem, found[0]), (two, other, found[1])):
            cue(performance, asked, frame)
            performance.step()
            poses.append(_pose(performance))
    for poses, asked in zip(found, (problem, other), strict=True):
        told = "two performances that go on beside each other must not disturb each other"
        _same(_stacked(poses), _performed(solver, asked), told)


def check_threads(solver: Live) -> None:
    """Its answers do not depend on how many threads find them."""
    if not is_dataclass(solver) or "threads" not in [each.name for each in fields(solver)]:
        return
    problem = Problem.of(crowd_scene(_many(_CROWD), count=_CROWD, frame_count=_STEPS))
    one, *others = (_performed(_threaded(solver, count), problem) for count in (1, 2, 3))
    for other in others:
        _same(other, one, "the answer must not depend on the number of threads, to the last bit")


def check_allocation(solver: Live) -> None:
    """A step leaves no memory taken, and takes none in between that is as large as a pose."""
    problem = Problem.of(crowd_scene(_many(_CROWD), count=_CROWD, frame_count=_STEPS))
    performance = solver.start(problem)
    # What is made once, such as threads, is not a step's.
    for _ in range(3):
        performance.step()
    tracemalloc.start()
    try:
        gc.collect()
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        for _ in range(_STEPS):
            performance.step()
        now, peak = (each - before for each in tracemalloc.get_traced_memory())
    finally:
        tracemalloc.stop()
    most = performance.output.translations.nbytes // 2
    assert max(now, peak) < most, (
        f"a step must not allocate: {now} bytes were kept and {peak} taken for a while"
    )


LIVE_CHECKS: tuple[Callable[[Live], None], ...] = (
    check_stepping,
    check_arrays,
    check_asked,
    check_forward,
    check_now,
    check_beside,
    check_threads,
    check_allocation,
)
"""The contract of what can be stepped, one promise each; to parametrize a test with."""


def _hold(name: str, index: int, joint: str, *goals: Goal, priority: int) -> Constraint:
    return PositionConstraint(
        path=f"{member(index)}/Edit/{name}",
        skeleton=member(index),
        joint=joint,
        goals=goals,
        priority=priority,
    )


def _swing(index: int) -> Constraint:
    """Return a left wrist that is moved to and fro."""
    away = np.zeros((24, 3))
    away[:, 1] = 0.1 * np.sin(np.arange(24.0))
    return _hold("swing", index, _WRISTS[0], Goal(mode="offset", translation=away), priority=1)


def _follow(name: str, index: int, other: int, *, priority: int) -> Constraint:
    """Return a right wrist that is at another's left wrist."""
    goal = Goal(joint=(member(other), _WRISTS[0]))
    return _hold(name, index, _WRISTS[1], goal, priority=priority)


def _fight() -> list[Constraint]:
    """Return two who swing, follow each other, and cannot have all that they want."""
    aside = Goal(mode="offset", translation=np.array([0.0, 0.3, 0.1]), times=(0.2, 0.4, 0.6, 0.8))
    return [
        _swing(0),
        replace(_hold("rest", 0, _WRISTS[0], priority=1), weight=0.5),
        _follow("strike", 0, 1, priority=2),
        _swing(1),
        _follow("ward", 1, 0, priority=2),
        _hold("duck", 1, "pelvis/spine/chest/head", aside, priority=3),
    ]


def _many(count: int) -> list[Constraint]:
    """Return a follower and somebody who is followed, many times."""
    near = Goal(mode="offset", translation=np.array([0.05, 0.1, 0.05]))
    lead = [_hold("lead", index, _WRISTS[0], near, priority=1) for index in range(0, count, 2)]
    follow = [_follow("follow", index, index - 1, priority=1) for index in range(1, count, 2)]
    return [*lead, *follow]


def _changed(problem: Problem, column: str, *, first: int = 0) -> Problem:
    """Return a problem of which one column is another from some frame on."""
    cast, table, frames = problem.cast, problem.table, slice(first, None)
    if column == "input":
        moved = np.array(cast.translations)
        moved[frames, 1] += (0.02, 0.01, -0.03)
        return replace(problem, cast=replace(cast, translations=moved))
    values = np.array(getattr(table, column))
    values[frames, 0] = values[frames, 0] * 0.5 + (0.0 if column == "activity" else 0.05)
    return replace(problem, table=table._replace(**{column: values}))


def _threaded(solver: Any, count: int) -> Live:
    return replace(solver, threads=count)  # type: ignore[no-any-return]


def _performed(solver: Live, problem: Problem, asked: Problem | None = None) -> Poses:
    """Return the poses of a performance of a problem, or of what is asked of it instead."""
    performance = solver.start(problem)
    return _stacked(list(_steps(performance, asked or problem)))


def _steps(performance: Performance, problem: Problem) -> Iterator[Poses]:
    for frame in range(problem.cast.frame_count):
        cue(performance, problem, frame)
        performance.step()
        yield _pose(performance)


def _pose(performance: Performance) -> Poses:
    return np.array(performance.output.translations), np.array(performance.output.rotations)


def _stacked(poses: list[Poses]) -> Poses:
    translations, rotations = zip(*poses, strict=True)
    return np.array(translations), np.array(rotations)


def _solved(solver: Live, problem: Problem) -> Poses:
    solution = solver.solve(problem)
    return solution.translations, solution.rotations


def _check_first_frame(performance: Performance, problem: Problem) -> None:
    pairs = [(getattr(performance.table, n), getattr(problem.table, n)[:1]) for n in OVER_FRAMES]
    cast = problem.cast
    pairs += [(performance.input.translations, cast.translations[0])]
    pairs += [(performance.input.rotations, cast.rotations[0])]
    fine = all(np.array_equal(found, wanted) for found, wanted in pairs)
    assert fine, "at the start the table and the input must be those of the problem's first frame"


def _arrays(performance: Performance) -> list[NDArray[Any]]:
    return [*performance.table, *performance.input, *performance.output]


def _inputs(problem: Problem) -> list[NDArray[Any]]:
    return [*problem.table, problem.cast.translations, problem.cast.rotations]


def _equal(one: Any, other: Any) -> bool:
    return all(map(np.array_equal, one, other))


def _same(found: Any, wanted: Any, told: str) -> None:
    assert _equal(found, wanted), told

"""Enforce, filter, enforce again (2004, section 5.2): what a solve has changed becomes smooth."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.kernels import TaskTable, conjugate, from_vector, multiply, to_vector
from usdmotion.motion import Motion
from usdmotion.solving import Problem, Solution, Solver
from usdmotion.tasks import Demand, PointTask, Term, tabulate

_TRANSITION = 1.5
"""Width of the filter, in periods of its cutoff."""


def enforced(solver: Solver, problem: Problem, *, cutoff: float, passes: int) -> Solution:
    """Solve a problem in several passes; the last one enforces.

    After each pass but the last the displacement from the input motion is low-passed, and the next
    one starts from there, so that what comes back has met its constraints after filtering.

    Args:
        solver: Solves each pass.
        problem: What is asked.
        cutoff: Of the filter between two passes [Hz]; 0 is no filter, and then one pass is enough.
        passes: How often to enforce; a filter needs two.
    """
    *before, last = (each.solution for each in passed(solver, problem, cutoff, passes))
    spent = sum((each.iterations for each in before), last.iterations)
    return replace(last, iterations=spent)


@dataclass(frozen=True, eq=False)
class Pass:
    """One of several solves."""

    given: Motion
    """Where it started from: the input motion, with what was filtered of the displacement."""
    solution: Solution
    """What it found."""


def passed(solver: Solver, problem: Problem, cutoff: float, passes: int) -> Iterator[Pass]:
    """Yield each pass of `enforced` as it is done."""
    given = Motion(problem.cast.times, problem.cast.translations, problem.cast.rotations)
    solution = solver.solve(problem)
    yield Pass(given, solution)
    for _ in range(max(passes, 2) - 1 if cutoff > 0.0 else 0):
        found = Motion(given.times, solution.translations, solution.rotations)
        start = smoothed(given, found, cutoff)
        solution = solver.solve(after_filter(problem, start))
        yield Pass(start, solution)


def after_filter(problem: Problem, start: Motion) -> Problem:
    """Return the problem of a pass that starts from a filtered motion, and keeps roots there.

    Below all that is asked, roots that something recruits are asked to stay: posture alone would
    let go of them, since the root's translation is no part of it, and the pass would undo what the
    filter is there for (2004, section 5.2).
    """
    cast = replace(problem.cast, translations=start.translations, rotations=start.rotations)
    return replace(problem, cast=cast, table=_keeping_roots(problem, cast))


def reach(times: Floats, cutoff: float) -> int:
    """Return how many frames on either side of a frame decide on what the filter makes of it.

    It is all of them where the frames are not even, because then the grid depends on them all.
    """
    steps = np.diff(times)
    if len(times) < 3 or np.ptp(steps) > 1e-6 * steps.min():
        return len(times)
    rate = 1.0 / float(steps.mean())
    return 0 if cutoff >= 0.5 * rate else _half_width(rate, cutoff) + 1


def winds(before: Motion, after: Motion) -> bool:
    """Tell whether a displacement ever turns by more than half a turn.

    Then what a frame's rotation vector is depends on every frame before it.
    """
    turned = _continuous(to_vector(multiply(conjugate(before.rotations), after.rotations)))
    return bool(np.linalg.norm(turned, axis=-1).max(initial=0.0) > np.pi)


def _keeping_roots(problem: Problem, cast: Cast) -> TaskTable:
    """Return what is asked, and on a level below it that recruited roots stay where a cast is."""
    frames = np.ones(cast.frame_count)
    kept = [
        Demand(
            tasks=(PointTask((Term(int(root), np.zeros(3)),), cast.positions[:, root]),),
            priority=1,
            weight=frames,
            activity=frames,
            recruits=np.arange(cast.node_count) == root,
            moves=frozenset({int(root)}),
            plateau=frames > 0.0,
        )
        for root in np.flatnonzero(problem.recruited & cast.translates)
    ]
    if not kept:
        return problem.table
    return problem.table.above(tabulate(kept, cast.frame_count, cast.node_count))


def smoothed(before: Motion, after: Motion, cutoff: float) -> Motion:
    """Return a motion with the displacement from another one low-passed.

    The displacement is the difference of positions, and the rotation vector of before⁻¹ after. It
    is filtered by `low_pass`, so that nothing is delayed and a displacement that is nothing at an
    end of the motion stays nothing there.

    Args:
        before: The motion from which the displacement is taken.
        after: The same joints at the same times.
        cutoff: Frequency at which half the amplitude is left [Hz].

    Returns:
        The motion that is before with the filtered displacement.
    """
    moved = after.translations - before.translations
    turned = _continuous(to_vector(multiply(conjugate(before.rotations), after.rotations)))
    changed = np.concatenate([moved, turned], axis=-1)
    if np.any(changed):
        changed = low_pass(before.times, changed, cutoff)
    return Motion(
        before.times,
        before.translations + changed[..., :3],
        multiply(before.rotations, from_vector(changed[..., 3:])),
    )


def low_pass(times: Floats, values: Floats, cutoff: float) -> Floats:
    """Return values over time without what is faster than a frequency.

    Nothing is delayed: the window is symmetric. At the ends values go on as their mirror image in
    the end point, so that the first and the last stay where they are, on their way or at rest.

    Args:
        times: Ascending [s], shape (frame_count,); uneven samples are filtered on an even grid.
        values: Shape (frame_count, …).
        cutoff: Frequency at which half the amplitude is left [Hz].
    """
    from scipy.ndimage import convolve1d  # slow to import, and seldom needed
    from scipy.signal import firwin

    if len(times) < 3:
        return values
    step = float(np.diff(times).min())
    count = int(np.ceil((times[-1] - times[0]) / step - 1e-6)) + 1
    even = np.linspace(times[0], times[-1], count)
    rate = (count - 1) / (times[-1] - times[0])
    if cutoff >= 0.5 * rate:
        return values
    reach = _half_width(rate, cutoff)
    window = firwin(2 * reach + 1, cutoff, fs=rate, window="hamming")
    flat = values.reshape(len(times), -1)
    grid = _interpolated(even, times, flat)
    mirrored = np.pad(grid, ((reach, reach), (0, 0)), mode="reflect", reflect_type="odd")
    filtered = convolve1d(mirrored, window, axis=0)[reach:-reach]
    return np.asarray(_interpolated(times, even, filtered).reshape(values.shape))


def _half_width(rate: float, cutoff: float) -> int:
    return int(np.ceil(_TRANSITION * rate / cutoff))


def _interpolated(wanted: Floats, times: Floats, values: Floats) -> Floats:
    """Return the columns of values at other times, linearly; exact where the times are the same."""
    if np.array_equal(wanted, times):
        return values
    return np.stack([np.interp(wanted, times, column) for column in values.T], axis=1)


def _continuous(vectors: Floats) -> Floats:
    """Return rotation vectors that do not jump by a whole turn from frame to frame."""
    vectors = np.array(vectors)
    for frame in range(1, len(vectors)):
        here, there = vectors[frame], vectors[frame - 1]
        angle = np.linalg.norm(here, axis=-1, keepdims=True)
        axis = np.divide(here, angle, out=np.zeros_like(here), where=angle > 0.0)
        turns = np.round((np.sum(axis * there, axis=-1, keepdims=True) - angle) / (2.0 * np.pi))
        vectors[frame] = here + axis * turns * 2.0 * np.pi
    return vectors

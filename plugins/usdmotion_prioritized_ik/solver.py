"""The solver as the host sees it: options, and the wrapper around the kernel."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion import Bools, Problem, Solution, option
from usdmotion.kernels import TaskTable, apart
from usdmotion_prioritized_ik.bounds import Bounds, make_bounds
from usdmotion_prioritized_ik.clip import solve_clip
from usdmotion_prioritized_ik.continuity import shares_of_velocity
from usdmotion_prioritized_ik.convergence import solve_levels
from usdmotion_prioritized_ik.descent import Descend, descend
from usdmotion_prioritized_ik.holding import Holding, make_holding
from usdmotion_prioritized_ik.iteration import converge
from usdmotion_prioritized_ik.limits import clamp, limits_of
from usdmotion_prioritized_ik.stack import Stack, make_stack
from usdmotion_prioritized_ik.state import (
    Asked,
    Carried,
    Given,
    Limits,
    Motion,
    Parts,
    Pose,
    Saved,
    Settings,
)


@dataclass(frozen=True)
class PrioritizedIK:
    """Solves every frame by strict priority, joint angles preserved last (2003, 2004)."""

    name: ClassVar[str] = "prioritized_ik"
    resumes: ClassVar[bool] = True

    iterations: int = option(
        60, "Most iterations on one frame before its finish.", minimum=1, maximum=10000
    )
    finish: int = option(
        100, "Most iterations of each part of the finish, which has one for every level.", minimum=0
    )
    posture: float = option(
        0.5, "How fast joints return to their input angles, per iteration.", minimum=0, maximum=1
    )
    root: float = option(
        0.2, "How fast the root returns to its input position, per iteration.", minimum=0, maximum=1
    )
    damping: float = option(1e-4, "Smallest damping of a level [m].", minimum=1e-9)
    curvature: float = option(
        0.3, "What the squared damping grows by per metre of error [m].", minimum=0
    )
    rank: float = option(3e-4, "Shortest independent row of a Jacobian [m].", minimum=1e-9)
    turn_limit: float = option(0.3, "Largest turn of a joint in one iteration [rad].", minimum=1e-3)
    reach_limit: float = option(
        0.3, "Largest error that one iteration makes up for [m or rad].", minimum=1e-3
    )
    error_change: float = option(
        1e-5, "Change of every error below which a frame is settled [m or rad].", minimum=0
    )
    posture_change: float = option(
        1e-3, "Turn of every joint below which a frame is settled [rad].", minimum=0
    )
    velocity: float = option(
        0.0,
        "Share of the input's joint velocities in what is preserved, its joint angles being the "
        "rest: what is left after 0.1 s of a displacement that nothing asks for.",
        minimum=0,
        maximum=1,
    )
    change: float = option(
        0.0,
        "How much faster than the input a joint may turn from frame to frame [degrees a second]; "
        "0 is no limit. Limits of joints stand above it.",
        minimum=0,
    )
    root_change: float = option(
        0.0, "The same for the place of the root [m a second]; 0 is no limit.", minimum=0
    )
    change_rank: int = option(
        0, "How many ranks of constraints stand above these limits of change.", minimum=0
    )

    def solve(self, problem: Problem) -> Solution:
        """Return the motion that meets the tasks in rank order."""
        cast, known = problem.cast, problem.known
        levels = int(problem.table.level.max(initial=0)) + 1
        motion = Motion(
            translations=np.array(cast.translations),
            rotations=np.array(cast.rotations),
            iterations=np.zeros(cast.frame_count, dtype=np.int64),
            stops=np.zeros(cast.frame_count, dtype=np.int64),
            # Zeros cost no memory before they are written to, and few frames carry anything.
            carried=np.zeros((cast.frame_count, levels - 1, cast.node_count, 7)),
        )
        if problem.recruited.any():
            limits = limits_of(problem)
            clamp(motion.rotations, limits)
            settings = Settings(*(getattr(self, name) for name in Settings._fields))
            parts = _parts(problem, settings, limits, motion)
            first = _know(known, parts) if known else 0
            once = apart(converge, work=parts)
            solve_clip(parts, apart(solve_levels, work=parts, converge=once), once, first)
        if known:
            _keep(known, motion)
        return Solution(*motion)


def _know(known: Solution, parts: Parts) -> int:
    """Write the last known frame to where it is taken up; return how many are known."""
    motion, pose, count = parts[0], parts[4], len(known.stops)
    pose.translations[:] = known.translations[-1]
    pose.rotations[:] = known.rotations[-1]
    same = known.carried is not None and known.carried.shape[1:] == motion.carried.shape[1:]
    if known.carried is not None and same:
        motion.carried[:count] = known.carried
    return count


def _keep(known: Solution, motion: Motion) -> None:
    """Give the known frames back as they are."""
    count = len(known.stops)
    motion.translations[:count] = known.translations
    motion.rotations[:count] = known.rotations
    motion.iterations[:count] = known.iterations
    motion.stops[:count] = known.stops


def _parts(problem: Problem, settings: Settings, limits: Limits, motion: Motion) -> Parts:
    """Return a solve's input, and room for all that it needs on the way."""
    cast, table, recruited = problem.cast, problem.table, problem.recruited
    nodes, tasks, levels = cast.node_count, len(table.kind), int(table.level[-1]) + 1
    columns = int(3 * recruited.sum() + 3 * (recruited & cast.translates).sum())

    def flags(*shape: int) -> Bools:
        return np.zeros(shape, dtype=np.bool_)

    return (
        motion,
        _given(problem, settings, levels),
        table,
        settings,
        Pose(
            translations=np.zeros((nodes, 3)),
            rotations=np.zeros((nodes, 4)),
            positions=np.zeros((nodes, 3)),
            orientations=np.zeros((nodes, 4)),
            columns=np.zeros(nodes, dtype=np.int64),
            course_translations=np.zeros((nodes, 3)),
            course_rotations=np.zeros((nodes, 4)),
        ),
        Saved(np.zeros((nodes, 3)), np.zeros((nodes, 4))),
        Carried(flags(levels), np.zeros((levels, nodes, 3)), np.zeros((levels, nodes, 4))),
        Asked(
            on=flags(tasks),
            kept=np.zeros((tasks, 3)),
            errors=np.zeros(tasks),
            block=np.zeros((3, columns)),
        ),
        *_descent(columns, levels, table, limits, settings),
    )


def _given(problem: Problem, settings: Settings, levels: int) -> Given:
    """Return what stays the same."""
    cast, table = problem.cast, problem.table
    return Given(
        # As copies, because Numba compiles for arrays that cannot be written once more.
        parents=np.array(cast.parents),
        translates=np.array(cast.translates),
        freedom=1.0 - cast.stiffness,
        first_task=np.searchsorted(table.level, np.arange(levels + 1)),
        recruited=problem.recruited,
        times=np.array(cast.times),
        shares=shares_of_velocity(cast.times, settings.velocity),
    )


def _descent(
    columns: int, levels: int, table: TaskTable, limits: Limits, settings: Settings
) -> tuple[Stack, Limits, Bounds, Holding, Descend]:
    """Return what goes down the levels, and room for what holds it back."""
    most = limits.low.size + int(np.count_nonzero(table.bound))
    most += columns * (settings.change > 0.0 or settings.root_change > 0.0)
    stack = make_stack(3 * len(table.kind), columns, levels, most)
    bounds, holding = make_bounds(most, columns), make_holding(most, columns)
    return (
        stack,
        limits,
        bounds,
        holding,
        apart(descend, stacked=stack, bounded=bounds, holder=holding),
    )

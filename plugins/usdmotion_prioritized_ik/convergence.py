"""All levels at once; where one is out of reach, level by level from there on."""

from collections.abc import Callable

from usdmotion.kernels import is_slack, shared, task_error
from usdmotion_prioritized_ik.iteration import worst
from usdmotion_prioritized_ik.posture import carry_over, recruit, restore, save, start
from usdmotion_prioritized_ik.state import Work

Converge = Callable[[Work, int, int, int, bool, float], int]
"""`converge`, handed over."""
SolveLevels = Callable[[Work, Converge, int, bool], int]
"""`solve_levels`, handed over."""
SETTLED, LIMIT = 1, 2
MISSED = 1e-7
"""An error above this, after the finish, is out of reach [m or rad]."""
LEAK = 1e-6
"""What a lower level may cost a higher one [m or rad]."""
FEW = 6
"""Iterations that are enough for whatever is within reach."""


def solve_levels(work: Work, converge: Converge, frame: int, final: bool) -> int:
    """Solve the tasks that are on; return why it ended.

    Projection is exact only to first order, so that a level that is missed still gives way to the
    levels under it. What it attains without them is therefore found first, and kept as its goal
    while they are solved: then all levels above are within reach, and give way to nobody.
    """
    given, carried, asked = work.given[0], work.carried[0], work.asked[0]
    levels = carried.valid.shape[0]
    recruit(work, levels)
    start(work, frame, levels - 1)
    spent, stop = _settle(work, converge, frame, levels)
    first = _first_missed(work, levels)
    for level in range(levels - 1):
        carried.valid[level] &= level >= first
    for level in range(first, levels):
        if first < levels - 1:
            recruit(work, level + 1)
            if carried.valid[level] or level == first:
                start(work, frame, level)
            more, stop = _settle(work, converge, frame, level + 1)
            spent += more
        spent += _approach(work, converge, frame, level)
        if level > first and worst(work, level) > LEAK:
            spent += _approach_carefully(work, converge, frame, level)
        for task in range(given.first_task[level], given.first_task[level + 1]):
            if asked.on[task]:
                keep(work, frame, task, 1.0)
        save(work)
        if final:
            carry_over(work, frame, level)
    if final:
        carry_over(work, frame, levels - 1)
    work.motion[0].iterations[frame] += spent
    return stop


@shared
def keep(work: Work, frame: int, task: int, share: float) -> None:
    """From here on a task is to leave a share of the error that it has now."""
    pose, kept = work.pose[0], work.asked[0].kept
    error = task_error(work.table, frame, task, pose.positions, pose.orientations)
    if is_slack(work.table, task, error):
        error = (0.0, 0.0, 0.0)
    for axis in range(3):
        kept[task, axis] = share * error[axis]


@shared
def _settle(work: Work, converge: Converge, frame: int, levels: int) -> tuple[int, int]:
    most = work.settings[0].iterations
    spent = converge(work, frame, levels, most, True, 1.0)
    stop = SETTLED if spent < most else LIMIT
    if spent > 0:
        spent += converge(work, frame, levels, FEW, False, 1.0)
    return spent, stop


@shared
def _approach(work: Work, converge: Converge, frame: int, level: int) -> int:
    """Bring a level near: with it, then without it, and so on up the ranks, the top one last."""
    spent = 0
    for levels in range(level + 1, 0, -1):
        spent += converge(work, frame, levels, work.settings[0].finish, False, 1.0)
    return spent


@shared
def _approach_carefully(work: Work, converge: Converge, frame: int, level: int) -> int:
    """Bring a level nearer by steps that cost the levels above nothing.

    Where two levels can be met at one point only, leaving it by a finite step is not made good by
    a finish. So begin again at the saved pose, in which those above were met, and take only steps
    after which they still are.
    """
    restore(work)
    converge(work, frame, level + 1, 0, False, 1.0)
    nearest = _left(work, level)
    spent, share = 0, 1.0
    for _ in range(work.settings[0].finish):
        spent += converge(work, frame, level + 1, 1, False, share)
        for levels in range(level, 0, -1):
            spent += converge(work, frame, levels, FEW, False, 1.0)
        converge(work, frame, level + 1, 0, False, 1.0)
        left = _left(work, level)
        if left < nearest and worst(work, level) < LEAK:
            nearest = left
            save(work)
        else:
            restore(work)
            share *= 0.3
            if share < 1e-3:
                break
    restore(work)
    return spent


@shared
def _first_missed(work: Work, levels: int) -> int:
    asked = work.asked[0]
    for task in range(asked.errors.shape[0]):
        if asked.on[task] and asked.errors[task] > MISSED:
            return int(work.table[0].level[task])
    return levels


@shared
def _left(work: Work, level: int) -> float:
    """Return the squared error of one level."""
    given, asked = work.given[0], work.asked[0]
    square = 0.0
    for task in range(given.first_task[level], given.first_task[level + 1]):
        if asked.on[task]:
            square += asked.errors[task] ** 2
    return square

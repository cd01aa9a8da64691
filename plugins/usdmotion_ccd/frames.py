"""One frame of one character, and the loop over the frames of a clip, group by group."""

from usdmotion.kernels import Reference, is_slack, reference, shared
from usdmotion.kernels.quaternions import vector_at
from usdmotion_ccd.errors import left
from usdmotion_ccd.posing import give_output, give_rest, mix, save, take_input
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import SETTLED, Parts, SolveRanks, Step, Work

WITHOUT, WITH = 1, 2
"""Slots of saved poses."""


Handed = tuple[Parts, Step, SolveRanks, Schedule]
"""What a problem is solved with."""


def solve_groups(handed: Reference[Handed], first: int, last: int, start: int, stop: int) -> None:
    """Solve the frames from `first` to before `last` of the groups from `start` to before `stop`.

    No frame knows of another one, and no group of another one.
    """
    parts, step, solve_ranks, plan = handed[0]
    table, given, found, told, tree, ranks, moves, settings, pose, saved, asked = parts[:11]
    work = Work(
        reference(table),
        reference(given),
        reference(found),
        reference(told),
        reference(tree),
        reference(ranks),
        reference(moves),
        reference(settings),
        reference(pose),
        reference(saved),
        reference(asked),
        reference(parts[11]),
        parts[12],
    )
    for group in range(start, stop):
        for frame in range(first, last):
            for visit in range(plan.first_visit[group], plan.first_visit[group + 1]):
                character = plan.visits[visit]
                nodes = plan.first_node[character], plan.first_node[character + 1]
                told.iterations[frame, character] = 0
                take_input(work, frame, character)
                give_rest(work, frame, nodes[0], nodes[1])
            for visit in range(plan.first_visit[group], plan.first_visit[group + 1]):
                solve_frame(work, step, solve_ranks, frame, plan.visits[visit])


@shared
def solve_frame(
    work: Work, step: Step, solve_ranks: SolveRanks, frame: int, character: int
) -> None:
    """Solve one frame of one character; all others that it looks at are placed already.

    First what is fully on, then with it what eases in or out, in rank order. An easing task leaves
    the share 1 − a of the error that it has in the frame solved without it (DESIGN, section 6).
    """
    ranks, asked, table = work.ranks[0], work.asked[0], work.table[0]
    first = ranks.first_task[ranks.first[character]]
    last = ranks.first_task[ranks.first[character + 1]]
    take_input(work, frame, character)
    for index in range(first, last):
        task = ranks.tasks[index]
        asked.on[task] = table.activity[frame, task] >= 1.0
        for axis in range(3):
            asked.base[task, axis] = 0.0
    work.told[0].stops[frame, character] = SETTLED
    spent = _solve(work, step, solve_ranks, frame, character)
    index = first
    while index < last:
        end = index + 1
        if not _eases(work, frame, ranks.tasks[index]):
            index = end
            continue
        while end < last and _goes_along(work, frame, ranks.tasks[index], ranks.tasks[end]):
            end += 1
        spent += _ease(work, step, solve_ranks, frame, character, index, end)
        index = end
    work.told[0].iterations[frame, character] += spent
    give_output(work, frame, character)


@shared
def _eases(work: Work, frame: int, task: int) -> bool:
    activity = work.table[0].activity[frame, task]
    return bool(activity > 0.0 and activity < 1.0)


@shared
def _goes_along(work: Work, frame: int, task: int, other: int) -> bool:
    """Tell whether two tasks ease as one: those of one constraint do."""
    table = work.table[0]
    same = table.constraint[task] == table.constraint[other]
    return bool(same and table.activity[frame, task] == table.activity[frame, other])


@shared
def _solve(work: Work, step: Step, solve_ranks: SolveRanks, frame: int, character: int) -> int:
    """Solve what is on, and what is let go as far as it is."""
    ranks, asked = work.ranks[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    for index in range(first, ranks.first_task[ranks.first[character + 1]]):
        task = ranks.tasks[index]
        for axis in range(3):
            asked.kept[task, axis] = asked.base[task, axis]
    return solve_ranks(work, step, frame, character)


@shared
def _ease(
    work: Work,
    step: Step,
    solve_ranks: SolveRanks,
    frame: int,
    character: int,
    start: int,
    end: int,
) -> int:
    """Go from the pose without some tasks that ease towards the one with them; return the effort.

    Both are solved from the input. What is between them joint by joint is then corrected, so that
    every other task is left as between the two, and nothing jumps where the activity comes to an
    end.
    """
    ranks, asked, table = work.ranks[0], work.asked[0], work.table[0]
    share = table.activity[frame, ranks.tasks[start]]
    save(work, character, WITHOUT)
    for index in range(start, end):
        task = ranks.tasks[index]
        left(work, frame, task)
        error = vector_at(asked.raw, task)
        if is_slack(work.table, task, error):
            error = (0.0, 0.0, 0.0)
        for axis in range(3):
            asked.kept[task, axis] = error[axis]
        asked.on[task] = True
    _remember(work, character)
    take_input(work, frame, character)
    spent = _solve(work, step, solve_ranks, frame, character)
    save(work, character, WITH)
    _set_between(work, character, share)
    for index in range(start, end):
        task = ranks.tasks[index]
        for axis in range(3):
            asked.base[task, axis] = asked.kept[task, axis]
    mix(work, character, WITHOUT, WITH, share)
    return spent + solve_ranks(work, step, frame, character)


@shared
def _remember(work: Work, character: int) -> None:
    """Keep what is left of each task without what eases in."""
    ranks, asked = work.ranks[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    for index in range(first, ranks.first_task[ranks.first[character + 1]]):
        task = ranks.tasks[index]
        for axis in range(3):
            asked.free[task, axis] = asked.kept[task, axis]


@shared
def _set_between(work: Work, character: int, share: float) -> None:
    """Ask each task to leave what is between what it leaves without and with what eases in."""
    ranks, asked = work.ranks[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    for index in range(first, ranks.first_task[ranks.first[character + 1]]):
        task = ranks.tasks[index]
        for axis in range(3):
            free = asked.free[task, axis]
            asked.kept[task, axis] = free + share * (asked.kept[task, axis] - free)

"""The moves of all ranks of all characters as arrays."""

from collections.abc import Sequence

import numpy as np

from usdmotion import Bools, Floats, Ints, Problem
from usdmotion_ccd.anatomy import Group
from usdmotion_ccd.planning import Move, Planner
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import LIMB, SHIFT, TURN, Moves, Ranks, Tree


def plan_moves(problem: Problem, plan: Schedule) -> tuple[Tree, Ranks, Moves]:
    """Return the joints, the ranks and the moves of a problem."""
    planner = Planner(problem, plan)
    level = problem.table.level
    first, first_task, first_move = [0], [0], [0]
    balances, coupled = [], []
    groups: list[list[tuple[list[int], list[Move]]]] = []
    for start, end in zip(plan.first_task, plan.first_task[1:], strict=False):
        tasks = plan.tasks[start:end].tolist()
        ranks = []
        for each in sorted({int(level[task]) for task in tasks}):
            own = [task for task in tasks if level[task] == each]
            ranks.append((own, planner.moves_of(own)))
            first_task.append(first_task[-1] + len(own))
            first_move.append(first_move[-1] + len(ranks[-1][1]))
            balances.append(planner.balances(own))
            coupled.append(planner.is_coupled(own, ranks[-1][1]))
        first.append(first[-1] + len(ranks))
        groups.append(ranks)
    ranks_ = Ranks(
        first=np.array(first),
        first_task=np.array(first_task),
        tasks=np.array(plan.tasks),
        first_move=np.array(first_move),
        balances=np.array(balances, dtype=np.bool_),
        coupled=np.array(coupled, dtype=np.bool_),
    )
    return planner.tree, ranks_, _tabulate(planner, groups)


def _tabulate(planner: Planner, groups: list[list[tuple[list[int], list[Move]]]]) -> Moves:
    """Return the moves of all ranks of all characters as arrays."""
    most = max((sum(len(own) for own, _ in ranks) for ranks in groups), default=0)
    rows = [move for ranks in groups for _, moves in ranks for move in moves]
    flags = {name: np.zeros((len(rows), most), dtype=np.bool_) for name in _PAIRS}
    shares = np.ones((len(rows), most))
    covers: list[int] = []
    tops: list[int] = []
    above, at = 0, 0
    for ranks in groups:
        tops += [above + top for top in _tops(planner, ranks)]
        above += len(ranks)
        tasks = [(task, moves) for own, moves in ranks for task in own]
        for _, moves in ranks:
            start = at
            for move in moves:
                covers.append(start + move.cover if move.cover >= 0 else -1)
                for place, (task, others) in enumerate(tasks):
                    flags["affects"][at, place] = planner.affects(move, task)
                    flags["drives"][at, place] = task in move.tasks
                    flags["ends"][at, place] = planner.ends(move, task)
                    mended = (_mends(move, each, task) for each in others)
                    flags["mends"][at, place] = any(mended)
                    if move.kind == LIMB and task in move.tasks:
                        later = [e for e in moves if e.kind == LIMB and task in e.tasks]
                        shares[at, place] = 1.0 / (len(later) - later.index(move))
                at += 1
    return _columns(planner, rows, (covers, tops), flags, shares)


def _tops(planner: Planner, ranks: list[tuple[list[int], list[Move]]]) -> list[int]:
    """Return the first rank that each move disturbs, itself or by what makes up for it."""
    disturbed = [
        [
            min(rank for rank, (own, _) in enumerate(ranks) if _touches(planner, move, own))
            for move in moves
        ]
        for _, moves in ranks
    ]
    tops: list[int] = []
    for rank, (_, moves) in enumerate(ranks):
        for place in range(len(moves)):
            top, before = disturbed[rank][place], len(ranks)
            while top < before:
                before = top
                for other in range(top, rank + 1):
                    pairs = zip(ranks[other][1], disturbed[other], strict=True)
                    repairing = (to for move, to in pairs if move.mending)
                    top = min(top, *repairing, top)
            tops.append(top)
    return tops


def _touches(planner: Planner, move: Move, tasks: Sequence[int]) -> bool:
    return any(planner.affects(move, task) for task in tasks)


_PAIRS = ("affects", "drives", "mends", "ends")


def _mends(move: Move, other: Move, task: int) -> bool:
    """Tell whether another move makes up for what a move does to a task."""
    if task not in other.mending:
        return False
    if (move.kind == SHIFT) != (other.kind == SHIFT):
        return True
    if move.kind == SHIFT:
        return False
    return not move.nodes & other.nodes


def _columns(
    planner: Planner,
    rows: list[Move],
    places: tuple[list[int], list[int]],
    flags: dict[str, Bools],
    shares: Floats,
) -> Moves:
    body = planner.body
    limbs = [row.limb for row in rows]
    hinges = [limb.hinge if limb else np.zeros(3) for limb in limbs]
    in_limb = {n for limb in body.limbs for n in (limb.node, limb.middle, limb.end)}

    def ints(values: object) -> Ints:
        return np.array(list(values), dtype=np.int64)  # type: ignore[call-overload]

    def bools(values: object) -> Bools:
        return np.array(list(values), dtype=np.bool_)  # type: ignore[call-overload]

    return Moves(
        kind=ints(row.kind for row in rows),
        node=ints(row.node for row in rows),
        middle=ints(limb.middle if limb else -1 for limb in limbs),
        end=ints(limb.end if limb and planner.tree.enter[limb.end] >= 0 else -1 for limb in limbs),
        hinge=np.array(hinges).reshape(-1, 3),
        damped=bools(row.kind == TURN and row.node not in in_limb for row in rows),
        steady=bools(limb is not None and body.groups[limb.node] == Group.LEGS for limb in limbs),
        repairs=bools(row.mending for row in rows),
        limb=ints(places[0]),
        top=ints(places[1]),
        shares=shares,
        **flags,
    )

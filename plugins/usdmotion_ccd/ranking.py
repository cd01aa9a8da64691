"""The ranks of a frame one after the other, each as far as it disturbs none above it.

A move that disturbs a rank above is followed by what makes up for it; if that is not enough it is
taken back, and tried half as far.
"""

import math

from usdmotion.kernels import shared
from usdmotion_ccd.bending import bend_limb, is_usable, stretch
from usdmotion_ccd.errors import POINT, left, length
from usdmotion_ccd.posing import restore, save
from usdmotion_ccd.shifting import forget, shift_root
from usdmotion_ccd.state import LIMB, LIMIT, SHIFT, Step, Work
from usdmotion_ccd.stretching import UNKNOWN, forget_stretches
from usdmotion_ccd.together import move_together
from usdmotion_ccd.turning import turn_joint

ALL, REPAIR = -1, -2
"""In place of a move: all joints together, for a rank and those above it, or for those alone."""
HALVINGS = 3
"""How often a move is tried half as far."""
REPAIRS = 8
"""How often everything above is made up for, after one move."""
ENOUGH = 0.7
"""Where this share of a disturbance is left, another way to make up for it is tried."""
SLOW = 0.1
"""An iteration that takes no more of the squared error is followed by one of all joints."""
STRAIGHT = 0.995
"""How long a limb may be made for a rank below its own, against its segments."""
SLIGHTLY = 1e-3
"""So much longer it may become by what is not linear in a step."""
STEPS = 8
"""How often all joints move together in one iteration."""
SHIFTS = 8
"""How often the root is shifted before anything else moves."""


def step(work: Work, frame: int, character: int, rank: int, move: int, scale: float) -> bool:
    """Make a move for the tasks of a rank; return whether anything moved."""
    if move < 0:
        return move_together(work, frame, character, rank, move == ALL, scale)
    kind = work.moves[0].kind[move]
    if kind == LIMB:
        return bend_limb(work, frame, character, rank, move, scale)
    if kind == SHIFT:
        return shift_root(work, frame, character, rank, move, scale)
    return turn_joint(work, frame, character, rank, move, scale)


def solve_ranks(work: Work, step: Step, frame: int, character: int) -> int:
    """Solve the tasks that are on, from the pose as it is; return how many iterations it took."""
    ranks, tree, asked = work.ranks[0], work.tree[0], work.asked[0]
    for index in range(tree.first[character], tree.first[character + 1]):
        asked.pinned[tree.order[index]] = False
    first, last = ranks.first[character], ranks.first[character + 1]
    for move in range(ranks.first_move[first], ranks.first_move[last]):
        asked.gains[move] = 1.0
    spent = 0
    for rank in range(first, last):
        forget_stretches(work, rank, UNKNOWN)
        spent += _solve_rank(work, step, frame, character, rank)
        if worst(work, frame, rank) > work.settings[0].tolerance:
            _stretch_out(work, step, frame, character, rank)
        _keep(work, frame, character, rank)
    return spent


@shared
def worst(work: Work, frame: int, rank: int) -> float:
    """Return the largest error of a rank [m or rad]."""
    largest = 0.0
    for index in range(work.ranks[0].first_task[rank], work.ranks[0].first_task[rank + 1]):
        task = work.ranks[0].tasks[index]
        if work.asked[0].on[task]:
            largest = max(largest, length(left(work, frame, task)))
    return largest


@shared
def _cost(work: Work, frame: int, rank: int) -> float:
    """Return the weighted square of the errors of a rank."""
    total = 0.0
    for index in range(work.ranks[0].first_task[rank], work.ranks[0].first_task[rank + 1]):
        task = work.ranks[0].tasks[index]
        if work.asked[0].on[task]:
            error = left(work, frame, task)
            square = error[0] * error[0] + error[1] * error[1] + error[2] * error[2]
            total += work.table[0].weight[frame, task] * square
    return total


@shared
def _solve_rank(work: Work, step: Step, frame: int, character: int, rank: int) -> int:
    """Move, from the extremities to the root, until a rank is met or comes no nearer.

    The root comes in late, with all other joints: when turning them one by one does little more.
    From then on they are turned one by one only where all together bring nothing.
    """
    ranks, settings = work.ranks[0], work.settings[0]
    balances, late = ranks.balances[rank], ranks.coupled[rank]
    for iteration in range(settings.iterations):
        late |= iteration >= settings.shift_after
        if worst(work, frame, rank) <= settings.tolerance:
            return iteration
        before = _cost(work, frame, rank)
        if late and not balances:
            if _all_together(work, step, frame, character, rank):
                return iteration + 1
            if _cost(work, frame, rank) <= (1.0 - settings.settled) * before:
                continue
        for move in range(ranks.first_move[rank], ranks.first_move[rank + 1]):
            for _ in range(_tries(work, character, rank, move, late)):
                if not _attempt(work, step, frame, character, rank, move):
                    break
                if worst(work, frame, rank) <= settings.tolerance:
                    return iteration + 1
            if balances and work.moves[0].kind[move] == SHIFT:
                if _all_together(work, step, frame, character, rank):
                    return iteration + 1
        least = settings.settled if late else max(settings.settled, SLOW)
        if _cost(work, frame, rank) > (1.0 - least) * before:
            if late:
                return iteration + 1
            late = True
    work.told[0].stops[frame, character] = LIMIT
    return settings.iterations


@shared
def _stretch_out(work: Work, step: Step, frame: int, character: int, rank: int) -> None:
    """Let the limbs of a rank that is not met go as far as they can."""
    forget_stretches(work, rank, 1.0)
    for move in range(work.ranks[0].first_move[rank], work.ranks[0].first_move[rank + 1]):
        if work.moves[0].kind[move] == LIMB:
            _attempt(work, step, frame, character, rank, move)


@shared
def _all_together(work: Work, step: Step, frame: int, character: int, rank: int) -> bool:
    """Move all joints while that brings a rank much nearer; return whether it is met."""
    for _ in range(STEPS):
        before = _cost(work, frame, rank)
        if not _attempt(work, step, frame, character, rank, ALL):
            return False
        if worst(work, frame, rank) <= work.settings[0].tolerance:
            return True
        if _cost(work, frame, rank) > ENOUGH * ENOUGH * before:
            return False
    return False


@shared
def _tries(work: Work, character: int, rank: int, move: int, late: bool) -> int:
    """Return how often a move may be made in an iteration, an early one or a late one.

    A limb does all that a turn of its joints could do, and turns come before the root is shifted,
    unless that is for the centre of mass.
    """
    moves = work.moves[0]
    if moves.kind[move] == SHIFT and work.ranks[0].balances[rank]:
        return SHIFTS
    if work.together[0].translates[moves.node[move]]:
        return 1 if late else 0
    limb = moves.limb[move]
    return 0 if limb >= 0 and is_usable(work, character, rank, limb) else 1


@shared
def _attempt(work: Work, step: Step, frame: int, character: int, rank: int, move: int) -> bool:
    """Make a move as far as it brings its rank nearer and disturbs none above."""
    ranks = work.ranks[0]
    before, scale = _cost(work, frame, rank), 1.0
    if move < 0 or work.moves[0].kind[move] != SHIFT:
        forget(work, ranks.first[character], rank + 1)
    save(work, character, 0)
    for _ in range(HALVINGS + 1):
        if not step(work, frame, character, rank, move, scale):
            return False
        kept = _repair(work, step, frame, character, rank, move)
        if kept and _cost(work, frame, rank) < before:
            return True
        restore(work, character, 0)
        forget(work, ranks.first[character], rank + 1)
        scale *= 0.5
    return False


@shared
def _repair(work: Work, step: Step, frame: int, character: int, rank: int, move: int) -> bool:
    """Make up for what a move did to its own rank and those above, which come last.

    First by what needs no more than a limb, and where that is not enough by every turn.
    """
    most = 2.0 * work.settings[0].tolerance
    top = work.ranks[0].first[character]
    if move >= 0:
        top = work.moves[0].top[move]
    before = math.inf
    whole = move < 0
    for _ in range(REPAIRS):
        if whole:
            step(work, frame, character, rank, REPAIR, 1.0)
        elif move >= 0:
            _repair_by_limbs(work, step, frame, character, rank, move, top)
        left_over = _disturbed(work, frame, top, rank)
        if left_over <= most:
            return not _is_overstretched(work, character, rank)
        if left_over > ENOUGH * before:
            if whole:
                return False
            if move >= 0 and work.moves[0].kind[move] == SHIFT:
                return False
            whole = True
            top = work.ranks[0].first[character]
        before = left_over
    return False


@shared
def _repair_by_limbs(
    work: Work, step: Step, frame: int, character: int, rank: int, move: int, top: int
) -> None:
    ranks, moves = work.ranks[0], work.moves[0]
    for other in range(rank, top - 1, -1):
        for repair in range(ranks.first_move[other], ranks.first_move[other + 1]):
            if moves.repairs[repair] and not _overlap(work, move, repair):
                step(work, frame, character, other, repair, 1.0)


@shared
def _is_overstretched(work: Work, character: int, rank: int) -> bool:
    """Tell whether a limb that works for a rank above was made all but straight.

    There a knee turns faster than anything that moves it, so it is straightened only by its own
    rank, or where it is straight already.
    """
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    first = ranks.first[character]
    for move in range(ranks.first_move[first], ranks.first_move[rank]):
        if moves.kind[move] == LIMB and stretch(work, move) > asked.stretches[move] + SLIGHTLY:
            return True
    return False


@shared
def _overlap(work: Work, move: int, other: int) -> bool:
    """Tell whether two moves change the same joint."""
    moves = work.moves[0]
    if (moves.kind[move] == SHIFT) != (moves.kind[other] == SHIFT):
        return False
    a, b = moves.node[move], moves.middle[move]
    c, d = moves.node[other], moves.middle[other]
    return bool(a == c or a == d or (b >= 0 and (b == c or b == d)))


@shared
def _disturbed(work: Work, frame: int, top: int, rank: int) -> float:
    """Return how far ranks above one are from where they were left, from `top` on [m or rad]."""
    largest = 0.0
    for other in range(top, rank):
        largest = max(largest, worst(work, frame, other))
    return largest


@shared
def _keep(work: Work, frame: int, character: int, rank: int) -> None:
    """From here on the tasks of a rank are to stay as near as they came."""
    ranks, asked, table = work.ranks[0], work.asked[0], work.table[0]
    tree = work.tree[0]
    for move in range(ranks.first_move[rank], ranks.first_move[rank + 1]):
        if work.moves[0].kind[move] == LIMB:
            asked.stretches[move] = max(STRAIGHT, stretch(work, move) + 1e-6)
    for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        if not asked.on[task]:
            continue
        if length(left(work, frame, task)) > work.settings[0].tolerance:
            for axis in range(3):
                asked.kept[task, axis] = asked.raw[task, axis]
        if table.kind[task] != POINT or table.first_term[task + 1] > table.first_term[task] + 1:
            continue
        at = table.term_node[table.first_term[task]]
        for place in range(tree.enter[at], tree.leave[at]):
            asked.pinned[tree.order[place]] = True

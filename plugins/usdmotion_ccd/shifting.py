"""The root is moved: last, and first of all for the centre of mass (2005, section 9)."""

from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import vector_at
from usdmotion_ccd.errors import carried_factor, dot, left, length, sight
from usdmotion_ccd.posing import shift
from usdmotion_ccd.state import Work
from usdmotion_ccd.turning import bar

FAR = 0.03
"""Farther the root is not shifted in one iteration, but for the centre of mass [m]."""
LEAST, MOST = 0.3, 1.5
"""What may arrive of a shift, at least and at most, once the limbs have made up for it."""


@shared
def shift_root(work: Work, frame: int, character: int, rank: int, move: int, scale: float) -> bool:
    """Move the root by what the tasks of a rank ask for on the whole; return whether it moved."""
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    node, first = moves.node[move], ranks.first_task[ranks.first[character]]
    total, x, y, z = 0.0, 0.0, 0.0, 0.0
    for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        place = index - first
        if not asked.on[task] or not moves.drives[move, place]:
            continue
        error = left(work, frame, task)
        if moves.mends[move, place] and length(error) <= work.settings[0].tolerance:
            continue
        factor = carried_factor(sight(work), frame, task, node)
        weight = work.table[0].weight[frame, task]
        total += weight * factor * factor
        x += weight * factor * error[0]
        y += weight * factor * error[1]
        z += weight * factor * error[2]
    if total < 1e-9:
        return False
    x, y, z = x / total, y / total, z / total
    barred = bar(work, frame, character, rank, move)
    if barred == 3:
        return False
    for index in range(barred):
        way = vector_at(asked.basis[character], index)
        along = dot(way, (x, y, z))
        x, y, z = x - along * way[0], y - along * way[1], z - along * way[2]
    if length((x, y, z)) * scale < 1e-12:
        return False
    whole = scale * work.tree[0].freedom[node]
    _learn(work, move, x, y, z, whole == 1.0)
    factor = whole / asked.gains[move]
    if not ranks.balances[rank]:
        factor = min(factor, FAR / length((x, y, z)))
    shift(work, node, (factor * x, factor * y, factor * z))
    return True


@shared
def _learn(work: Work, move: int, x: float, y: float, z: float, whole: bool) -> None:
    """Reckon with what arrived of the shift before: legs that stay carry a part of the mass."""
    asked = work.asked[0]
    before = vector_at(asked.shifted, move)
    square = dot(before, before)
    if square > 0.0:
        arrived = 1.0 - dot(before, (x, y, z)) / square
        gain = asked.gains[move] * min(max(arrived, LEAST), MOST)
        asked.gains[move] = min(max(gain, LEAST), MOST)
    share = 1.0 if whole else 0.0
    asked.shifted[move, 0] = share * x
    asked.shifted[move, 1] = share * y
    asked.shifted[move, 2] = share * z


@shared
def forget(work: Work, rank: int, last: int) -> None:
    """Forget what the last shifts were for, of some ranks' moves."""
    ranks, asked = work.ranks[0], work.asked[0]
    for move in range(ranks.first_move[rank], ranks.first_move[last]):
        for axis in range(3):
            asked.shifted[move, axis] = 0.0

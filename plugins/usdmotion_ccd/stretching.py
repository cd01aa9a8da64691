"""How far a limb is stretched, so that no elbow and no knee snaps straight.

In closed form a limb that comes to its full length turns its middle joint infinitely fast. Near
there it leaves more and more to what carries it, and does all of it only where that does not help.
"""

import math
from typing import Any

from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import vector_at
from usdmotion_ccd.errors import length
from usdmotion_ccd.state import LIMB, Work

UNKNOWN = -1.0
"""Nobody has asked yet how far a limb may be stretched."""


@shared
def forget_stretches(work: Work, rank: int, most: float) -> None:
    """Set how far the limbs of a rank may be stretched, `UNKNOWN` to find it out."""
    for move in range(work.ranks[0].first_move[rank], work.ranks[0].first_move[rank + 1]):
        if work.moves[0].kind[move] == LIMB:
            work.asked[0].stretches[move] = most


@shared
def allowed(work: Work, character: int, rank: int, move: int, at: Any, way: Any) -> float:
    """Return how long a limb may be, from its start to a point that is to go some way [m].

    What it was stretched already it may be; from there, or from the share that the option says, it
    comes the nearer to its full length the farther it is asked to go: found out once for a frame.
    """
    moves, asked, positions = work.moves[0], work.asked[0], work.pose[0].positions
    start = vector_at(positions, moves.node[move])
    knee = vector_at(positions, moves.middle[move])
    whole = length(_from(start, knee)) + length(_from(knee, at))
    if asked.stretches[move] == UNKNOWN:
        asked.stretches[move] = 1.0
        if _is_helped(work, character, rank, move):
            goal = (at[0] + way[0], at[1] + way[1], at[2] + way[2])
            free = max(work.settings[0].stretch, length(_from(start, at)) / whole)
            beyond = max(length(_from(start, goal)) / whole - free, 0.0)
            room = max(1.0 - free, 1e-9)
            asked.stretches[move] = free + room * (1.0 - math.exp(-beyond / room))
    return float(asked.stretches[move] * whole)


@shared
def _is_helped(work: Work, character: int, rank: int, limb: int) -> bool:
    """Tell whether what carries a limb may do for its tasks what it leaves."""
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    for move in range(ranks.first_move[rank], ranks.first_move[rank + 1]):
        if moves.kind[move] == LIMB or moves.limb[move] == limb:
            continue
        for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
            place = index - first
            both = moves.drives[move, place] and moves.drives[limb, place]
            if both and asked.on[ranks.tasks[index]]:
                return True
    return False


@shared
def _from(a: Any, b: Any) -> tuple[float, float, float]:
    return (b[0] - a[0], b[1] - a[1], b[2] - a[2])

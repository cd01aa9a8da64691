"""A limb of two segments in closed form: the second joint gives it its length, the first one aims.

The length comes from the law of cosines (2005, section 7); it bends in the plane in which it is
bent, and about its hinge where it is straight.
"""

import math
from typing import Any

from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import (
    Vector,
    cross,
    inverse,
    quaternion_at,
    turned,
    vector_at,
)
from usdmotion.kernels.residuals import between
from usdmotion_ccd.errors import dot, left, length, sight, term_place
from usdmotion_ccd.posing import carries, orient, turn
from usdmotion_ccd.state import Work
from usdmotion_ccd.stretching import allowed
from usdmotion_ccd.turning import solve_turn

HINGE = 0.05
"""How much the hinge counts against the sine of the angle in which a limb is bent."""
TRIES = 3
"""Steps that bring several points of a limb's end to lie as they should."""
SHORT = 1e-6
"""A segment shorter than this is none [m]."""


@shared
def is_usable(work: Work, character: int, rank: int, move: int) -> bool:
    """Tell whether a limb may be bent as a whole: nothing above, and nothing else, needs it so."""
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    for index in range(first, ranks.first_task[rank + 1]):
        place = index - first
        if not asked.on[ranks.tasks[index]] or not moves.affects[move, place]:
            continue
        if moves.mends[move, place] or moves.ends[move, place]:
            continue
        if index < ranks.first_task[rank] or not moves.drives[move, place]:
            return False
    return True


@shared
def bend_limb(work: Work, frame: int, character: int, rank: int, move: int, scale: float) -> bool:
    """Bend a limb for the tasks of a rank; return whether it moved."""
    moves, pose = work.moves[0], work.pose[0]
    if not is_usable(work, character, rank, move):
        return False
    count, at, way = _asked_way(work, frame, character, rank, move)
    end = moves.end[move]
    if count == 0 or not _holds(work, character, rank, move, count):
        end = -1
    if count > 1:
        if end < 0:
            return False
        for _ in range(TRIES):
            turn_end(work, frame, character, rank, move)
        count, at, way = _asked_way(work, frame, character, rank, move)
    if count == 0 or length(way) * scale < 1e-12:
        return False
    if end >= 0:
        at = vector_at(pose.positions, end)
    most = allowed(work, character, rank, move, at, way)
    if end < 0:
        reach(work, move, at, (scale * way[0], scale * way[1], scale * way[2]), most)
        return True
    orientation = quaternion_at(pose.orientations, end)
    reach(work, move, at, (scale * way[0], scale * way[1], scale * way[2]), most)
    orient(work, end, orientation)
    return True


@shared
def stretch(work: Work, move: int) -> float:
    """Return how long a limb is against its segments; 0 where nobody looks at its end."""
    moves, positions = work.moves[0], work.pose[0].positions
    if moves.end[move] < 0:
        return 0.0
    start, knee = vector_at(positions, moves.node[move]), vector_at(positions, moves.middle[move])
    end = vector_at(positions, moves.end[move])
    whole = length(_from(start, knee)) + length(_from(knee, end))
    return length(_from(start, end)) / max(whole, SHORT)


@shared
def _driven_term(work: Work, frame: int, task: int, node: int) -> int:
    """Return the one term of a task that a joint carries."""
    table = work.table[0]
    for term in range(table.first_term[task], table.first_term[task + 1]):
        if carries(work.tree, node, table.term_node[term]):
            return term
    return int(table.first_term[task])


@shared
def _asked_way(
    work: Work, frame: int, character: int, rank: int, move: int
) -> tuple[int, Vector, Vector]:
    """Return how many points a limb moves, their mean, and the mean way they are to go [m].

    The count is 0 where all of them are where they should be.
    """
    ranks, moves, table = work.ranks[0], work.moves[0], work.table[0]
    first, middle = ranks.first_task[ranks.first[character]], moves.middle[move]
    count, total, missing = 0, 0.0, False
    x, y, z, u, v, w = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        if not work.asked[0].on[task] or not moves.drives[move, index - first]:
            continue
        error = left(work, frame, task)
        missing |= length(error) > 0.1 * work.settings[0].tolerance
        term = _driven_term(work, frame, task, middle)
        place, weight = term_place(sight(work), frame, term), table.weight[frame, task]
        share = weight * moves.shares[move, index - first] / table.term_coefficient[frame, term]
        x, y, z = x + weight * place[0], y + weight * place[1], z + weight * place[2]
        u, v, w = u + share * error[0], v + share * error[1], w + share * error[2]
        total += weight
        count += 1
    if not missing:
        return 0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    return count, (x / total, y / total, z / total), (u / total, v / total, w / total)


@shared
def _holds(work: Work, character: int, rank: int, move: int, count: int) -> bool:
    """Tell whether a limb keeps the orientation of its end, and may turn that."""
    ranks, moves, table = work.ranks[0], work.moves[0], work.table[0]
    first, end = ranks.first_task[ranks.first[character]], moves.end[move]
    if end < 0 or work.tree[0].freedom[end] < 1.0:
        return False
    wanted, allowed = moves.steady[move] or count > 1, False
    for index in range(first, ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        if not work.asked[0].on[task]:
            continue
        wanted |= moves.ends[move, index - first]
        if index >= ranks.first_task[rank] and moves.drives[move, index - first]:
            allowed |= table.recruits[task, end]
            at = _driven_term(work, 0, task, moves.middle[move])
            if not carries(work.tree, end, table.term_node[at]):
                return False
    return bool(wanted and allowed)


@shared
def turn_end(work: Work, frame: int, character: int, rank: int, move: int) -> None:
    """Turn the end of a limb so that its points lie as they should, wherever they are."""
    ranks, moves, table = work.ranks[0], work.moves[0], work.table[0]
    first, end = ranks.first_task[ranks.first[character]], moves.end[move]
    _, center, way = _asked_way(work, frame, character, rank, move)
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    x, y, z = 0.0, 0.0, 0.0
    for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        if not work.asked[0].on[task] or not moves.drives[move, index - first]:
            continue
        error = left(work, frame, task)
        term = _driven_term(work, frame, task, end)
        place, weight = term_place(sight(work), frame, term), table.weight[frame, task]
        share = moves.shares[move, index - first] / table.term_coefficient[frame, term]
        error = (share * error[0] - way[0], share * error[1] - way[1], share * error[2] - way[2])
        p, q, r = place[0] - center[0], place[1] - center[1], place[2] - center[2]
        x += weight * (q * error[2] - r * error[1])
        y += weight * (r * error[0] - p * error[2])
        z += weight * (p * error[1] - q * error[0])
        a, b, c = a + weight * (q * q + r * r), b - weight * p * q, c - weight * p * r
        d, e, f = d + weight * (p * p + r * r), e - weight * q * r, f + weight * (p * p + q * q)
    turn(work, end, solve_turn(work, character, 0, (a, b, c, d, e, f), (x, y, z)))


@shared
def reach(work: Work, move: int, at: Any, way: Any, most: float) -> None:
    """Bring a point that goes with the second segment of a limb as far along a way as it goes.

    Args:
        work: The pose.
        move: The limb.
        at: Where the point is [m].
        way: How far it should go [m].
        most: How far it may be from where the limb starts [m].
    """
    moves, tree, pose = work.moves[0], work.tree[0], work.pose[0]
    node, middle = moves.node[move], moves.middle[move]
    start, knee = vector_at(pose.positions, node), vector_at(pose.positions, middle)
    goal = _from(start, (at[0] + way[0], at[1] + way[1], at[2] + way[2]))
    upper, lower = _from(start, knee), _from(knee, at)
    if length(upper) < SHORT or length(lower) < SHORT or length(goal) < SHORT:
        return
    axis = _hinge(work, move, upper, lower)
    angle = tree.freedom[middle] * _bend(upper, lower, axis, min(length(goal), most))
    own = quaternion_at(pose.orientations, middle)
    before = turned(inverse(own), lower)
    turn(work, middle, (angle * axis[0], angle * axis[1], angle * axis[2]))
    lower = turned(quaternion_at(pose.orientations, middle), before)
    reached = (upper[0] + lower[0], upper[1] + lower[1], upper[2] + lower[2])
    if length(reached) < SHORT:
        return
    x, y, z = between(reached, goal)
    share = tree.freedom[node]
    turn(work, node, (share * x, share * y, share * z))


@shared
def _from(a: Any, b: Any) -> Vector:
    return (b[0] - a[0], b[1] - a[1], b[2] - a[2])


@shared
def _hinge(work: Work, move: int, upper: Any, lower: Any) -> Vector:
    """Return the axis about which a limb bends: that of its bend, or its hinge if it has none."""
    frame = quaternion_at(work.pose[0].orientations, work.moves[0].node[move])
    x, y, z = turned(frame, vector_at(work.moves[0].hinge, move))
    side = cross(upper, lower)
    scale = 1.0 / (length(upper) * length(lower))
    axis = (scale * side[0] + HINGE * x, scale * side[1] + HINGE * y, scale * side[2] + HINGE * z)
    size = length(axis)
    if size < 1e-9:
        return (x, y, z)
    return (axis[0] / size, axis[1] / size, axis[2] / size)


@shared
def _bend(upper: Any, lower: Any, axis: Any, distance: float) -> float:
    """Return the turn about an axis that puts the ends of two segments at a distance [rad].

    It is the law of cosines (2005, section 7) where the segments may leave the axis's plane.
    """
    along = dot(axis, lower)
    flat = (lower[0] - along * axis[0], lower[1] - along * axis[1], lower[2] - along * axis[2])
    ahead, beside = dot(upper, flat), dot(upper, cross(axis, flat))
    whole = math.sqrt(ahead * ahead + beside * beside)
    asked = 0.5 * (distance * distance - dot(upper, upper) - dot(lower, lower))
    asked -= along * dot(upper, axis)
    cosine = min(max(asked / whole, -1.0), 1.0)
    return _wrapped(math.atan2(beside, ahead) + math.acos(cosine))


@shared
def _wrapped(angle: float) -> float:
    if angle > math.pi:
        return angle - 2.0 * math.pi
    return angle

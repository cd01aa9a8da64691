"""One joint turns so that what it carries comes nearest to where it is asked to be.

Where tasks of a higher rank cannot be mended by another joint, it turns only about the axes that
leave them alone: one point above leaves the circle of solutions (2005, figure 11).
"""

import math
from typing import Any

from usdmotion.kernels import shared
from usdmotion.kernels.quaternions import Vector, cross, vector_at
from usdmotion.kernels.residuals import between
from usdmotion_ccd.errors import (
    ROTATION,
    along_held_rows,
    carried_factor,
    dot,
    effect,
    is_directly_held,
    left,
    length,
    lever,
    sight,
    turned_share,
)
from usdmotion_ccd.posing import turn
from usdmotion_ccd.state import SHIFT, Work

SMALL = 1e-7
"""A lever shorter than this carries nothing [m]."""
MOST = 0.5
"""Farther no step goes that was found from slopes [rad]."""


@shared
def turn_joint(work: Work, frame: int, character: int, rank: int, move: int, scale: float) -> bool:
    """Turn the joint of a move for the tasks of its rank; return whether it moved."""
    node = work.moves[0].node[move]
    barred = bar(work, frame, character, rank, move)
    # What stays where it is is not twisted for the balance.
    if barred == 3 or (barred > 0 and work.ranks[0].balances[rank]):
        return False
    alone, vector = _best(work, frame, character, rank, move, barred)
    if alone >= 0 and barred != 1:
        vector = _exactly(work, frame, character, alone, node, barred, vector)
    size = length(vector)
    most = work.settings[0].damping if work.moves[0].damped[move] else math.pi
    factor = scale * work.tree[0].freedom[node]
    if size * factor > most:
        factor = most / size
    if size * factor < 1e-12:
        return False
    turn(work, node, (factor * vector[0], factor * vector[1], factor * vector[2]))
    return True


@shared
def bar(work: Work, frame: int, character: int, rank: int, move: int) -> int:
    """Write the directions in which nothing may move; return how many they are."""
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    first = ranks.first_task[ranks.first[character]]
    count = 0
    for index in range(first, ranks.first_task[rank]):
        task = ranks.tasks[index]
        place = index - first
        if asked.on[task] and moves.affects[move, place] and not moves.mends[move, place]:
            count = _bar_task(work, frame, character, task, move, count)
    return count


@shared
def _bar_task(work: Work, frame: int, character: int, task: int, move: int, count: int) -> int:
    node = work.moves[0].node[move]
    if work.table[0].bound[task] != 0 and length(left(work, frame, task)) == 0.0:
        return count
    if work.moves[0].kind[move] == SHIFT:
        factor = carried_factor(sight(work), frame, task, node)
        rows = (factor, 0.0, 0.0, 0.0, factor, 0.0, 0.0, 0.0, factor)
        rows = along_held_rows(sight(work), frame, task, rows)
    else:
        rows = effect(work, frame, task, node)
    count = _bar_direction(work, character, (rows[0], rows[1], rows[2]), count)
    count = _bar_direction(work, character, (rows[3], rows[4], rows[5]), count)
    return _bar_direction(work, character, (rows[6], rows[7], rows[8]), count)


@shared
def _bar_direction(work: Work, character: int, way: Any, count: int) -> int:
    basis = work.asked[0].basis[character]
    x, y, z = way
    for index in range(count):
        along = dot(vector_at(basis, index), (x, y, z))
        x -= along * basis[index, 0]
        y -= along * basis[index, 1]
        z -= along * basis[index, 2]
    size = length((x, y, z))
    if count == 3 or size < max(SMALL, 1e-6 * length(way)):
        return count
    basis[count, 0], basis[count, 1], basis[count, 2] = x / size, y / size, z / size
    return count + 1


@shared
def free_axis(work: Work, character: int) -> Vector:
    """Return the one direction that two barred ones leave."""
    basis = work.asked[0].basis[character]
    return cross(vector_at(basis, 0), vector_at(basis, 1))


@shared
def _best(
    work: Work, frame: int, character: int, rank: int, move: int, barred: int
) -> tuple[int, Vector]:
    """Return the task that is driven if it is but one, and the best turn from the slopes."""
    ranks, moves, asked = work.ranks[0], work.moves[0], work.asked[0]
    first, node = ranks.first_task[ranks.first[character]], moves.node[move]
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    x, y, z = 0.0, 0.0, 0.0
    count, alone = 0, -1
    for index in range(ranks.first_task[rank], ranks.first_task[rank + 1]):
        task = ranks.tasks[index]
        place = index - first
        if not asked.on[task] or not moves.drives[move, place]:
            continue
        error = left(work, frame, task)
        missing = length(error) > work.settings[0].tolerance
        if not missing and moves.mends[move, place]:
            continue
        weight = work.table[0].weight[frame, task]
        rows = effect(work, frame, task, node)
        x += weight * (rows[0] * error[0] + rows[3] * error[1] + rows[6] * error[2])
        y += weight * (rows[1] * error[0] + rows[4] * error[1] + rows[7] * error[2])
        z += weight * (rows[2] * error[0] + rows[5] * error[1] + rows[8] * error[2])
        a += weight * (rows[0] * rows[0] + rows[3] * rows[3] + rows[6] * rows[6])
        b += weight * (rows[0] * rows[1] + rows[3] * rows[4] + rows[6] * rows[7])
        c += weight * (rows[0] * rows[2] + rows[3] * rows[5] + rows[6] * rows[8])
        d += weight * (rows[1] * rows[1] + rows[4] * rows[4] + rows[7] * rows[7])
        e += weight * (rows[1] * rows[2] + rows[4] * rows[5] + rows[7] * rows[8])
        f += weight * (rows[2] * rows[2] + rows[5] * rows[5] + rows[8] * rows[8])
        count += 1
        alone = task
    if count == 0:
        return -1, (0.0, 0.0, 0.0)
    vector = solve_turn(work, character, barred, (a, b, c, d, e, f), (x, y, z))
    size = length(vector)
    if size > MOST:
        vector = (vector[0] * MOST / size, vector[1] * MOST / size, vector[2] * MOST / size)
    return (alone if count == 1 else -1), vector


@shared
def solve_turn(work: Work, character: int, barred: int, square: Any, slope: Any) -> Vector:
    """Return the turn that makes up for the slopes, in the directions that are not barred."""
    a, b, c, d, e, f = square
    basis = work.asked[0].basis[character]
    x, y, z = slope
    trace = a + d + f + 1e-12
    for index in range(barred):
        way = vector_at(basis, index)
        along = dot(way, (x, y, z))
        x, y, z = x - along * way[0], y - along * way[1], z - along * way[2]
    if barred > 0:
        a, b, c, d, e, f = _without(work, character, barred, (a, b, c, d, e, f), trace)
    a += 1e-9 * trace
    d += 1e-9 * trace
    f += 1e-9 * trace
    p, q, r = d * f - e * e, c * e - b * f, b * e - c * d
    s, t, u = a * f - c * c, b * c - a * e, a * d - b * b
    scale = 1.0 / (a * p + b * q + c * r)
    return (
        scale * (p * x + q * y + r * z),
        scale * (q * x + s * y + t * z),
        scale * (r * x + t * y + u * z),
    )


@shared
def _without(work: Work, character: int, barred: int, square: Any, trace: float) -> Any:
    """Return P S P + trace · (1 − P), where P leaves out the barred directions."""
    a, b, c, d, e, f = square
    basis = work.asked[0].basis[character]
    for index in range(barred):
        x, y, z = vector_at(basis, index)
        u, v, w = a * x + b * y + c * z, b * x + d * y + e * z, c * x + e * y + f * z
        both = x * u + y * v + z * w + trace
        a += both * x * x - 2.0 * x * u
        b += both * x * y - x * v - y * u
        c += both * x * z - x * w - z * u
        d += both * y * y - 2.0 * y * v
        e += both * y * z - y * w - z * v
        f += both * z * z - 2.0 * z * w
    return a, b, c, d, e, f


@shared
def _exactly(
    work: Work, frame: int, character: int, task: int, node: int, barred: int, found: Any
) -> Vector:
    """Return the turn that does for one task all that a turn can, if that has a formula."""
    axis = (0.0, 0.0, 0.0)
    if barred == 2:
        axis = free_axis(work, character)
    error = left(work, frame, task)
    if work.table[0].kind[task] == ROTATION:
        share = turned_share(sight(work), frame, task, node)
        if share < 0.1:
            return (found[0], found[1], found[2])
        scale = 1.0 / share
        if barred == 2:
            scale *= dot(axis, error)
            return (scale * axis[0], scale * axis[1], scale * axis[2])
        return (scale * error[0], scale * error[1], scale * error[2])
    if not is_directly_held(work, task):
        return (found[0], found[1], found[2])
    arm = lever(sight(work), frame, task, node)
    goal = (arm[0] + error[0], arm[1] + error[1], arm[2] + error[2])
    if length(arm) < 1e-6 or length(goal) < 1e-6:
        return (0.0, 0.0, 0.0)
    if barred < 2:
        return between(arm, goal)
    side = cross(axis, arm)
    ahead = cross(side, axis)
    if length(side) < 1e-6:
        return (0.0, 0.0, 0.0)
    angle = math.atan2(dot(goal, side), dot(goal, ahead))
    return (angle * axis[0], angle * axis[1], angle * axis[2])

"""What no group of the body can do by itself all joints do together, each as little as it can.

One Newton step on the errors of the ranks above, which are to stay, and of the rank itself: the
shortest turn of all joints that makes up for them, in the metric of their stiffness.
"""

import math

from usdmotion import Floats
from usdmotion.kernels import is_slack, shared, summing, task_rows
from usdmotion.kernels.quaternions import (
    cross,
    inverse,
    product,
    quaternion,
    quaternion_at,
    turned,
    unit,
    vector_at,
)
from usdmotion_ccd.bending import SHORT, stretch
from usdmotion_ccd.errors import dot, left, length
from usdmotion_ccd.posing import place_character, within
from usdmotion_ccd.state import LIMB, Work

KEPT = 1e-5
"""Damping of what is to stay [m or rad]: as good as none."""
CURVATURE = 0.1
"""What the squared damping of the rank itself grows by, per metre of its error [m]."""
MOST = 0.3
"""Farther no joint turns in one step [rad]."""


@shared
def move_together(
    work: Work, frame: int, character: int, rank: int, own: bool, scale: float
) -> bool:
    """Move all joints at once for a rank, or only for those above it; return whether any moved."""
    ranks = work.ranks[0]
    first = ranks.first_task[ranks.first[character]]
    start = ranks.first_task[rank]
    last = ranks.first_task[rank + 1] if own else start
    count = 0
    for index in range(first, last):
        if work.asked[0].on[ranks.tasks[index]]:
            share = 0.0 if index < start else scale
            count = _add_rows(work, frame, character, ranks.tasks[index], share, count)
    if count == 0:
        return False
    return _find_step(work, character, rank, count) and _turn_all(work, character)


@shared
def _find_step(work: Work, character: int, rank: int, count: int) -> bool:
    """Write the step that makes up for the errors; return whether that is anything.

    What would straighten a limb too far is tried again with that limb as long as it may be.
    """
    ranks, moves, joint = work.ranks[0], work.moves[0], work.together[0]
    step, width = joint.step[character], joint.widths[character]
    first, last = ranks.first_move[ranks.first[character]], ranks.first_move[rank]
    for column in range(width):
        joint.fixed[character, column] = 0.0
    for move in range(first, last):
        joint.frozen[move] = moves.kind[move] != LIMB or moves.end[move] < 0
    changed = True
    while changed:
        if not _solve(work, character, count):
            return False
        for column in range(width):
            step[column] = 0.0
            for row in range(count):
                step[column] += joint.rows[character, row, column] * joint.solved[character, row]
            step[column] = joint.freedom[character, column] * step[column]
            step[column] += joint.fixed[character, column]
        changed = False
        for move in range(first, last):
            if not joint.frozen[move]:
                changed |= _freeze(work, character, move, count)
    return True


@shared
def _freeze(work: Work, character: int, move: int, count: int) -> bool:
    """Take from a limb's middle joint what would stretch it too far; return whether it would."""
    moves, pose, joint = work.moves[0], work.pose[0], work.together[0]
    column = joint.columns[moves.middle[move]]
    if column < 0:
        return False
    start = vector_at(pose.positions, moves.node[move])
    knee = vector_at(pose.positions, moves.middle[move])
    end = vector_at(pose.positions, moves.end[move])
    lower = (end[0] - knee[0], end[1] - knee[1], end[2] - knee[2])
    whole = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    size = max(length(whole), SHORT)
    axis = cross(lower, whole)
    arm = length(axis)
    if arm < SHORT * size:
        return False
    axis = (axis[0] / arm, axis[1] / arm, axis[2] / arm)
    arm /= size
    step = joint.step[character]
    turn = dot(axis, (step[column], step[column + 1], step[column + 2]))
    ratio = stretch(work, move)
    room = max(work.asked[0].stretches[move] / max(ratio, SHORT) - 1.0, 0.0) * size / arm
    if turn <= room + 1e-9:
        return False
    joint.frozen[move] = True
    for row in range(count):
        rows = joint.rows[character, row]
        along = dot(axis, (rows[column], rows[column + 1], rows[column + 2]))
        joint.errors[character, row] -= along * room
        for part in range(3):
            rows[column + part] -= along * axis[part]
    for part in range(3):
        joint.fixed[character, column + part] = room * axis[part]
    return True


@shared
def _add_rows(work: Work, frame: int, character: int, task: int, share: float, count: int) -> int:
    """Write the rows of a task; return how many there are then.

    Of what ranks above, a share of 0, all of the error is to be made up for, whatever it takes.
    """
    tree, pose, joint, kept = work.tree[0], work.pose[0], work.together[0], work.asked[0].kept
    left(work, frame, task)
    x, y, z = vector_at(work.asked[0].raw, task)
    error = (x - kept[task, 0], y - kept[task, 1], z - kept[task, 2])
    if is_slack(work.table, task, error):
        return count
    rows = joint.rows[character, count : count + 3]
    errors = joint.errors[character, count : count + 3]
    added = task_rows(
        work.table, frame, task, tree.parents, joint.translates, joint.columns,
        joint.widths[character], pose.positions, pose.orientations, error,
        rows, errors, joint.block[character],
    )  # fmt: skip
    weight, size = 1.0, 0.0
    if share > 0.0:
        weight = math.sqrt(work.table[0].weight[frame, task])
        size = math.sqrt(_dot(errors, errors, added))
    for index in range(added):
        joint.damping[character, count + index] = KEPT * KEPT + CURVATURE * size
        errors[index] *= weight * share if share > 0.0 else 1.0
        for column in range(joint.widths[character]):
            rows[index, column] *= weight * joint.freedom[character, column]
    return count + added


@shared
def _solve(work: Work, character: int, count: int) -> bool:
    """Write (J Jᵀ + λ²)⁻¹ e over the errors, by Cholesky; return whether it could be found."""
    joint = work.together[0]
    rows, errors = joint.rows[character], joint.solved[character]
    gram, width = joint.gram[character], joint.widths[character]
    for row in range(count):
        errors[row] = joint.errors[character, row]
    for row in range(count):
        for other in range(row + 1):
            gram[row, other] = _dot(rows[row], rows[other], width)
        gram[row, row] += joint.damping[character, row]
    for row in range(count):
        for other in range(row + 1):
            value = gram[row, other] - _dot(gram[row], gram[other], other)
            if row == other:
                if value <= 0.0:
                    return False
                gram[row, row] = math.sqrt(value)
            else:
                gram[row, other] = value / gram[other, other]
    for row in range(count):
        errors[row] = (errors[row] - _dot(gram[row], errors, row)) / gram[row, row]
    for row in range(count - 1, -1, -1):
        errors[row] /= gram[row, row]
        for other in range(row):
            errors[other] -= gram[row, other] * errors[row]
    return True


@shared
def _turn_all(work: Work, character: int) -> bool:
    """Compose the pose with the step; return whether that is anything."""
    tree, pose, joint = work.tree[0], work.pose[0], work.together[0]
    step = joint.step[character]
    largest = 0.0
    for column in range(joint.widths[character]):
        largest = max(largest, abs(step[column]))
    if largest < 1e-12:
        return False
    scale = min(1.0, MOST / largest)
    for index in range(tree.first[character], tree.first[character + 1]):
        node = tree.order[index]
        column = joint.columns[node]
        if column < 0:
            continue
        back = inverse(quaternion_at(pose.orientations, max(tree.parents[node], 0)))
        x, y, z = turned(back, (step[column], step[column + 1], step[column + 2]))
        turn = quaternion((scale * x, scale * y, scale * z))
        own = within(work.tree, node, unit(product(turn, quaternion_at(pose.rotations, node))))
        for axis in range(4):
            pose.rotations[node, axis] = own[axis]
        if joint.translates[node]:
            way = turned(back, (step[column + 3], step[column + 4], step[column + 5]))
            for axis in range(3):
                pose.translations[node, axis] += scale * way[axis]
    place_character(work, character)
    return True


@summing
def _dot(a: Floats, b: Floats, width: int) -> float:
    """Return the scalar product of the first numbers of two rows."""
    total = 0.0
    for column in range(width):
        total += a[column] * b[column]
    return total

"""Where a frame starts, how its pose moves, and what pulls it back to the input motion."""

import math

from usdmotion.kernels import place, shared
from usdmotion.kernels.quaternions import (
    inverse,
    product,
    quaternion,
    quaternion_at,
    quaternion_in,
    rotation_vector,
    turned,
    unit,
)
from usdmotion_prioritized_ik.continuity import (
    keep_on_course,
    preferred_rotation,
    preferred_translation,
)
from usdmotion_prioritized_ik.limits import keep_within
from usdmotion_prioritized_ik.state import Work


@shared
def recruit(work: Work, levels: int) -> None:
    """Number the columns of the nodes that can move the first levels, level by level."""
    given, table, columns = work.given[0], work.table[0], work.pose[0].columns
    for node in range(columns.shape[0]):
        columns[node] = -1
    count = work.stack[0].first_row[0]
    for level in range(levels):
        for task in range(given.first_task[level], given.first_task[level + 1]):
            if not work.asked[0].on[task]:
                continue
            for term in range(table.first_term[task], table.first_term[task + 1]):
                count = _recruit_chain(work, task, table.term_node[term], count)
            for goal in range(table.first_goal[task], table.first_goal[task + 1]):
                count = _recruit_chain(work, task, table.goal_node[goal], count)
            count = _recruit_chain(work, task, table.axes_node[task], count)
        if level == levels - 1 and level == work.carried[0].valid.shape[0] - 1:
            count = _recruit_what_goes_on(work, count)
        work.stack[0].widths[level] = count


@shared
def _recruit_chain(work: Work, task: int, node: int, count: int) -> int:
    given, recruits, columns = work.given[0], work.table[0].recruits, work.pose[0].columns
    while node >= 0:
        if columns[node] < 0 and recruits[task, node] and given.freedom[node] > 0.0:
            columns[node] = count
            count += 6 if given.translates[node] else 3
        node = given.parents[node]
    return count


@shared
def _recruit_what_goes_on(work: Work, count: int) -> int:
    """Number the nodes that no task moves now, but that cannot be where the input is at once."""
    given, settings, columns = work.given[0], work.settings[0], work.pose[0].columns
    if settings.velocity == 0.0 and settings.change == 0.0 and settings.root_change == 0.0:
        return count
    for node in range(columns.shape[0]):
        if columns[node] < 0 and given.recruited[node] and given.freedom[node] > 0.0:
            columns[node] = count
            count += 6 if given.translates[node] else 3
    return count


@shared
def start(work: Work, frame: int, carry: int) -> None:
    """Write the posture to start from: the input's, with the displacement of the frame before.

    2004, equation 4 starts from that frame's posture itself, which lags more.
    """
    motion = work.motion[0]
    given, pose, carried = work.given[0], work.pose[0], work.carried[0]
    for node in range(given.parents.shape[0]):
        moves = carried.valid[carry] and pose.columns[node] >= 0
        turn = quaternion_in(motion.rotations, frame, node)
        if moves:
            turn = unit(product(turn, quaternion_in(carried.rotations, carry, node)))
        for axis in range(4):
            pose.rotations[node, axis] = turn[axis]
        for axis in range(3):
            pose.translations[node, axis] = motion.translations[frame, node, axis]
            if moves and given.translates[node]:
                pose.translations[node, axis] += carried.translations[carry, node, axis]
    keep_on_course(work, frame)
    keep_within(work)
    place_all(work)


@shared
def carry_over(work: Work, frame: int, carry: int) -> None:
    """Keep the displacement of the pose from the input for the next frame."""
    motion = work.motion[0]
    given, pose, carried = work.given[0], work.pose[0], work.carried[0]
    carried.valid[carry] = True
    for node in range(given.parents.shape[0]):
        turn = (0.0, 0.0, 0.0, 1.0)
        if pose.columns[node] >= 0:
            back = inverse(quaternion_in(motion.rotations, frame, node))
            turn = product(back, quaternion_at(pose.rotations, node))
        for axis in range(4):
            carried.rotations[carry, node, axis] = turn[axis]
        for axis in range(3):
            carried.translations[carry, node, axis] = (
                pose.translations[node, axis] - motion.translations[frame, node, axis]
            )


@shared
def preserve(work: Work, frame: int) -> float:
    """Write the vector z of 2004, equation 1: each joint towards its angle in the input.

    Returns:
        Its largest component.
    """
    given, pose, settings = work.given[0], work.pose[0], work.settings[0]
    pull = work.stack[0].pull
    largest = 0.0
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        parent = quaternion_at(pose.orientations, given.parents[node])
        wanted = preferred_rotation(work, frame, node)
        turn = rotation_vector(product(wanted, inverse(quaternion_at(pose.rotations, node))))
        turn = turned(parent, turn)
        for axis in range(3):
            pull[column + axis] = settings.posture * turn[axis]
            largest = max(largest, abs(settings.posture * turn[axis]))
        if given.translates[node]:
            place = preferred_translation(work, frame, node)
            x = place[0] - pose.translations[node, 0]
            y = place[1] - pose.translations[node, 1]
            z = place[2] - pose.translations[node, 2]
            way = turned(parent, (x, y, z))
            for axis in range(3):
                pull[column + 3 + axis] = settings.root * way[axis]
                largest = max(largest, abs(settings.root * way[axis]))
    return largest


@shared
def largest_turn(work: Work) -> float:
    """Return the largest turn of a joint in the stack's step [rad]."""
    columns, step = work.pose[0].columns, work.stack[0].step
    square = 0.0
    for node in range(columns.shape[0]):
        column = columns[node]
        if column >= 0:
            x, y, z = step[column], step[column + 1], step[column + 2]
            square = max(square, x * x + y * y + z * z)
    return math.sqrt(square)


@shared
def move(work: Work, frame: int, scale: float) -> None:
    """Compose the pose with the stack's step, and place it in the world."""
    given, pose, step = work.given[0], work.pose[0], work.stack[0].step
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        back = inverse(quaternion_at(pose.orientations, given.parents[node]))
        turn = turned(back, (step[column], step[column + 1], step[column + 2]))
        turn = (scale * turn[0], scale * turn[1], scale * turn[2])
        rotation = unit(product(quaternion(turn), quaternion_at(pose.rotations, node)))
        for axis in range(4):
            pose.rotations[node, axis] = rotation[axis]
        if given.translates[node]:
            way = turned(back, (step[column + 3], step[column + 4], step[column + 5]))
            for axis in range(3):
                pose.translations[node, axis] += scale * way[axis]
    keep_on_course(work, frame)
    keep_within(work)
    place_all(work)


@shared
def save(work: Work) -> None:
    """Keep the pose to come back to it."""
    pose, saved = work.pose[0], work.saved[0]
    for node in range(pose.rotations.shape[0]):
        for axis in range(3):
            saved.translations[node, axis] = pose.translations[node, axis]
        for axis in range(4):
            saved.rotations[node, axis] = pose.rotations[node, axis]


@shared
def restore(work: Work) -> None:
    """Come back to the saved pose."""
    pose, saved = work.pose[0], work.saved[0]
    for node in range(pose.rotations.shape[0]):
        for axis in range(3):
            pose.translations[node, axis] = saved.translations[node, axis]
        for axis in range(4):
            pose.rotations[node, axis] = saved.rotations[node, axis]
    place_all(work)


@shared
def place_all(work: Work) -> None:
    """Place every node of the pose in the world."""
    pose = work.pose[0]
    place(
        work.given[0].parents,
        pose.translations,
        pose.rotations,
        pose.positions,
        pose.orientations,
    )

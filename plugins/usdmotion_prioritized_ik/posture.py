"""Where a frame starts, how its pose moves, and what pulls it back to the input motion."""

from usdmotion.kernels import inlined, number_columns, place, shared
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
from usdmotion_prioritized_ik.state import Work


@shared
def recruit(work: Work, levels: int) -> int:
    """Number the columns of the nodes that the first levels may move; return their count."""
    given, table, pose = work.given, work.table, work.pose
    for node in range(given.parents.shape[0]):
        pose.recruited[node] = False
        for task in range(table.kind.shape[0]):
            if table.level[task] < levels and work.asked.on[task] and table.recruits[task, node]:
                pose.recruited[node] = given.freedom[node] > 0.0
    return number_columns(pose.recruited, given.translates, pose.columns)


@shared
def start(work: Work, frame: int, carry: int) -> None:
    """Write the posture to start from: the input's, with the displacement of the frame before.

    2004, equation 4 starts from that frame's posture itself, which lags more.
    """
    given, pose, carried = work.given, work.pose, work.carried
    for node in range(given.parents.shape[0]):
        moves = carried.valid[carry] and pose.recruited[node]
        turn = quaternion_in(given.rotations, frame, node)
        if moves:
            turn = unit(product(turn, quaternion_in(carried.rotations, carry, node)))
        for axis in range(4):
            pose.rotations[node, axis] = turn[axis]
        for axis in range(3):
            pose.translations[node, axis] = given.translations[frame, node, axis]
            if moves and given.translates[node]:
                pose.translations[node, axis] += carried.translations[carry, node, axis]
    _place(work)


@shared
def carry_over(work: Work, frame: int, carry: int) -> None:
    """Keep the displacement of the pose from the input for the next frame."""
    given, pose, carried = work.given, work.pose, work.carried
    carried.valid[carry] = True
    for node in range(given.parents.shape[0]):
        turn = (0.0, 0.0, 0.0, 1.0)
        if pose.recruited[node]:
            back = inverse(quaternion_in(given.rotations, frame, node))
            turn = product(back, quaternion_at(pose.rotations, node))
        for axis in range(4):
            carried.rotations[carry, node, axis] = turn[axis]
        for axis in range(3):
            carried.translations[carry, node, axis] = (
                pose.translations[node, axis] - given.translations[frame, node, axis]
            )


@inlined
def preserve(work: Work, frame: int) -> None:
    """Write the vector z of 2004, equation 1: each joint towards its angle in the input."""
    given, pose, settings = work.given, work.pose, work.settings
    for node in range(given.parents.shape[0]):
        column = pose.columns[node]
        if column < 0:
            continue
        parent = quaternion_at(pose.orientations, given.parents[node])
        wanted = quaternion_in(given.rotations, frame, node)
        turn = rotation_vector(product(wanted, inverse(quaternion_at(pose.rotations, node))))
        turn = turned(parent, turn)
        for axis in range(3):
            pose.preserving[column + axis] = settings.posture * turn[axis]
        if given.translates[node]:
            x = given.translations[frame, node, 0] - pose.translations[node, 0]
            y = given.translations[frame, node, 1] - pose.translations[node, 1]
            z = given.translations[frame, node, 2] - pose.translations[node, 2]
            way = turned(parent, (x, y, z))
            for axis in range(3):
                pose.preserving[column + 3 + axis] = settings.root * way[axis]


@inlined
def move(work: Work, scale: float) -> None:
    """Compose the pose with the stack's step, and place it in the world."""
    given, pose, step = work.given, work.pose, work.stack.step
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
    _place(work)


@shared
def save(work: Work) -> None:
    """Keep the pose to come back to it."""
    for node in range(work.pose.rotations.shape[0]):
        for axis in range(3):
            work.saved.translations[node, axis] = work.pose.translations[node, axis]
        for axis in range(4):
            work.saved.rotations[node, axis] = work.pose.rotations[node, axis]


@shared
def restore(work: Work) -> None:
    """Come back to the saved pose."""
    for node in range(work.pose.rotations.shape[0]):
        for axis in range(3):
            work.pose.translations[node, axis] = work.saved.translations[node, axis]
        for axis in range(4):
            work.pose.rotations[node, axis] = work.saved.rotations[node, axis]
    _place(work)


@shared
def _place(work: Work) -> None:
    pose = work.pose
    place(work.given.parents, pose.translations, pose.rotations, pose.positions, pose.orientations)

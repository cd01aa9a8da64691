"""Moving the pose of a frame: only what a joint carries is placed anew."""

import math
from typing import Any

from usdmotion.kernels import Reference, shared
from usdmotion.kernels.quaternions import (
    Quaternion,
    Vector,
    interpolated,
    inverse,
    product,
    quaternion,
    quaternion_at,
    quaternion_in,
    rotation_vector,
    turned,
    unit,
    vector_at,
)
from usdmotion_ccd.state import Pose, Tree, Work


@shared
def carries(tree: Reference[Tree], node: int, other: int) -> bool:
    """Tell whether a node is another or carries it."""
    place = tree[0].enter[other]
    return bool(place >= tree[0].enter[node] and place < tree[0].leave[node])


@shared
def place_below(work: Work, node: int) -> None:
    """Place a node and what it carries in the world."""
    tree = work.tree[0]
    work.calls.place(work.tree, work.pose, tree.enter[node], tree.leave[node])


@shared
def place_character(work: Work, character: int) -> None:
    """Place all nodes of a character that matter in the world."""
    tree = work.tree[0]
    work.calls.place(work.tree, work.pose, tree.first[character], tree.first[character + 1])


def place(joints: Reference[Tree], posed: Reference[Pose], first: int, last: int) -> None:
    """Place some nodes in the world, those from `first` to before `last` in depth-first order."""
    tree, pose = joints[0], posed[0]
    for index in range(first, last):
        node = tree.order[index]
        parent = tree.parents[node]
        position = vector_at(pose.translations, node)
        turn = quaternion_at(pose.rotations, node)
        if parent >= 0:
            frame = quaternion_at(pose.orientations, parent)
            way = turned(frame, position)
            origin = vector_at(pose.positions, parent)
            position = (origin[0] + way[0], origin[1] + way[1], origin[2] + way[2])
            turn = unit(product(frame, turn))
        for axis in range(3):
            pose.positions[node, axis] = position[axis]
        for axis in range(4):
            pose.orientations[node, axis] = turn[axis]


@shared
def parent_frame(joints: Reference[Tree], posed: Reference[Pose], node: int) -> Quaternion:
    """Return the orientation of what carries a node."""
    parent = joints[0].parents[node]
    if parent < 0:
        return (0.0, 0.0, 0.0, 1.0)
    return quaternion_at(posed[0].orientations, parent)


@shared
def turn(work: Work, node: int, vector: Any) -> None:
    """Turn a joint by a world rotation vector, as far as its limits allow."""
    orient(work, node, product(quaternion(vector), quaternion_at(work.pose[0].orientations, node)))


@shared
def orient(work: Work, node: int, orientation: Any) -> None:
    """Give a joint an orientation in the world, as far as its limits allow."""
    x, y, z, w = orientation
    work.calls.orient(work.tree, work.pose, node, x, y, z, w)
    place_below(work, node)


def orient_joint(
    joints: Reference[Tree],
    posed: Reference[Pose],
    node: int,
    x: float,
    y: float,
    z: float,
    w: float,
) -> None:
    """Write the rotation of a joint that has an orientation in the world, within its limits."""
    back = inverse(parent_frame(joints, posed, node))
    own = within(joints, node, unit(product(back, (x, y, z, w))))
    for axis in range(4):
        posed[0].rotations[node, axis] = own[axis]


@shared
def shift(work: Work, node: int, way: Any) -> None:
    """Move a root by a world vector."""
    own = turned(inverse(parent_frame(work.tree, work.pose, node)), way)
    for axis in range(3):
        work.pose[0].translations[node, axis] += own[axis]
    place_below(work, node)


@shared
def within(joints: Reference[Tree], node: int, own: Any) -> Quaternion:
    """Return the rotation that is nearest to one within a joint's limits."""
    tree = joints[0]
    if not tree.limited[node]:
        return (own[0], own[1], own[2], own[3])
    rest = quaternion_at(tree.rests, node)
    vector = rotation_vector(product(inverse(rest), own))
    outside = _outside(joints, node, vector)
    square = outside[0] ** 2 + outside[1] ** 2 + outside[2] ** 2
    angle = math.sqrt(vector[0] ** 2 + vector[1] ** 2 + vector[2] ** 2)
    if square == 0.0:
        return (own[0], own[1], own[2], own[3])
    if angle > 1e-6:
        # The same rotation the other way around, where that is nearer to the box.
        factor = 1.0 - 2.0 * math.pi / angle
        long = (factor * vector[0], factor * vector[1], factor * vector[2])
        beyond = _outside(joints, node, long)
        if beyond[0] ** 2 + beyond[1] ** 2 + beyond[2] ** 2 < square:
            vector, outside = long, beyond
            if beyond[0] == 0.0 and beyond[1] == 0.0 and beyond[2] == 0.0:
                return (own[0], own[1], own[2], own[3])
    inside = (vector[0] - outside[0], vector[1] - outside[1], vector[2] - outside[2])
    return unit(product(rest, quaternion(inside)))


@shared
def _outside(joints: Reference[Tree], node: int, vector: Any) -> Vector:
    """Return the way to a rotation vector from the nearest one in its box."""
    low, high = vector_at(joints[0].low, node), vector_at(joints[0].high, node)
    return (
        min(vector[0] - low[0], 0.0) + max(vector[0] - high[0], 0.0),
        min(vector[1] - low[1], 0.0) + max(vector[1] - high[1], 0.0),
        min(vector[2] - low[2], 0.0) + max(vector[2] - high[2], 0.0),
    )


@shared
def _copy(work: Work, character: int, here: Any, turns: Any, there: Any, own: Any) -> None:
    """(N, 3), (N, 4) into (N, 3), (N, 4): the nodes of a character that matter."""
    tree = work.tree[0]
    for index in range(tree.first[character], tree.first[character + 1]):
        node = tree.order[index]
        for axis in range(3):
            there[node, axis] = here[node, axis]
        for axis in range(4):
            own[node, axis] = turns[node, axis]


@shared
def take_input(work: Work, frame: int, character: int) -> None:
    """Start from the input motion, within the limits of the joints."""
    tree, pose, given = work.tree[0], work.pose[0], work.given[0]
    here, turns = given.translations[frame], given.rotations[frame]
    _copy(work, character, here, turns, pose.translations, pose.rotations)
    for index in range(tree.first[character], tree.first[character + 1]):
        node = tree.order[index]
        if tree.limited[node]:
            own = within(work.tree, node, quaternion_at(pose.rotations, node))
            for axis in range(4):
                pose.rotations[node, axis] = own[axis]
    place_character(work, character)


@shared
def give_output(work: Work, frame: int, character: int) -> None:
    """Write the pose down."""
    pose, found = work.pose[0], work.found[0]
    there, own = found.translations[frame], found.rotations[frame]
    _copy(work, character, pose.translations, pose.rotations, there, own)


@shared
def give_rest(work: Work, frame: int, first: int, last: int) -> None:
    """Write down what nothing looks at nor moves: the input, within the limits of the joints."""
    tree, given, found = work.tree[0], work.given[0], work.found[0]
    for node in range(first, last):
        if tree.enter[node] >= 0:
            continue
        own = quaternion_at(given.rotations[frame], node)
        if tree.limited[node]:
            own = within(work.tree, node, own)
        for axis in range(3):
            found.translations[frame, node, axis] = given.translations[frame, node, axis]
        for axis in range(4):
            found.rotations[frame, node, axis] = own[axis]


@shared
def save(work: Work, character: int, slot: int) -> None:
    """Keep the pose of a character to come back to it."""
    pose, saved = work.pose[0], work.saved[0]
    there, own = saved.translations[slot], saved.rotations[slot]
    _copy(work, character, pose.translations, pose.rotations, there, own)


@shared
def restore(work: Work, character: int, slot: int) -> None:
    """Come back to a saved pose."""
    pose, saved = work.pose[0], work.saved[0]
    here, turns = saved.translations[slot], saved.rotations[slot]
    _copy(work, character, here, turns, pose.translations, pose.rotations)
    place_character(work, character)


@shared
def mix(work: Work, character: int, one: int, other: int, share: float) -> None:
    """Take the pose between two saved ones, joint by joint."""
    tree, pose, saved = work.tree[0], work.pose[0], work.saved[0]
    for index in range(tree.first[character], tree.first[character + 1]):
        node = tree.order[index]
        for axis in range(3):
            start = saved.translations[one, node, axis]
            end = saved.translations[other, node, axis]
            pose.translations[node, axis] = start + share * (end - start)
        own = quaternion_in(saved.rotations, one, node)
        to = quaternion_in(saved.rotations, other, node)
        if own[0] != to[0] or own[1] != to[1] or own[2] != to[2] or own[3] != to[3]:
            own = interpolated(own, to, share)
        for axis in range(4):
            pose.rotations[node, axis] = own[axis]
    place_character(work, character)

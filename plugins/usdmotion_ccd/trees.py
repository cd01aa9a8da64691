"""The joints that matter, in depth-first order, so that what one carries stands together."""

from collections.abc import Sequence

import numpy as np

from usdmotion import Bools, Ints, Problem
from usdmotion.kernels import Kind, TaskTable, limit_boxes
from usdmotion_ccd.anatomy import Limb
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import Tree


def make_tree(problem: Problem, plan: Schedule, limbs: Sequence[Limb]) -> Tree:
    """Return the joints that tasks look at or move, each character's in depth-first order.

    A limb that is looked at is a whole one, so that no other task makes it another limb.
    """
    cast, table = problem.cast, problem.table
    wanted = np.zeros(cast.node_count, dtype=np.bool_)
    for nodes in (table.term_node, table.goal_node, table.axes_node):
        wanted[nodes[nodes >= 0]] = True
    _children(cast.parents, wanted)
    for limb in limbs:
        wanted[limb.end] |= wanted[limb.middle]
    children = _children(cast.parents, wanted)
    order, first, enter, leave = _in_depth(children, wanted, plan)
    moves = problem.recruited & (cast.stiffness < 1.0)
    limited = moves & ((cast.limits_min > -180.0) | (cast.limits_max < 180.0)).any(axis=1)
    low, high = limit_boxes(cast.limits_min, cast.limits_max)
    return Tree(
        # As copies, because Numba compiles for arrays that cannot be written once more.
        parents=np.array(cast.parents),
        order=order,
        first=first,
        enter=enter,
        leave=leave,
        freedom=1.0 - cast.stiffness,
        limited=limited,
        rests=np.array(cast.rest_rotations),
        low=low,
        high=high,
    )


def _children(parents: Ints, wanted: Bools) -> list[list[int]]:
    """Return the wanted nodes that each carries; whoever carries one is wanted from now on."""
    children: list[list[int]] = [[] for _ in parents]
    for node in range(len(parents) - 1, -1, -1):
        if parents[node] >= 0 and wanted[node]:
            wanted[parents[node]] = True
            children[parents[node]].append(node)
    return children


def _in_depth(
    children: Sequence[Sequence[int]], wanted: Bools, plan: Schedule
) -> tuple[Ints, Ints, Ints, Ints]:
    """Return `Tree.order`, `Tree.first`, `Tree.enter` and `Tree.leave`."""
    order: list[int] = []
    first = [0]
    enter = np.full(len(children), -1, dtype=np.int64)
    leave = np.full(len(children), -1, dtype=np.int64)
    for space in plan.first_node[:-1].tolist():
        stack = [space] if wanted[space] else []
        while stack:
            node = stack.pop()
            enter[node] = len(order)
            order.append(node)
            stack += children[node]
        first.append(len(order))
    for node in reversed(order):
        leave[node] = max([enter[node] + 1, *(leave[each] for each in children[node])])
    return np.array(order, dtype=np.int64), np.array(first, dtype=np.int64), enter, leave


def seen_nodes(table: TaskTable, task: int) -> Ints:
    """Return the nodes whose movement changes what a task measures."""
    terms = table.term_node[table.first_term[task] : table.first_term[task + 1]]
    goals = table.goal_node[table.first_goal[task] : table.first_goal[task + 1]]
    if table.kind[task] == Kind.ROTATION:
        terms = terms[:1]
    nodes = np.concatenate([terms, goals, table.axes_node[task : task + 1]])
    return np.asarray(nodes[nodes >= 0])

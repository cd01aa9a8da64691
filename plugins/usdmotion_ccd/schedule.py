"""Who is solved when: the characters of a frame in groups that do not look at each other (2005)."""

from collections.abc import Iterable, Sequence
from heapq import heapify, heappop, heappush
from typing import NamedTuple

import numpy as np

from usdmotion import Bools, Ints
from usdmotion.kernels import TaskTable

SWEEPS = 2
"""How often those are visited on one frame who look at each other in a circle."""


class Schedule(NamedTuple):
    """The visits of a frame: C characters, V visits, G groups.

    The visits of a group follow one another. Groups have nothing to do with each other, so that
    they can be visited side by side, in any order.
    """

    first_node: Ints
    """(C + 1,) the nodes of character c are first_node[c] to first_node[c + 1]."""
    first_task: Ints
    """(C + 1,) the tasks of character c are tasks[first_task[c]] to tasks[first_task[c + 1]]."""
    tasks: Ints
    """(T,) rows of the table, character by character, of each in rank order."""
    first_visit: Ints
    """(G + 1,) the visits of group g are visits[first_visit[g]] to visits[first_visit[g + 1]]."""
    visits: Ints
    """(V,) the character that is solved; who is looked at comes before who looks."""


def schedule(parents: Ints, table: TaskTable) -> Schedule:
    """Return the schedule of what is asked of some characters.

    Those who look at each other in a circle are visited in the order of the cast, and then once
    more: the first of them sees the others as they are before they are solved.

    Args:
        parents: Index of each node's parent, -1 for the space of a character, shape (node_count,).
        table: What is asked.
    """
    spaces = np.flatnonzero(parents < 0)
    character = np.cumsum(parents < 0) - 1
    owners = [_owner(table, task, character) for task in range(len(table.kind))]
    looks: list[set[int]] = [set() for _ in spaces]
    for task, owner in enumerate(owners):
        looks[owner] |= set(character[_seen(table, task)].tolist()) - {owner}
    groups, circles = _components(looks)
    visits: list[list[int]] = [[] for _ in range(max(groups, default=-1) + 1)]
    for circle in _in_order(circles, looks):
        visits[groups[circle[0]]] += circle * (SWEEPS if len(circle) > 1 else 1)
    counts = np.bincount(owners, minlength=len(spaces)) if owners else np.zeros(len(spaces), int)
    return Schedule(
        first_node=np.append(spaces, len(parents)).astype(np.int64),
        first_task=_starts(counts),
        tasks=np.argsort(owners, kind="stable").astype(np.int64),
        first_visit=_starts(map(len, visits)),
        visits=np.array([each for group in visits for each in group], dtype=np.int64),
    )


def _owner(table: TaskTable, task: int, character: Ints) -> int:
    """Return who a task is for: the one with its effector, unless it may move only another."""
    effector = int(character[table.term_node[table.first_term[task]]])
    moved: Bools = table.recruits[task]
    if moved[character == effector].any() or not moved.any():
        return effector
    return int(character[moved.argmax()])


def _seen(table: TaskTable, task: int) -> Ints:
    """Return the nodes that what is asked depends on."""
    terms = table.term_node[table.first_term[task] : table.first_term[task + 1]]
    goals = table.goal_node[table.first_goal[task] : table.first_goal[task + 1]]
    nodes = np.concatenate([terms, goals, table.axes_node[task : task + 1]])
    return nodes[nodes >= 0]


def _components(looks: Sequence[set[int]]) -> tuple[list[int], list[int]]:
    """Return the group of each character, and the circle that it looks at others in."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = [(one, other) for one, others in enumerate(looks) for other in others]
    rows, columns = (np.array([pair[side] for pair in ends], dtype=np.int64) for side in (0, 1))
    graph = coo_array((np.ones(len(ends)), (rows, columns)), shape=(len(looks), len(looks)))
    _, groups = connected_components(graph, connection="weak")
    _, circles = connected_components(graph, connection="strong")
    return groups.tolist(), circles.tolist()


def _in_order(circles: Sequence[int], looks: Sequence[set[int]]) -> Iterable[list[int]]:
    """Yield each circle after those that it looks at, else in the order of the cast."""
    members: dict[int, list[int]] = {}
    for one, circle in enumerate(circles):
        members.setdefault(circle, []).append(one)
    waits = {
        circle: {circles[other] for one in ones for other in looks[one]} - {circle}
        for circle, ones in members.items()
    }
    watchers: dict[int, list[int]] = {circle: [] for circle in members}
    for circle, others in waits.items():
        for other in others:
            watchers[other].append(circle)
    ready = [(ones[0], circle) for circle, ones in members.items() if not waits[circle]]
    heapify(ready)
    while ready:
        _, circle = heappop(ready)
        yield members[circle]
        for watcher in watchers[circle]:
            waits[watcher].discard(circle)
            if not waits[watcher]:
                heappush(ready, (members[watcher][0], watcher))


def _starts(counts: Iterable[int]) -> Ints:
    return np.cumsum([0, *counts], dtype=np.int64)

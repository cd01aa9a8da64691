"""What each rank of each character may do to a pose, and in which order it is tried."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from usdmotion import Bools, Problem
from usdmotion.kernels import Kind
from usdmotion_ccd.anatomy import Group, Limb, anatomy
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import LIMB, SHIFT, TURN
from usdmotion_ccd.trees import make_tree, seen_nodes

FEW = 4
"""A sum of more points than this is a centre of mass."""
TRIFLE = 0.04
"""A joint that carries less than this share of the mass does nothing for the balance."""
_TURNS = (int(Kind.ROTATION), int(Kind.AIM))


@dataclass(eq=False)
class Move:
    """One row of `Moves` while it is being made."""

    kind: int
    node: int
    tasks: Sequence[int]
    """Those of its rank that it works for."""
    limb: Limb | None = None
    cover: int = -1
    """Place of the limb among the moves of the rank that does as well."""
    nodes: set[int] = field(default_factory=set)
    """The joints that it turns."""
    mending: set[int] = field(default_factory=set)
    """Those of its tasks that it makes up for where another move disturbs them."""
    key: tuple[int, ...] = ()
    """The order in which it is tried."""


class Planner:
    """Makes the moves of a problem, character by character."""

    def __init__(self, problem: Problem, plan: Schedule) -> None:
        self.cast, self.table, self.plan = problem.cast, problem.table, plan
        self.body = anatomy(problem.cast)
        self.tree = make_tree(problem, plan, self.body.limbs)
        self.seen = [seen_nodes(self.table, task) for task in range(len(self.table.kind))]
        self.limbs = {limb.node: limb for limb in self.body.limbs}
        self._bends: dict[int, bool] = {}

    def carries(self, node: int, task: int) -> bool:
        """Tell whether a turn of a node changes what a task measures."""
        places = self.tree.enter[self.seen[task]]
        inside = (places >= self.tree.enter[node]) & (places < self.tree.leave[node])
        return bool(inside.any())

    def affects(self, move: Move, task: int) -> bool:
        """Tell whether a move changes what a task measures."""
        if move.kind == SHIFT and self.table.kind[task] == Kind.ROTATION:
            return False
        return self.carries(move.node, task)

    def ends(self, move: Move, task: int) -> bool:
        """Tell whether a task can be met by turning the end of a limb."""
        if move.limb is None or self.table.kind[task] not in _TURNS:
            return False
        end, node = move.limb.end, self.table.term_node[self.table.first_term[task]]
        return bool(self.table.recruits[task, end]) and self.is_below(end, int(node))

    def is_below(self, node: int, other: int) -> bool:
        """Tell whether a node carries another."""
        enter = self.tree.enter
        return bool(enter[node] >= 0 and enter[node] <= enter[other] < self.tree.leave[node])

    def moves_of(self, tasks: Sequence[int]) -> list[Move]:
        """Return the moves of the tasks of one rank in the order in which they are tried."""
        recruited = self.table.recruits[list(tasks)].any(axis=0) & (self.tree.enter >= 0)
        recruited &= self.tree.freedom > 0.0
        moves: list[Move] = []
        for node in np.flatnonzero(recruited).tolist():
            moves += self._moves_at(node, tasks, recruited)
        balances = self.balances(tasks)
        for move in moves:
            move.key = self._key(move, balances)
            move.mending = {task for task in move.tasks if self._mends(move, task)}
        moves.sort(key=lambda move: move.key)
        for place, move in enumerate(moves):
            for other in moves:
                if move.kind == LIMB and other.kind == TURN and other.node in move.nodes:
                    if set(other.tasks) <= set(move.tasks):
                        other.cover = place
        return moves

    def balances(self, tasks: Sequence[int]) -> bool:
        """Tell whether all of some tasks are about a centre of mass."""
        return all(len(self.seen[task]) > FEW for task in tasks)

    def is_coupled(self, tasks: Sequence[int], moves: Sequence[Move]) -> bool:
        """Tell whether some tasks ask more of a limb than one of them alone, or its end, does."""
        limbs = [move for move in moves if move.kind == LIMB]
        return any(
            self.affects(limb, task) and task not in limb.tasks and not self.ends(limb, task)
            for limb in limbs
            for task in tasks
        )

    def _moves_at(self, node: int, tasks: Sequence[int], recruited: Bools) -> list[Move]:
        """Return the moves that start at a node."""
        table = self.table
        own = [task for task in tasks if table.recruits[task, node] and self.carries(node, task)]
        weighs = [task for task in own if self._weighs(node, task)]
        moves = [Move(TURN, node, weighs, nodes={node})] if weighs else []
        limb = self.limbs.get(node)
        if limb and recruited[limb.middle]:
            bent = [task for task in own if self.is_bent_for(limb, task)]
            same = self.cast.priorities[node] == self.cast.priorities[limb.middle]
            if bent and same:
                moves.append(Move(LIMB, node, bent, limb, nodes={node, limb.middle}))
        if self.cast.translates[node]:
            placed = [task for task in own if table.kind[task] not in _TURNS]
            if placed:
                moves.append(Move(SHIFT, node, placed))
        return moves

    def _weighs(self, node: int, task: int) -> bool:
        """Tell whether what a node carries is more than a trifle to a centre of mass."""
        seen = self.seen[task]
        if len(seen) <= FEW:
            return True
        nodes = np.unique(seen)
        carried = [self.is_below(node, int(at)) for at in nodes]
        masses = self.cast.masses[nodes]
        return bool(masses[carried].sum() >= TRIFLE * masses.sum())

    def bends(self, task: int) -> bool:
        """Tell whether any limb is bent for a task."""
        if task not in self._bends:
            first, last = self.table.first_term[task : task + 2]
            above = {each for at in self.table.term_node[first:last] for each in self.above(at)}
            limbs = (self.limbs[node] for node in above if node in self.limbs)
            self._bends[task] = any(self.is_bent_for(limb, task) for limb in limbs)
        return self._bends[task]

    def above(self, node: int) -> Iterator[int]:
        """Yield a node and all that carry it."""
        while node >= 0:
            yield int(node)
            node = int(self.cast.parents[node])

    def _mends(self, move: Move, task: int) -> bool:
        """Tell whether a move is what makes up for disturbances of a task."""
        if self.table.kind[task] in _TURNS:
            return move.kind == TURN and bool(self.body.groups[move.node] != Group.TRUNK)
        if move.kind == SHIFT:
            return not self.bends(task)
        return move.kind == LIMB

    def is_bent_for(self, limb: Limb, task: int) -> bool:
        """Tell whether a task is about one point that goes with the second segment of a limb."""
        table = self.table
        terms = range(table.first_term[task], table.first_term[task + 1])
        if table.kind[task] in _TURNS or len(terms) > FEW or not table.recruits[task, limb.middle]:
            return False
        carried = [term for term in terms if self.is_below(limb.node, int(table.term_node[term]))]
        if len(carried) != 1 or not self.is_below(limb.middle, int(table.term_node[carried[0]])):
            return False
        apart = np.linalg.norm(table.term_point[:, carried[0]], axis=-1).max() > 1e-3
        return bool(apart) or int(table.term_node[carried[0]]) != limb.middle

    def _key(self, move: Move, balances: bool) -> tuple[int, ...]:
        """Lower priorities first, then group by group, from the extremity to the root."""
        cast, body = self.cast, self.body
        if move.kind == SHIFT:
            return (-(2**31) if balances else 2**31, 0, 0, 0, move.node)
        group = int(body.groups[move.node])
        priority, depth = int(cast.priorities[move.node]), int(body.depths[move.node])
        return (priority, group, int(move.kind != LIMB), -depth, move.node)

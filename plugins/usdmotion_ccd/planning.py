"""What each rank of each character may do to a pose, and in which order it is tried."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from usdmotion import Bools, Floats, Ints, Problem
from usdmotion.kernels import Kind
from usdmotion_ccd.anatomy import Group, Limb, anatomy
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import LIMB, SHIFT, TURN, Moves, Ranks, Tree
from usdmotion_ccd.trees import make_tree, seen_nodes

FEW = 4
"""A sum of more points than this is a centre of mass."""
TRIFLE = 0.04
"""A joint that carries less than this share of the mass does nothing for the balance."""
_TURNS = (Kind.ROTATION, Kind.AIM)


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
    key: tuple[int, ...] = ()
    """The order in which it is tried."""


class Planner:
    """Makes the moves of a problem, character by character."""

    def __init__(self, problem: Problem, plan: Schedule) -> None:
        self.cast, self.table, self.plan = problem.cast, problem.table, plan
        self.tree = make_tree(problem, plan)
        self.body = anatomy(problem.cast)
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
        start, end = self.table.first_term[task], self.table.first_term[task + 1]
        shares = np.abs(self.table.term_coefficient[0, start:end])
        carried = [self.is_below(node, int(at)) for at in self.table.term_node[start:end]]
        return bool(shares[carried].sum() >= TRIFLE)

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

    def is_bent_for(self, limb: Limb, task: int) -> bool:
        """Tell whether a task is about one point that goes with the second segment of a limb."""
        table = self.table
        terms = range(table.first_term[task], table.first_term[task + 1])
        if table.kind[task] in _TURNS or len(terms) > FEW or not table.recruits[task, limb.middle]:
            return False
        carried = [term for term in terms if self.is_below(limb.node, int(table.term_node[term]))]
        if len(carried) != 1 or not self.is_below(limb.middle, int(table.term_node[carried[0]])):
            return False
        apart = np.linalg.norm(table.term_point[0, carried[0]]) > 1e-3
        return bool(apart) or int(table.term_node[carried[0]]) != limb.middle

    def _key(self, move: Move, balances: bool) -> tuple[int, ...]:
        """Lower priorities first, then group by group, from the extremity to the root."""
        cast, body = self.cast, self.body
        if move.kind == SHIFT:
            return (-(2**31) if balances else 2**31, 0, 0, 0, move.node)
        group = int(body.groups[move.node])
        priority, depth = int(cast.priorities[move.node]), int(body.depths[move.node])
        return (priority, group, int(move.kind != LIMB), -depth, move.node)


def plan_moves(problem: Problem, plan: Schedule) -> tuple[Tree, Ranks, Moves]:
    """Return the joints, the ranks and the moves of a problem."""
    planner = Planner(problem, plan)
    level = problem.table.level
    first, first_task, first_move, balances = [0], [0], [0], []
    groups: list[list[tuple[list[int], list[Move]]]] = []
    for start, end in zip(plan.first_task, plan.first_task[1:], strict=False):
        tasks = plan.tasks[start:end].tolist()
        ranks = []
        for each in sorted({int(level[task]) for task in tasks}):
            own = [task for task in tasks if level[task] == each]
            ranks.append((own, planner.moves_of(own)))
            first_task.append(first_task[-1] + len(own))
            first_move.append(first_move[-1] + len(ranks[-1][1]))
            balances.append(planner.balances(own))
        first.append(first[-1] + len(ranks))
        groups.append(ranks)
    ranks_ = Ranks(
        first=np.array(first),
        first_task=np.array(first_task),
        tasks=np.array(plan.tasks),
        first_move=np.array(first_move),
        balances=np.array(balances, dtype=np.bool_),
    )
    return planner.tree, ranks_, _tabulate(planner, groups)


def _tabulate(planner: Planner, groups: list[list[tuple[list[int], list[Move]]]]) -> Moves:
    """Return the moves of all ranks of all characters as arrays."""
    most = max((sum(len(own) for own, _ in ranks) for ranks in groups), default=0)
    count = sum(len(moves) for ranks in groups for _, moves in ranks)
    flags = {name: np.zeros((count, most), dtype=np.bool_) for name in _PAIRS}
    shares = np.ones((count, most))
    rows: list[Move] = []
    covers: list[int] = []
    for ranks in groups:
        tasks = [task for own, _ in ranks for task in own]
        rank_of = [index for index, (own, _) in enumerate(ranks) for _ in own]
        for _, moves in ranks:
            start = len(rows)
            for move in moves:
                at = len(rows)
                rows.append(move)
                covers.append(start + move.cover if move.cover >= 0 else -1)
                for place, task in enumerate(tasks):
                    flags["affects"][at, place] = planner.affects(move, task)
                    flags["drives"][at, place] = task in move.tasks
                    flags["ends"][at, place] = planner.ends(move, task)
                    others = ranks[rank_of[place]][1]
                    mended = (_mends(move, each, task, planner) for each in others)
                    flags["mends"][at, place] = any(mended)
                    if move.kind == LIMB and task in move.tasks:
                        later = [e for e in moves if e.kind == LIMB and task in e.tasks]
                        shares[at, place] = 1.0 / (len(later) - later.index(move))
    return _columns(planner, rows, covers, flags, shares)


_PAIRS = ("affects", "drives", "mends", "ends")


def _mends(move: Move, other: Move, task: int, planner: Planner) -> bool:
    """Tell whether another move makes up for what a move does to a task."""
    if task not in other.tasks or not _repairs(other, planner, task):
        return False
    if (move.kind == SHIFT) != (other.kind == SHIFT):
        return True
    if move.kind == SHIFT:
        return False
    return not move.nodes & other.nodes


def _repairs(move: Move, planner: Planner, task: int) -> bool:
    """Tell whether a move is what makes up for disturbances of a task."""
    kind = planner.table.kind[task]
    if kind in _TURNS:
        return move.kind == TURN and planner.body.groups[move.node] != Group.TRUNK
    if move.kind == LIMB:
        return True
    if move.kind == TURN:
        return False
    return not planner.bends(task)


def _columns(
    planner: Planner, rows: list[Move], covers: list[int], flags: dict[str, Bools], shares: Floats
) -> Moves:
    body = planner.body
    limbs = [row.limb for row in rows]
    hinges = [limb.hinge if limb else np.zeros(3) for limb in limbs]
    in_limb = {n for limb in body.limbs for n in (limb.node, limb.middle, limb.end)}

    def ints(values: object) -> Ints:
        return np.array(list(values), dtype=np.int64)  # type: ignore[call-overload]

    def bools(values: object) -> Bools:
        return np.array(list(values), dtype=np.bool_)  # type: ignore[call-overload]

    return Moves(
        kind=ints(row.kind for row in rows),
        node=ints(row.node for row in rows),
        middle=ints(limb.middle if limb else -1 for limb in limbs),
        end=ints(limb.end if limb and planner.tree.enter[limb.end] >= 0 else -1 for limb in limbs),
        hinge=np.array(hinges).reshape(-1, 3),
        damped=bools(row.kind == TURN and row.node not in in_limb for row in rows),
        steady=bools(limb is not None and body.groups[limb.node] == Group.LEGS for limb in limbs),
        repairs=bools(any(_repairs(row, planner, task) for task in row.tasks) for row in rows),
        limb=ints(covers),
        shares=shares,
        **flags,
    )

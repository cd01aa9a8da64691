"""All that a solve needs on the way, made beforehand: no frame allocates anything."""

import numpy as np

from usdmotion import Problem
from usdmotion.kernels import TaskTable, apart
from usdmotion_ccd.errors import measure, slope
from usdmotion_ccd.posing import orient_joint, place
from usdmotion_ccd.schedule import Schedule
from usdmotion_ccd.state import (
    Asked,
    Calls,
    Clip,
    Parts,
    Pose,
    Saved,
    Settings,
    Together,
    Told,
    Tree,
)
from usdmotion_ccd.tabulating import plan_moves


def make_parts(problem: Problem, plan: Schedule, settings: Settings) -> Parts:
    """Return a solve's input, and room for all that it needs on the way."""
    cast, table = problem.cast, problem.table
    tree, ranks, moves = plan_moves(problem, plan)
    frames, nodes = cast.frame_count, cast.node_count
    characters, count = len(plan.first_node) - 1, len(moves.kind)
    found = Clip(np.array(cast.translations), np.array(cast.rotations))
    told = Told(*(np.zeros((frames, characters), dtype=np.int64) for _ in range(2)))
    pose = Pose(*(np.zeros((nodes, size)) for size in (3, 4, 3, 4)))
    asked = make_asked(nodes, len(table.kind), characters, count)
    return (
        table,
        Clip(np.array(cast.translations), np.array(cast.rotations)),
        found,
        told,
        tree,
        ranks,
        moves,
        settings,
        pose,
        Saved(np.zeros((3, nodes, 3)), np.zeros((3, nodes, 4))),
        asked,
        make_together(problem, tree, plan, count),
        make_calls(table, tree, pose, asked),
    )


def make_calls(table: TaskTable, tree: Tree, pose: Pose, asked: Asked) -> Calls:
    """Return what is called from many places, compiled."""
    sight = (table, tree, pose, asked)
    return Calls(
        measure=apart(measure, seen=sight),
        slope=apart(slope, seen=sight),
        place=apart(place, joints=tree, posed=pose),
        orient=apart(orient_joint, joints=tree, posed=pose),
    )


def make_asked(nodes: int, tasks: int, characters: int, moves: int) -> Asked:
    """Return room for what is known of the tasks."""
    return Asked(
        on=np.zeros(tasks, dtype=np.bool_),
        base=np.zeros((tasks, 3)),
        kept=np.zeros((tasks, 3)),
        free=np.zeros((tasks, 3)),
        pinned=np.zeros(nodes, dtype=np.bool_),
        gains=np.ones(moves),
        raw=np.zeros((tasks, 3)),
        left=np.zeros((tasks, 3)),
        slopes=np.zeros((tasks, 9)),
        shifted=np.zeros((moves, 3)),
        stretches=np.ones(moves),
        basis=np.zeros((characters, 3, 3)),
    )


def make_together(problem: Problem, tree: Tree, plan: Schedule, count: int) -> Together:
    """Return room for the steps of all joints."""
    cast, freedom = problem.cast, tree.freedom
    moves = problem.recruited & (tree.enter >= 0) & (freedom > 0.0)
    columns = np.full(cast.node_count, -1, dtype=np.int64)
    characters = len(plan.first_node) - 1
    widths = np.zeros(characters, dtype=np.int64)
    owner = np.cumsum(cast.parents < 0) - 1
    sizes = np.where(cast.translates, 6, 3)
    for node in np.flatnonzero(moves).tolist():
        columns[node] = widths[owner[node]]
        widths[owner[node]] += sizes[node]
    width = int(widths.max(initial=1))
    each = np.ones((characters, width))
    for node in np.flatnonzero(moves).tolist():
        each[owner[node], columns[node] : columns[node] + sizes[node]] = freedom[node]
    rows = 3 * int(np.diff(plan.first_task).max(initial=1))
    return Together(
        translates=np.array(cast.translates),
        columns=columns,
        widths=widths,
        freedom=each,
        rows=np.zeros((characters, rows, width)),
        errors=np.zeros((characters, rows)),
        solved=np.zeros((characters, rows)),
        fixed=np.zeros((characters, width)),
        frozen=np.zeros(count, dtype=np.bool_),
        damping=np.zeros((characters, rows)),
        gram=np.zeros((characters, rows, rows)),
        block=np.zeros((characters, 3, width)),
        step=np.zeros((characters, width)),
    )

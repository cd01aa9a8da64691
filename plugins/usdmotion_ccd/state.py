"""What the kernels of this solver pass around.

F frames, N nodes, T tasks, C characters, M tasks of the character that has most; ranks and moves
are numbered through, character by character.
"""

from collections.abc import Callable
from typing import NamedTuple

from usdmotion import Bools, Floats, Ints
from usdmotion.kernels import Reference, TaskTable


class Clip(NamedTuple):
    """The poses of some frames."""

    translations: Floats
    """(F, N, 3) in the parent's frame."""
    rotations: Floats
    """(F, N, 4) in the parent's frame."""


SETTLED, LIMIT = 1, 2
"""Why a solve was left: nothing came nearer any more, or a rank had all its iterations."""


class Told(NamedTuple):
    """What a solve says of itself."""

    iterations: Ints
    """(F, C) how many were spent on each character."""
    stops: Ints
    """(F, C) why each was left, `SETTLED` or `LIMIT`."""


class Tree(NamedTuple):
    """The joints: who carries whom, and how far they turn."""

    parents: Ints
    """(N,)"""
    order: Ints
    """(R,) the nodes that a task looks at or moves, in depth-first order, parents first."""
    first: Ints
    """(C + 1,) those of character c are order[first[c]] to order[first[c + 1]]."""
    enter: Ints
    """(N,) where a node stands in `order`, -1 for nowhere."""
    leave: Ints
    """(N,) end of what it carries in `order`."""
    freedom: Floats
    """(N,) 1 − stiffness: the share of a turn that it makes."""
    limited: Bools
    """(N,) whether its turns have limits."""
    rests: Floats
    """(N, 4) orientation at rest, from which turns are measured, in the parent's frame."""
    low: Floats
    """(N, 3) least rotation vector from rest [rad]."""
    high: Floats
    """(N, 3) greatest one [rad]."""


class Ranks(NamedTuple):
    """The tasks and the moves of each rank of each character."""

    first: Ints
    """(C + 1,) the ranks of character c are first[c] to first[c + 1]."""
    first_task: Ints
    """(X + 1,) the tasks of rank x are tasks[first_task[x]] to tasks[first_task[x + 1]]."""
    tasks: Ints
    """(T,) rows of the table, character by character, of each in rank order."""
    first_move: Ints
    """(X + 1,) the moves of rank x are first_move[x] to first_move[x + 1]."""
    balances: Bools
    """(X,) whether the rank asks for nothing but the centre of mass."""
    coupled: Bools
    """(X,) whether it asks more of a limb than that can do joint by joint."""


class Moves(NamedTuple):
    """What a rank may do to a pose, in the order in which it is tried.

    The tasks of a move's character are counted from the character's first one.
    """

    kind: Ints
    """(B,) `TURN`, `LIMB` or `SHIFT`."""
    node: Ints
    """(B,) the joint that turns; of a limb the first one; the root."""
    middle: Ints
    """(B,) the second joint of a limb."""
    end: Ints
    """(B,) where a limb ends."""
    hinge: Floats
    """(B, 3) axis about which a limb bends, in the frame of its first joint."""
    damped: Bools
    """(B,) whether one iteration turns it only so far."""
    steady: Bools
    """(B,) whether a limb keeps the orientation of its end, if that may turn: feet do."""
    repairs: Bools
    """(B,) whether it is used to make up for what another move did to the rank."""
    limb: Ints
    """(B,) the limb that does as well whatever a turn could, -1 for none."""
    top: Ints
    """(B,) the first rank of its character that it disturbs."""
    affects: Bools
    """(B, M) whether it changes what a task measures."""
    drives: Bools
    """(B, M) whether it works for a task of its rank."""
    mends: Bools
    """(B, M) whether another move of the task's own rank can make up for it."""
    ends: Bools
    """(B, M) whether a task can be met by turning the end of a limb."""
    shares: Floats
    """(B, M) what a limb makes up for of an error that several limbs can move."""


TURN, LIMB, SHIFT = 0, 1, 2


class Settings(NamedTuple):
    """The solver's options, as numbers."""

    iterations: int
    tolerance: float
    damping: float
    settled: float
    shift_after: int
    stretch: float


class Pose(NamedTuple):
    """The pose of the frame that is being solved."""

    translations: Floats
    """(N, 3) in the parent's frame."""
    rotations: Floats
    """(N, 4) in the parent's frame."""
    positions: Floats
    """(N, 3) in the world, of the nodes in `Tree.order`."""
    orientations: Floats
    """(N, 4) in the world, of the same."""


class Saved(NamedTuple):
    """Poses to come back to: before a move, without and with what eases in."""

    translations: Floats
    """(3, N, 3)"""
    rotations: Floats
    """(3, N, 4)"""


class Asked(NamedTuple):
    """Which tasks take part, and what is known of them."""

    on: Bools
    """(T,)"""
    base: Floats
    """(T, 3) the error that a task is to leave, so that it is let go."""
    kept: Floats
    """(T, 3) the same, and where its rank was solved and it is out of reach, what was left."""
    free: Floats
    """(T, 3) what is left without what eases in."""
    pinned: Bools
    """(N,) nodes that a rank above holds in place."""
    gains: Floats
    """(B,) how much of a shift of the root arrives."""
    raw: Floats
    """(T, 3) what is asked of each less what is, when it was last measured."""
    left: Floats
    """(T, 3) what each still asks for, when it was last measured."""
    slopes: Floats
    """(T, 9) how that decreases with a turn of a joint, when that was last asked: three rows."""
    shifted: Floats
    """(B, 3) the error that the last shift was for, zero for none."""
    stretches: Floats
    """(B,) how far a limb of a rank above may be stretched, against its segments."""
    basis: Floats
    """(C, 3, 3) scratch."""


class Together(NamedTuple):
    """Room for a step of all joints: R rows at most, D degrees of freedom of one character."""

    translates: Bools
    """(N,)"""
    columns: Ints
    """(N,) first degree of freedom of each joint that may move, -1 for the others."""
    widths: Ints
    """(C,) how many there are."""
    freedom: Floats
    """(C, D) 1 − stiffness of the joint of each."""
    rows: Floats
    """(C, R, D)"""
    errors: Floats
    """(C, R)"""
    solved: Floats
    """(C, R)"""
    fixed: Floats
    """(C, D) the part of the step that is decided, of limbs that would be stretched too far."""
    frozen: Bools
    """(B,) whether a move is no limb, or one of those."""
    damping: Floats
    """(C, R) squared."""
    gram: Floats
    """(C, R, R)"""
    block: Floats
    """(C, 3, D) scratch."""
    step: Floats
    """(C, D)"""


class Sight(NamedTuple):
    """What tells how a task stands."""

    table: Reference[TaskTable]
    tree: Reference[Tree]
    pose: Reference[Pose]
    asked: Reference[Asked]


Measure = Callable[[Sight, int, int], None]
"""`measure`, handed over."""
Slope = Callable[[Sight, int, int, int], None]
"""`slope`, handed over."""
Place = Callable[[Reference[Tree], Reference[Pose], int, int], None]
"""`place`, handed over."""
Orient = Callable[[Reference[Tree], Reference[Pose], int, float, float, float, float], None]
"""`orient_joint`, handed over."""


class Calls(NamedTuple):
    """What is called from so many places that it is compiled apart."""

    measure: Measure
    slope: Slope
    place: Place
    orient: Orient


class Work(NamedTuple):
    """All of it, by reference."""

    table: Reference[TaskTable]
    given: Reference[Clip]
    found: Reference[Clip]
    told: Reference[Told]
    tree: Reference[Tree]
    ranks: Reference[Ranks]
    moves: Reference[Moves]
    settings: Reference[Settings]
    pose: Reference[Pose]
    saved: Reference[Saved]
    asked: Reference[Asked]
    together: Reference[Together]
    calls: Calls


Parts = tuple[
    TaskTable, Clip, Clip, Told, Tree, Ranks, Moves, Settings, Pose, Saved, Asked, Together, Calls
]
"""What `Work` refers to, and the functions that it hands over."""

Step = Callable[[Work, int, int, int, int, float], bool]
"""`step`, handed over."""
SolveRanks = Callable[[Work, Step, int, int], int]
"""`solve_ranks`, handed over."""

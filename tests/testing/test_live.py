"""The contract of what can be stepped: it passes what keeps it, and names what does not."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
import pytest

from usdmotion import Floats, Ints, Live, Performance, Pose, Problem, Solution, cue, option
from usdmotion.kernels import OVER_FRAMES, TaskTable, kernel, place, reference, task_error
from usdmotion.plugins import host
from usdmotion.testing import LIVE_CHECKS, check_live, crowd_scene, member

CHECKS = {check.__name__: check for check in LIVE_CHECKS}
_KEPT: list[Any] = []
_LEFT_WRIST = "pelvis/spine/chest/left_shoulder/left_elbow/left_wrist"


@kernel
def push(
    table: TaskTable,
    parents: Ints,
    roots: Ints,
    translations: Floats,
    rotations: Floats,
    positions: Floats,
    orientations: Floats,
) -> None:
    """(N,), (N,), (N, 3), (N, 4): move roots until what is asked is there, or nearly so."""
    tasks = reference(table)
    for _ in range(3):
        for task in range(table.kind.shape[0]):
            place(parents, translations, rotations, positions, orientations)
            error = task_error(tasks, 0, task, positions, orientations)
            share = table.activity[0, task] * min(table.weight[0, task], 1.0)
            root = roots[table.term_node[table.first_term[task]]]
            # The spaces of a crowd are turned by half a turn, or not at all.
            ahead = 1.0 if orientations[parents[root], 3] > 0.5 else -1.0
            translations[root, 0] += ahead * share * error[0]
            translations[root, 1] += share * error[1]
            translations[root, 2] += ahead * share * error[2]


def nothing(performance: "Pushing") -> None:
    """Spoil nothing."""


@dataclass(eq=False)
class Pushing:
    """A performance in which everybody is only pushed about."""

    problem: Problem
    table: TaskTable
    input: Pose
    output: Pose
    world: Pose
    roots: Ints
    before: Callable[["Pushing"], None]
    after: Callable[["Pushing"], None]
    frame: int = 0
    threads: int = 1
    memory: list[Floats] = field(default_factory=list)

    def step(self) -> None:
        """Solve the coming frame."""
        self.before(self)
        np.copyto(self.output.translations, self.input.translations)
        np.copyto(self.output.rotations, self.input.rotations)
        push(self.table, self.problem.cast.parents, self.roots, *self.output, *self.world)
        self.frame += 1
        self.after(self)


@dataclass(frozen=True)
class Pusher:
    """A solver that moves nothing but roots; spoiled before and after each step."""

    name: ClassVar[str] = "pusher"
    threads: int = option(1, "How many might work at a time.", minimum=1)
    before: Callable[[Pushing], None] = nothing
    after: Callable[[Pushing], None] = nothing
    begin: Callable[[Pushing], None] = nothing
    solved: Callable[[Problem, Floats], None] = lambda problem, translations: None

    def solve(self, problem: Problem) -> Solution:
        """Return the motion of a performance."""
        pushing, cast = Pusher().start(problem), problem.cast
        translations, rotations = np.empty(cast.translations.shape), np.empty(cast.rotations.shape)
        for frame in range(cast.frame_count):
            cue(pushing, problem, frame)
            pushing.step()
            translations[frame], rotations[frame] = pushing.output
        self.solved(problem, translations)
        count = np.zeros(cast.frame_count, dtype=np.int64)
        return Solution(translations, rotations, count, count)

    def start(self, problem: Problem) -> Performance:
        """Return a performance of a problem."""
        cast, first = problem.cast, {}
        for name in OVER_FRAMES:
            first[name] = np.array(getattr(problem.table, name)[:1])
        roots = np.cumsum(cast.parents < 0) - 1
        pushing = Pushing(
            problem,
            problem.table._replace(**first),
            *(Pose(np.array(cast.translations[0]), np.array(cast.rotations[0])) for _ in range(3)),
            np.flatnonzero(cast.translates)[roots],
            self.before,
            self.after,
            threads=self.threads,
        )
        self.begin(pushing)
        return pushing


@pytest.mark.parametrize("name", CHECKS)
def test_what_keeps_the_contract_passes(name: str) -> None:
    """The checks assert by themselves; the spoiled solvers below show that each can fail."""
    CHECKS[name](Pusher())


def nudge(pushing: Pushing) -> None:
    pushing.output.translations[1, 0] += 1e-12


def nudge_by(count: Callable[[Pushing], float]) -> Callable[[Pushing], None]:
    def spoil(pushing: Pushing) -> None:
        pushing.output.translations[1, 0] += 1e-12 * count(pushing)

    return spoil


def other_arrays(pushing: Pushing) -> None:
    pushing.output = Pose(*map(np.array, pushing.output))


def no_copies(pushing: Pushing) -> None:
    pushing.input = Pose(pushing.problem.cast.translations[0], pushing.problem.cast.rotations[0])


def the_problems_own(pushing: Pushing) -> None:
    """Work on the problem's first frame itself."""
    names = {name: getattr(pushing.problem.table, name)[:1] for name in OVER_FRAMES}
    pushing.table = pushing.table._replace(**names)


def at_zero(pushing: Pushing) -> None:
    pushing.table.activity[:] = 0.0


def as_it_was(name: str) -> Callable[[Pushing], None]:
    """Return what takes a column from the problem that it was started with."""

    def spoil(pushing: Pushing) -> None:
        cast = pushing.problem.cast
        if name == "input":
            np.copyto(pushing.input.translations, cast.translations[pushing.frame])
        else:
            getattr(pushing.table, name)[0] = getattr(pushing.problem.table, name)[pushing.frame]

    return spoil


def late(pushing: Pushing) -> None:
    """Follow what the others did on the frame before."""
    now = np.array(pushing.output.translations)
    if pushing.memory:
        # The first node of the second character is the space behind all of the first.
        second = len(now) // 2
        leader = slice(0, second) if pushing.table.term_node[0] < second else slice(second, None)
        pushing.output.translations[leader] = pushing.memory[-1][leader]
    pushing.memory.append(now)


def foresight(problem: Problem, translations: Floats) -> None:
    """Mix some of the last frame into the first."""
    translations[0, 1] += 1e-9 * problem.table.target[-1, 0, 0]


def peeking(pushing: Pushing) -> None:
    pushing.output.translations[1, 0] += 1e-9 * pushing.problem.table.target[-1, 0, 0]


def shared_between(pushing: Pushing) -> None:
    """Carry something from one performance to another."""
    _KEPT.append(pushing.table.target[0, 0, 0])
    if len(_KEPT) > 1:
        pushing.output.translations[1, 0] += 1e-9 * (_KEPT[-2] - 0.5 * _KEPT[-1])


def greedy(pushing: Pushing) -> None:
    pushing.memory[:] = [np.zeros(10 * pushing.output.translations.shape[0])]
    pushing.memory.clear()


def hoarding(pushing: Pushing) -> None:
    pushing.memory.append(np.zeros(pushing.output.translations.shape[0]))


SPOILED = [
    ("check_stepping", Pusher(after=nudge), "must give what `solve` gives, to the last bit"),
    ("check_arrays", Pusher(after=other_arrays), "must be the same arrays on every frame"),
    ("check_arrays", Pusher(begin=at_zero), "must be those of the problem's first frame"),
    ("check_arrays", Pusher(begin=the_problems_own), "must not write into the problem"),
    ("check_forward", Pusher(solved=foresight), "another target must change nothing on the frames"),
    ("check_forward", Pusher(after=peeking), "another target must change nothing on the frames"),
    ("check_now", Pusher(after=late), "must be where that joint is on the same frame"),
    ("check_beside", Pusher(after=shared_between), "must not disturb each other"),
    (
        "check_threads",
        Pusher(after=nudge_by(lambda pushing: pushing.threads)),
        "must not depend on the number of threads",
    ),
    ("check_allocation", Pusher(after=greedy), "a step must not allocate"),
    ("check_allocation", Pusher(after=hoarding), "a step must not allocate"),
]


@pytest.mark.parametrize(("name", "solver", "sentence"), SPOILED)
def test_each_check_names_the_promise_that_is_broken(
    name: str, solver: Pusher, sentence: str
) -> None:
    _KEPT.clear()
    with pytest.raises(AssertionError, match=sentence):
        CHECKS[name](solver)


@pytest.mark.parametrize("column", ["target", "term_point", "weight", "activity", "input"])
def test_a_performance_that_does_not_look_at_what_is_written_is_found_out(column: str) -> None:
    with pytest.raises(AssertionError, match=f"another {column} that is written in between"):
        CHECKS["check_asked"](Pusher(before=as_it_was(column)))


def test_a_solver_that_cannot_be_stepped_has_nothing_to_keep() -> None:
    solver = host().solver("prioritized_ik")()
    assert not isinstance(solver, Live)
    check_live(solver)
    assert isinstance(Pusher(), Live)


def test_a_cue_is_one_frame_of_a_problem() -> None:
    problem = Problem.of(crowd_scene())
    pushing = Pusher().start(problem)
    cue(pushing, problem, 7)
    pushing.step()
    assert np.array_equal(pushing.output.rotations, problem.cast.rotations[7])


def test_a_crowd_stands_in_pairs_that_face_each_other() -> None:
    scene = crowd_scene(count=4)
    assert [each.path for each in scene.characters] == [member(index) for index in range(4)]
    cast = scene.cast
    assert cast.node_count == 4 * 17
    chests = [cast.index[member(index), "pelvis/spine/chest"] for index in range(4)]
    wrists = [cast.index[member(index), _LEFT_WRIST] for index in range(2)]
    one, two, other, _ = cast.positions[0, chests]
    assert np.linalg.norm(one - two) < 0.6 < 1.9 < np.linalg.norm(one - other)
    # The left of the one is the right of the other.
    aside = cast.positions[0, wrists, 0] - cast.positions[0, chests[:2], 0]
    assert aside[0] * aside[1] < 0.0

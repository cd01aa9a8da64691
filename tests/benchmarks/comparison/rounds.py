"""Rounds in which everybody solves the same clip once, so that a ratio is of one moment."""

import json
import statistics
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import Any, Protocol

import numpy as np

from comparison.contestants import Contestant
from comparison.environments import NotHere, python, single_threaded
from comparison.exchange import Answer, answered
from usdmotion import Problem, Solver

RUNNERS = Path(__file__).with_name("runners")
RUNS_IN_A_TURN = 3


@dataclass(frozen=True)
class Task:
    """A clip to be solved, and how."""

    title: str
    problem: Problem
    folder: Path
    """Where `exchange.export` wrote it."""
    rules: Mapping[str, Any]
    """See `runners/contest.py`."""
    settings: str
    """Which settings of a contestant: "within_reach" or "out_of_reach"."""


@dataclass(frozen=True, eq=False)
class Run:
    """One clip, solved once."""

    seconds: float
    """From the first frame's posture and targets to the last frame's pose."""
    stepping: float
    """The part of it that was spent in steps [s]."""
    steps: Sequence[int]
    """On each frame."""
    answer: Answer


class Solves(Protocol):
    """Somebody who takes part."""

    name: str

    def solve(self, task: Task) -> Run:
        """Solve a clip once."""


class Ours:
    """Our own solver, in this process; its steps are all of its time."""

    name = "usdmotion"

    def __init__(self, solver: Solver) -> None:
        self.solver = solver

    def solve(self, task: Task) -> Run:
        start = perf_counter()
        solution = self.solver.solve(task.problem)
        seconds = perf_counter() - start
        answer = answered(task.problem, solution.translations, solution.rotations)
        return Run(seconds, seconds, solution.iterations.tolist(), answer)


class Runner(AbstractContextManager["Runner"]):
    """A process in the environment of a library."""

    def __init__(self, executable: Path, script: Path) -> None:
        self.room = tempfile.TemporaryDirectory()
        self.said = Path(self.room.name) / "said.txt"
        with self.said.open("w") as said:
            self.process = subprocess.Popen(
                [str(executable), str(script)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=said,
                text=True,
                env=single_threaded(),
            )
        try:
            self.versions = str(self.reply()["versions"])
        except NotHere:
            self.close()
            raise

    def reply(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            why = (self.said.read_text().strip().splitlines() or ["it said nothing"])[-1]
            raise NotHere(f"{self.process.args[1]} ended: {why}")
        reply: dict[str, Any] = json.loads(line)
        return reply

    def ask(self, task: Task, settings: Mapping[str, Any]) -> Run:
        assert self.process.stdin is not None
        file = Path(self.room.name) / "answer.npz"
        words = {
            "folder": str(task.folder),
            "rules": dict(task.rules),
            "settings": dict(settings),
            "answer": str(file),
        }
        print(json.dumps(words), file=self.process.stdin, flush=True)
        reply = self.reply()
        return Run(**reply, answer=Answer.load(file))

    def close(self) -> None:
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            pipe.close()
        self.process.wait()
        self.room.cleanup()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()


@dataclass(frozen=True)
class Theirs:
    """A library, used in one way."""

    contestant: Contestant
    runner: Runner

    @property
    def name(self) -> str:
        return self.contestant.name

    def solve(self, task: Task) -> Run:
        return self.runner.ask(task, getattr(self.contestant, task.settings))


def start(contestants: Sequence[Contestant], stack: ExitStack) -> Iterator[Theirs]:
    """Yield those whose library can be had here; say in one sentence why another cannot."""
    runners: dict[str, Runner | None] = {}
    for each in contestants:
        if each.library not in runners:
            try:
                script = RUNNERS / f"with_{each.library}.py"
                runner = Runner(python(each.library), script)
                runners[each.library] = stack.enter_context(runner)
            except NotHere as error:
                print(error)
                runners[each.library] = None
        found = runners[each.library]
        if found is not None:
            yield Theirs(each, found)


@dataclass(frozen=True, eq=False)
class Standing:
    """How somebody did over all rounds."""

    name: str
    runs: Sequence[Run]
    aim: float | None = None
    beside: Sequence[Run] = field(default_factory=tuple)
    """Our own run of the same rounds."""

    @property
    def seconds(self) -> float:
        """Return the least time for the clip [s]."""
        return min(run.seconds for run in self.runs)

    @property
    def step(self) -> float:
        """Return the least time for a step [s]; nan where none was needed."""
        return min(run.stepping / sum(run.steps) if sum(run.steps) else np.nan for run in self.runs)

    @property
    def ratio(self) -> float:
        """Return how often our time goes into theirs: the median over the rounds."""
        pairs = zip(self.runs, self.beside, strict=True)
        return statistics.median(theirs.seconds / ours.seconds for theirs, ours in pairs)


def compete(task: Task, ours: Ours, others: Sequence[Theirs], rounds: int) -> list[Standing]:
    """Let everybody solve a clip, in turns, after one round that warms up.

    A turn is a few runs, of which the fastest counts: who was idle while others had their turns
    finds cold caches at first.
    """
    everybody: list[Solves] = [ours, *others]
    table = [[_turn(each, task) for each in everybody] for _ in range(rounds + 1)][1:]
    runs = list(zip(*table, strict=True))
    aims = [None, *(each.contestant.aim for each in others)]
    if task.settings != "within_reach":
        aims = [None] * len(everybody)
    return [
        Standing(each.name, run, aim, runs[0])
        for each, run, aim in zip(everybody, runs, aims, strict=True)
    ]


def _turn(who: Solves, task: Task) -> Run:
    return min((who.solve(task) for _ in range(RUNS_IN_A_TURN)), key=lambda run: run.seconds)

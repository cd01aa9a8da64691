"""Everybody takes part in turns; who cannot is told of and left out."""

import sys
from contextlib import ExitStack
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from comparison import environments, rounds, tables
from comparison.contestants import CONTESTANTS, Contestant
from comparison.environments import NotHere
from comparison.exchange import given
from comparison.rounds import Ours, Runner, Standing, Task, Theirs, compete
from rich.console import Console
from rich.table import Table

from usdmotion.plugins import host

RESTLESS = Contestant("numpy", "kept", "nothing", {"turn": 1.0}, {"turn": 1.0}, aim=2.0)


def shown(table: Table) -> str:
    page = StringIO()
    Console(width=200, file=page).print(table)
    return page.getvalue()


def test_a_runner_solves_in_a_process_of_its_own(task: Task, keep: Path) -> None:
    with Runner(Path(sys.executable), keep) as runner:
        assert runner.versions == f"numpy {np.__version__}"
        run = runner.ask(task, {"turn": 1.0})
        assert run.steps == [3] * task.problem.cast.frame_count
        assert np.array_equal(run.answer.turns, given(task.problem).turns)
        assert sum(runner.ask(task, {"turn": 0.0}).steps) == len(run.steps)
    assert runner.process.returncode == 0


def test_a_runner_that_dies_says_why(task: Task, tmp_path: Path) -> None:
    script = tmp_path / "broken.py"
    script.write_text("raise SystemExit('there is no such library')")
    with pytest.raises(NotHere, match="there is no such library"):
        Runner(Path(sys.executable), script)


def test_a_library_that_is_not_here_is_left_out(monkeypatch, capsys, keep: Path) -> None:
    def python(library: str) -> Path:
        if library == "pink":
            raise NotHere("pink is left out, because it cannot be installed here: no wheel")
        return Path(sys.executable)

    monkeypatch.setattr(rounds, "python", python)
    for library in ("mink", "placo"):
        (keep.parent / f"with_{library}.py").write_text(keep.read_text())
    monkeypatch.setattr(rounds, "RUNNERS", keep.parent)
    with ExitStack() as stack:
        found = list(rounds.start(CONTESTANTS, stack))
    assert {each.contestant.library for each in found} == {"mink", "placo"}
    assert capsys.readouterr().out.count("pink is left out") == 1


def test_the_tables_tell_what_was_given_and_what_came_out(task: Task, keep: Path) -> None:
    ours = Ours(host().solver("prioritized_ik")())
    with Runner(Path(sys.executable), keep) as runner:
        standings = compete(task, ours, [Theirs(RESTLESS, runner)], 1)
    assert [each.name for each in standings] == ["usdmotion", "numpy, kept"]
    assert standings[0].ratio == 1.0
    text = shown(tables.standings(task, standings))
    assert "206.155 mm" in text
    assert "≥ 2 ×" in text
    assert "turn 1.0" in shown(tables.given([RESTLESS], [task]))


def test_a_ratio_is_the_median_over_the_rounds(task: Task) -> None:
    def runs(*seconds: float) -> list[rounds.Run]:
        return [rounds.Run(each, each / 2, [2, 0], given(task.problem)) for each in seconds]

    standing = Standing("they", runs(4.0, 9.0, 40.0), beside=runs(1.0, 3.0, 4.0))
    assert standing.ratio == 4.0
    assert standing.seconds == 4.0
    assert standing.step == 1.0


@pytest.mark.slow
def test_what_pip_cannot_install_is_told_in_one_sentence(monkeypatch, tmp_path: Path) -> None:
    nowhere = {"mink": (str(tmp_path / "no_such_package"),)}
    monkeypatch.setattr(environments, "PACKAGES", nowhere)
    with pytest.raises(NotHere, match="mink is left out, because it cannot be installed here"):
        environments.python("mink", tmp_path)


def test_contestants_run_on_one_thread_and_import_nothing_of_ours(monkeypatch) -> None:
    monkeypatch.setenv("PYTHONPATH", "here")
    variables = environments.single_threaded()
    assert variables["OMP_NUM_THREADS"] == "1"
    assert "PYTHONPATH" not in variables

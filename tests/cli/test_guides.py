"""The verb `guides`, and the option `--guides` of verbs that write."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., str]


@pytest.fixture
def run(typed: Run, arm: Path) -> Run:
    """Return what runs a verb beside arm.usda."""
    return typed


def test_what_was_drawn_is_shown(run: Run) -> None:
    said = run("guides arm.usda")
    assert "/Arm/Skeleton/Edit" in said and "not solved" in said
    assert "wrote arm.guides.usda" in said
    data = json.loads(run("guides arm.usda -o guides.usda --json -"))
    assert data["edits"][0]["trajectories"] == 1


@pytest.mark.parametrize("words", ["--guides", "--guides -o a.usda", "--guides --quiet"])
def test_the_option_alone_draws_in_the_layer(run: Run, words: str) -> None:
    said = run(f"solve arm.usda {words}")
    assert "guides" not in said
    output = Path("a.usda" if "-o" in words else "arm.edit.usda")
    assert '"Guides"' in output.read_text()


@pytest.mark.parametrize("words", ["--guides g.usda arm.usda", "arm.usda --guides=g.usda"])
def test_a_file_may_be_named(run: Run, words: str) -> None:
    assert "wrote g.usda" in run(f"solve {words}")
    assert "Guides" not in Path("arm.edit.usda").read_text()
    assert '"Guides"' in Path("g.usda").read_text()


def test_a_shot_is_not_taken_for_the_file(run: Run) -> None:
    said = run("solve --guides arm.usda", status=2)
    assert said.count("\n") == 1 and "--guides arm.usda names the file of the guides" in said
    assert not Path("arm.edit.usda").exists()


def test_detections_are_drawn_unless_somebody_says_otherwise(run: Run) -> None:
    run("detect arm.usda --joints base -o a.usda")
    run("detect arm.usda --joints base -o b.usda --guides")
    run("detect arm.usda --joints base -o c.usda --no-guides")
    assert Path("a.usda").read_bytes() == Path("b.usda").read_bytes()
    assert "Guides" not in Path("c.usda").read_text()
    said = run("detect arm.usda --guides g.usda --no-guides", status=2)
    assert "leave one out" in said


@pytest.mark.parametrize(
    "words",
    [
        "guides none.usda",
        "guides arm.usda -o arm.usda",
        "guides arm.usda -o none/guides.usda",
        "guides arm.usda -o g.usda --json g.usda",
        "solve arm.usda -o a.usda --guides arm.usda",
        "solve arm.usda -o a.usda --guides a.usda",
        "clean arm.usda --joints base --guides arm.usda",
        "retarget arm.usda arm.usda -o a.usda --guides arm.usda",
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence(run: Run, words: str) -> None:
    there = {path: path.read_bytes() for path in Path().iterdir()}
    assert run(words, status=2).count("\n") == 1
    assert {path: path.read_bytes() for path in Path().iterdir()} == there

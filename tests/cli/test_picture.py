"""The verb `picture`: what it draws, where it writes, and what it tells."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from usdmotion import pipeline

Run = Callable[..., str]


@pytest.fixture
def run(typed: Callable[..., str]) -> Run:
    """Return what runs the verb."""
    return lambda words, **asked: typed(f"picture {words}", **asked)


def test_a_layer_is_drawn_over_the_shot_beside_it(run: Run, arm: Path) -> None:
    pipeline.solve(arm, Path("arm.edit.usda"))
    told = json.loads(run("arm.edit.usda --frames 2 --json -"))
    assert (told["frames"], told["rows"]) == ([2.0], ["before", "after"])
    assert run("arm.usda --compare arm.edit.usda --frames 2 --quiet") == ""
    assert Path("arm.png").read_bytes() == Path("arm.edit.png").read_bytes()


def test_the_name_that_was_derived_is_printed(run: Run, arm: Path) -> None:
    said = run("arm.usda --frames 2:4:2")
    assert "frames: 2, 4" in said
    assert said.endswith("\nwrote arm.png\n")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("absent.usda", "absent.usda: there is no such file"),
        ("arm.usda --compare absent.usda", "absent.usda: there is no such file"),
        ("arm.usda --view behind", "--view 'behind' is no view; name some of front, side, top"),
        ("arm.usda --view ''", "--view '' is no view; name some of front, side, top"),
        ("arm.usda --frames nine", "--frames nine names no frames; write 1:48"),
        ("arm.usda -o arm.jpg", "arm.jpg: a picture ends in .png or .svg; name it so"),
        ("arm.usda -o arm.usda", "arm.usda: a file that ends in .usda is a layer"),
        (
            "arm.usda --camera /Arm",
            "arm.usda: </Arm> is no Camera; there is none, so name",
        ),
    ],
)
def test_what_cannot_be_drawn_is_told_in_a_sentence(
    run: Run, arm: Path, words: str, sentence: str
) -> None:
    said = run(words, status=2)
    assert said.startswith(f"usdmotion: {sentence}")
    assert said.count("\n") == 1
    assert [each.name for each in Path().iterdir()] == ["arm.usda"]

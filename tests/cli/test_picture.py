"""The verb `picture`: what it draws, where it writes, and what it tells."""

import json
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from usdmotion import cli, pipeline

Run = Callable[..., str]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Return what runs the verb and returns what it prints, or its complaint."""

    def call(words: str, *, status: int = 0) -> str:
        monkeypatch.setattr("sys.argv", ["usdmotion", "picture", *shlex.split(words)])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        said = capsys.readouterr()
        assert (ended.value.code or 0) == status, said.err
        return said.err if status else said.out

    return call


@pytest.fixture
def arm(arm_shot: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return arm_shot(name="arm.usda").relative_to(tmp_path)


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

"""Where verbs write: never over a layer, and each output at a place of its own."""

import shlex
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from usdmotion import FileError, cli, pipeline
from usdmotion.reporting import report
from usdmotion.usd import require_apart

VERBS = (
    "detect arm.usda -o a.usda --json arm.usda",
    "detect arm.usda -o a.usda --json a.usda",
    "detect link.usda -o a.usda --json arm.USDA",
    "solve arm.usda -o a.usda --json arm.usda",
    "solve arm.usda -o a.usda --report arm.usda",
    "solve arm.usda -o a.usda --compose b.usda --report b.usda",
    "solve arm.usda -o a.usda --compose ./a.usda",
    "solve arm.usda -o a.usda --report a.html --json link/../a.html",
    "clean arm.usda -o a.usda --joints wrist --json arm.usda",
    "clean arm.usda -o a.usda --joints wrist --report arm.usda",
    "inspect arm.usda --json arm.usda",
    "report arm.usda -o arm.usda",
    "report arm.usda -o a.html --png a.html",
    "report arm.usda -o a.html --png arm.usda",
)
"""Words that ask for a document over a layer, or for two outputs at one place."""


@pytest.fixture
def arm(arm_shot: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    shot = arm_shot()
    (tmp_path / "link.usda").symlink_to(shot)
    (tmp_path / "link").symlink_to(tmp_path / "folder")
    (tmp_path / "folder").mkdir()
    return shot


@pytest.mark.parametrize("words", VERBS)
def test_no_document_takes_the_place_of_a_layer_or_of_another(
    words: str, arm: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before, there = arm.read_bytes(), sorted(arm.parent.iterdir())
    monkeypatch.setattr(sys, "argv", ["usdmotion", *shlex.split(words)])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    said = capsys.readouterr().err
    assert ended.value.code == 2
    assert said.count("\n") == 1 and "another" in said
    assert sorted(arm.parent.iterdir()) == there
    assert arm.read_bytes() == before


def test_a_page_is_kept_off_layers_for_those_who_call_functions_too(arm: Path) -> None:
    output = arm.with_name("a.usda")
    for refused in (
        lambda: pipeline.solve(arm, output, page=arm),
        lambda: pipeline.clean(arm, output, joints=["wrist"], page=output),
        lambda: report(arm, arm),
    ):
        with pytest.raises(FileError, match="nothing else is written over"):
            refused()
    assert not output.exists()


def is_let_through(layers: tuple[Path | None, ...], *documents: str | Path | None) -> bool:
    try:
        require_apart(layers, documents)
    except FileError:
        return False
    return True


def test_what_is_no_layer_and_has_its_own_place_is_let_through(tmp_path: Path) -> None:
    layer, page = tmp_path / "a.usda", tmp_path / "a.html"
    pictures, json = tmp_path / "pictures", str(tmp_path / "a.json")
    assert is_let_through((layer, None), page, "-", None, pictures, json)
    assert not is_let_through((layer, None), page, "-", None, pictures, str(page))
    assert not is_let_through((layer, layer), page, "-", None, pictures, json)


def test_a_composed_stage_that_cannot_be_written_leaves_nothing_behind(arm: Path) -> None:
    output, before = arm.with_name("a.usda"), arm.read_bytes()
    with pytest.raises(FileError, match="arm"):
        pipeline.solve(arm, output, compose=arm)
    assert not output.exists()
    assert arm.read_bytes() == before

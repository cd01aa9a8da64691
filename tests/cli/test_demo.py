"""The verb that builds stages of our own, one or all, and draws them where that is asked for."""

import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from usdmotion import InputError, demos
from usdmotion.cli import app


def names_in(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def test_all_is_every_one_in_one_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demos, "NAMES", ("taps", "dice"))
    said = CliRunner().invoke(app, ["demo", "all", "-o", str(tmp_path)])
    assert said.exit_code == 0, said.output
    assert names_in(tmp_path) == ["dice.usda", "taps.usda"]
    assert said.output.count("go on by: usdmotion detect") == 2


def test_a_name_that_there_is_not_is_refused_with_those_that_there_are(tmp_path: Path) -> None:
    said = CliRunner().invoke(app, ["demo", "swimming", "-o", str(tmp_path / "pool")])
    assert isinstance(said.exception, InputError)
    assert "swimming" in str(said.exception) and str(said.exception).endswith("crawl, and all")
    assert names_in(tmp_path) == []


def test_without_matplotlib_nothing_is_built_to_be_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    said = CliRunner().invoke(app, ["demo", "taps", "-o", str(tmp_path / "taps"), "--picture"])
    assert isinstance(said.exception, InputError)
    assert "pip install 'usdmotion[report]'" in str(said.exception)
    assert names_in(tmp_path) == []

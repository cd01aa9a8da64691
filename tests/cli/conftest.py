"""Verbs as somebody types them, beside a small stage."""

import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from usdmotion import cli


@pytest.fixture
def typed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """Return what runs a command and returns what it prints, or its complaint."""

    def call(words: str, *, status: int = 0) -> str:
        monkeypatch.setattr("sys.argv", ["usdmotion", *shlex.split(words)])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        said = capsys.readouterr()
        assert (ended.value.code or 0) == status, said.err
        return said.err if status else said.out

    return call


@pytest.fixture
def arm(arm_shot: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the path of a small stage in the folder in which commands run."""
    monkeypatch.chdir(tmp_path)
    return arm_shot(name="arm.usda").relative_to(tmp_path)

"""The complete third-party example: it keeps the contract, and works once it is installed."""

import json
import os
import shutil
import site
import subprocess
import sys
import venv
from importlib import import_module
from pathlib import Path

import pytest

from usdmotion.testing import check_solver

EXAMPLE = Path(__file__).parent / "example_solver"

BROKEN = {
    "pyproject.toml": """
[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"
[project]
name = "usdmotion-broken"
version = "0.1"
[project.entry-points.usdmotion]
broken = "usdmotion_broken"
[tool.hatch.build.targets.wheel]
include = ["usdmotion_broken.py"]
""",
    "usdmotion_broken.py": "import a_library_that_nobody_has\n",
}


def test_the_example_keeps_the_contract(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(EXAMPLE)
    check_solver(import_module("usdmotion_least_squares").LeastSquares())


def run(*command: object, folder: Path) -> str:
    said = subprocess.run(
        list(map(str, command)), cwd=folder, capture_output=True, text=True, env=clean()
    )
    assert said.returncode == 0, f"{command}\n{said.stdout}\n{said.stderr}"
    return said.stdout


def clean() -> dict[str, str]:
    """Return the environment without what would lead Python elsewhere."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


def environment(folder: Path) -> Path:
    """Make a virtual environment that also sees what is installed in this one; its python."""
    venv.create(folder, with_pip=True, symlinks=True)
    python = folder / "bin" / "python"
    where = run(
        python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", folder=folder
    )
    lines = (f"import site; site.addsitedir({each!r})\n" for each in site.getsitepackages())
    Path(where.strip(), "this_environment.pth").write_text("".join(lines))
    return python


def wheel(source: Path, folder: Path) -> Path:
    run(
        sys.executable,
        "-m",
        "build",
        "--wheel",
        "--no-isolation",
        "-o",
        folder,
        source,
        folder=folder,
    )
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the python of an environment with the example and a broken plugin installed."""
    folder = tmp_path_factory.mktemp("third_party")
    shutil.copytree(EXAMPLE, folder / "example", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "broken").mkdir()
    for name, text in BROKEN.items():
        (folder / "broken" / name).write_text(text)
    python = environment(folder / "env")
    for name in ("example", "broken"):
        out = folder / f"{name}_dist"
        out.mkdir()
        run(python, "-m", "pip", "install", "-q", wheel(folder / name, out), folder=folder)
    return python


@pytest.mark.slow
def test_the_installed_example_passes_its_own_test(python: Path) -> None:
    folder = python.parents[2] / "example"
    said = run(python, "-m", "pytest", "-q", folder, "-p", "no:cacheprovider", folder=folder)
    assert "passed" in said


@pytest.mark.slow
def test_the_installed_example_is_listed_and_the_broken_one_set_aside(python: Path) -> None:
    said = run(python, "-m", "usdmotion", "plugins", "--json", "-", folder=python.parent)
    lines = {line["name"]: line for line in json.loads(said)["plugins"]}
    assert lines["least_squares"]["package"] == "usdmotion-least-squares 1.0"
    assert lines["least_squares"]["registers"] == ["solver least_squares"]
    assert lines["least_squares"]["set_aside"] == ""
    assert "a_library_that_nobody_has" in lines["broken"]["set_aside"]
    assert lines["prioritized_ik"]["set_aside"] == ""


@pytest.mark.slow
def test_the_installed_example_solves_a_stage(python: Path, tmp_path: Path) -> None:
    def usdmotion(*words: str) -> str:
        return run(python, "-m", "usdmotion", *words, folder=tmp_path)

    usdmotion("demo", "reaching", "-o", "reaching")
    said = usdmotion(
        "solve", "reaching/reaching.usda", "--solver", "least_squares", "--frames", "50:60",
        "--json", "-", "--quiet",
    )  # fmt: skip
    (edit,) = json.loads(said)["edits"]
    assert edit["solver"] == "least_squares"
    assert all(row["max"] < 0.01 for row in edit["constraints"] if row["priority"] == 1)

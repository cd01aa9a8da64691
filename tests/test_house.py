"""The house rules: layers, style, types, and sizes that a room can hold."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

HOUSE = Path(__file__).parents[1]
ROOMS = [HOUSE / name for name in ("usdmotion", "plugins", "schemas", "tests")]
MOST_LINES_IN_A_FILE = 300
MOST_LINES_IN_A_FUNCTION = 40

pytestmark = pytest.mark.skipif(
    not (HOUSE / "usdmotion").is_dir(), reason="these tests are a copy without the house"
)


def run(tool: str, *words: str) -> None:
    command = [str(Path(sys.executable).with_name(tool)), *words]
    said = subprocess.run(command, cwd=HOUSE, capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr


def test_imports_keep_their_contracts() -> None:
    run("lint-imports", "--no-cache")


def test_ruff_finds_nothing() -> None:
    run("ruff", "check", "--no-cache", ".")


def test_the_code_is_formatted() -> None:
    run("ruff", "format", "--no-cache", "--check", ".")


@pytest.mark.slow
def test_the_types_are_right() -> None:
    run("mypy")


def sources() -> list[Path]:
    return sorted(path for room in ROOMS for path in room.rglob("*.py"))


def test_no_file_holds_more_than_a_room_can() -> None:
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in sources()}
    long = {
        str(path.relative_to(HOUSE)): length
        for path, length in lengths.items()
        if length > MOST_LINES_IN_A_FILE
    }
    assert not long


def test_no_function_is_longer_than_a_page() -> None:
    long = [
        f"{path.relative_to(HOUSE)}:{node.lineno} {node.name}: {length(node)} lines"
        for path in sources()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and length(node) > MOST_LINES_IN_A_FUNCTION
    ]
    assert not long


def length(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Return how many lines a function has without its docstring."""
    lines = (function.end_lineno or function.lineno) - function.lineno + 1
    if ast.get_docstring(function) is not None:
        docstring = function.body[0]
        lines -= (docstring.end_lineno or docstring.lineno) - docstring.lineno + 1
    return lines

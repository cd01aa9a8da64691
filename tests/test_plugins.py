"""The plugin host: what it finds, what it refuses, and that nothing takes it down."""

import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path

import pytest

from usdmotion.constraints import built_in
from usdmotion.errors import InputError, OptionError
from usdmotion.plugins import GROUP, Host, gather, host

GOOD = """
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from usdmotion import PositionConstraint, hookimpl, option


@dataclass(frozen=True)
class Still:
    name: ClassVar[str] = "still"
    strength: float = option(1.0, "Nothing.", minimum=0.0)

    def solve(self, problem):
        return None


@dataclass(frozen=True)
class Tape:
    name: ClassVar[str] = "tape"
    suffixes: ClassVar[tuple[str, ...]] = (".tape",)

    def read(self, path):
        return None


@dataclass(frozen=True, eq=False, kw_only=True)
class Pull(PositionConstraint):
    schema: ClassVar[str] = "PullConstraint"

    def tasks(self, cast):
        return ()


@dataclass(frozen=True)
class Nothing:
    name: ClassVar[str] = "nothing"

    def detect(self, search):
        return None


@hookimpl
def register_solvers():
    return [Still]


@hookimpl
def register_detectors():
    return [Nothing]


@hookimpl
def register_readers():
    return (Tape,)


@hookimpl
def register_constraints():
    return [Pull]


@hookimpl
def register_schemas():
    return [Path(__file__).parent]
"""

Make = Callable[..., EntryPoint]


@pytest.fixture
def make(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Make:
    """Return what writes a module and gives its entry point."""
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "plugInfo.json").write_text("{}")

    def write(name: str, text: str) -> EntryPoint:
        module = f"{tmp_path.name}_{name}"
        (tmp_path / f"{module}.py").write_text(text)
        return EntryPoint(name=name, value=module, group=GROUP)

    return write


def fault_of(host: Host, name: str) -> str:
    return next(plugin.fault for plugin in host.plugins if plugin.name == name)


def test_our_own_plugins_are_found_and_healthy() -> None:
    assert not [plugin.fault for plugin in host().plugins if plugin.fault]
    assert "prioritized_ik" in host().solvers
    assert "bvh" in host().readers


def test_a_plugin_registers_solvers_readers_constraints_and_schemas(
    make: Make, tmp_path: Path
) -> None:
    found = gather([make("good", GOOD)])
    assert list(found.solvers) == ["still"]
    assert list(found.detectors) == ["nothing"]
    assert list(found.readers) == ["tape"]
    assert [kind.schema for kind in found.constraints] == [
        *(kind.schema for kind in built_in()),
        "PullConstraint",
    ]
    assert found.schemas == (tmp_path,)


SOLVER = """
from dataclasses import dataclass
from usdmotion import hookimpl, option
{body}
@hookimpl
def register_solvers():
    return {returned}
"""


def solver(body: str, returned: str = "[Mine]") -> str:
    return SOLVER.format(body=body, returned=returned)


BROKEN = {
    "absent": ("import nowhere_to_be_found", "ModuleNotFoundError: No module named"),
    "crashing": ("1 / 0", "ZeroDivisionError: division by zero"),
    "leaving": ("raise SystemExit(3)", "SystemExit: 3"),
    "hookless": ("def register_solvers(): return []", "it has no hook"),
    "misspelt": (
        "from usdmotion import hookimpl\n@hookimpl\ndef register_solver(): return []",
        "unknown hook 'register_solver'",
    ),
    "asking": (
        "from usdmotion import hookimpl\n@hookimpl\ndef register_solvers(more): return []",
        "Argument(s) {'more'}",
    ),
    "raising": (
        "from usdmotion import hookimpl\n@hookimpl\ndef register_solvers(): raise ValueError('no')",
        "ValueError: no",
    ),
    "listless": (solver("", "42"), "register_solvers returns 42, which is not a list"),
    "instance": (solver("class Mine: name = 'mine'", "[Mine()]"), "which is not a class"),
    "classes": (solver("class Mine: name = 'mine'", "Mine"), "which is not a list"),
    "nameless": (solver("class Mine:\n def solve(self, problem): ..."), "needs a `name`"),
    "mute": (solver("class Mine: name = 'mine'"), "has no method `solve`"),
    "startled": (
        solver("class Mine:\n name = 'mine'\n start = 1.0\n def solve(self, problem): ..."),
        "has a `start` that is no method",
    ),
    "demanding": (
        solver(
            "class Mine:\n name = 'mine'\n def __init__(self, x): ...\n def solve(self, p): ..."
        ),
        "cannot be made by mine()",
    ),
    "undocumented": (
        solver(
            "@dataclass\nclass Mine:\n name = 'mine'\n much: int = option(1, ' ')\n"
            " def solve(self, problem): ..."
        ),
        "does not say what the option 'much' is",
    ),
    "excessive": (
        solver(
            "@dataclass\nclass Mine:\n name = 'mine'\n much: int = option(9, 'So.', maximum=3)\n"
            " def solve(self, problem): ..."
        ),
        "has a default outside its limits",
    ),
    "shapeless": (
        solver(
            "@dataclass\nclass Mine:\n name = 'mine'\n much: int = option(None, 'So.')\n"
            " def solve(self, problem): ..."
        ),
        "that is no plain value",
    ),
    "twofold": (
        solver("class Mine:\n name = 'mine'\n def solve(self, p): ...", "[Mine, Mine]"),
        "has the name of one that it brings already",
    ),
    "endless": (
        "from usdmotion import hookimpl\nclass Tape:\n name = 'tape'\n suffixes = ['TAPE']\n"
        " def read(self, path): ...\n@hookimpl\ndef register_readers(): return [Tape]",
        "name some, as a tuple of lower-case endings with the dot",
    ),
    "groundless": (
        "from usdmotion import hookimpl\n@hookimpl\ndef register_schemas(): return ['nowhere']",
        "is not the path of a folder with plugInfo.json",
    ),
    "taking": (
        "from usdmotion import PositionConstraint, hookimpl\n"
        "@hookimpl\ndef register_constraints(): return [PositionConstraint]",
        "has the name of one that usdmotion itself brings already",
    ),
    "unmade": (
        "from usdmotion import PositionConstraint, hookimpl\n"
        "class Pull(PositionConstraint): schema = 'Pull'\n"
        "@hookimpl\ndef register_constraints(): return [Pull]",
        "is not a dataclass",
    ),
    "taskless": (
        "from dataclasses import dataclass\nfrom usdmotion import Constraint, hookimpl\n"
        "@dataclass(frozen=True, eq=False, kw_only=True)\nclass Pull(Constraint): schema = 'Pull'\n"
        "@hookimpl\ndef register_constraints(): return [Pull]",
        "has no method `tasks`",
    ),
    "stranger": (
        "from usdmotion import hookimpl\n@hookimpl\ndef register_constraints(): return [int]",
        "which is no Constraint class",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_plugin_is_set_aside_with_its_reason(make: Make, name: str) -> None:
    text, reason = BROKEN[name]
    found = gather([make(name, text), make("good", GOOD)])
    assert reason in fault_of(found, name)
    assert "\n" not in fault_of(found, name)
    assert list(found.solvers) == ["still"]
    assert fault_of(found, "good") == ""


def test_of_two_equal_names_the_first_is_kept_and_the_second_told(make: Make) -> None:
    found = gather([make("b_second", GOOD), make("a_first", GOOD)])
    assert fault_of(found, "a_first") == ""
    assert "solver 'still' has the name of one that the plugin 'a_first' brings already" in (
        fault_of(found, "b_second")
    )


def test_our_own_plugins_come_before_those_of_others(make: Make) -> None:
    own = next(iter(host().solvers.values()))
    usurper = solver(f"class Mine:\n name = '{own.name}'\n def solve(self, p): ...")
    found = gather([make("a_usurper", usurper), *entry_points(group=GROUP)])
    assert found.solvers[own.name] is own
    assert "brings already" in fault_of(found, "a_usurper")


def test_an_unknown_name_is_answered_with_those_that_are_there(make: Make) -> None:
    found = gather([make("good", GOOD)])
    with pytest.raises(OptionError, match="no solver 'stil'; there are: still"):
        found.solver("stil")
    with pytest.raises(OptionError, match="no reader 'disc'; there are: tape"):
        found.reader("disc")


def test_an_unknown_name_is_answered_with_what_was_set_aside_too(make: Make) -> None:
    found = gather([make("good", GOOD), make("crashing", "1 / 0")])
    with pytest.raises(OptionError, match=r"are: still \(.* are set aside: crashing\)"):
        found.solver("mine")


def test_a_reader_is_found_by_the_ending_of_a_file(make: Make) -> None:
    found = gather([make("good", GOOD)])
    assert found.reader_of(Path("A.TAPE")).name == "tape"
    with pytest.raises(InputError, match=r"a\.disc: no reader .* there are readers for: \.tape"):
        found.reader_of(Path("a.disc"))


def test_the_host_imports_no_plugin_before_it_is_asked() -> None:
    script = (
        "import sys, usdmotion.plugins; "
        "print([name for name in sys.modules if name.startswith('usdmotion_')])"
    )
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert said.stdout.strip() == "[]"

"""The command line: what each verb says, writes and ends with."""

import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
import typer

from usdmotion import cli, demos, pipeline, solved
from usdmotion.plugins import host

ArmShot = Callable[..., Path]


@dataclass(frozen=True)
class Said:
    status: int
    out: str
    err: str


Run = Callable[..., Said]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Return what runs `usdmotion WORDS` in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def run(*words: object) -> Said:
        monkeypatch.setattr(sys, "argv", ["usdmotion", *map(str, words)])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        said = capsys.readouterr()
        return Said(int(ended.value.code or 0), said.out, said.err)

    return run


def commands() -> dict[str, typer.models.CommandInfo]:
    """Return every verb with what it is."""
    found = {}
    for prefix, app in (("", cli.app), ("schema ", cli.schema)):
        for command in app.registered_commands:
            assert command.callback is not None
            found[prefix + (command.name or command.callback.__name__)] = command
    return found


def example(verb: str) -> list[str]:
    return shlex.split(str(commands()[verb].epilog).removeprefix("Example: usdmotion "))


def test_these_are_the_verbs() -> None:
    verbs = "import inspect detect solve clean report normalize retarget guides picture".split()
    verbs += ["plugins", "demo"]
    assert list(commands()) == [*verbs, "schema path", "schema env", "schema check"]


@pytest.mark.parametrize("verb", commands())
def test_every_verb_has_one_line_of_purpose_and_an_example(verb: str, run: Run) -> None:
    callback = commands()[verb].callback
    assert callback is not None and callback.__doc__ is not None
    assert len(callback.__doc__.splitlines()) == 1
    said = run(*verb.split(), "--help")
    assert said.status == 0
    assert f"Example: usdmotion {verb}" in said.out


@pytest.mark.parametrize("verb", commands())
def test_every_example_works(verb: str, run: Run, arm_shot: ArmShot, tmp_path: Path) -> None:
    shot = arm_shot(name="shot.usda")
    (tmp_path / "walk.bvh").write_text(BVH)
    if verb == "report":
        pipeline.solve(shot, tmp_path / "shot.edit.usda")
    if verb in ("clean", "normalize", "retarget"):
        demos.build("skating", tmp_path).replace(shot)
    if verb == "retarget":
        demos.build("nothing_asked", tmp_path).replace(tmp_path / "body.usda")
    said = run(*example(verb))
    assert said.status == 0, said.err


BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  End Site
  {
    OFFSET 0 -170 0
  }
}
MOTION
Frames: 3
Frame Time: 0.1
0 170 0 0 0 0
0 170 0 10 0 0
0 170 0 20 0 0
"""


def test_solve_derives_the_name_prints_it_and_shows_what_was_met(
    run: Run, arm_shot: ArmShot, tmp_path: Path
) -> None:
    said = run("solve", arm_shot().name)
    assert said.status == 0
    assert "wrote arm.edit.usda" in said.out
    assert re.search(r"Wrist.*Position.*mm.*yes", said.out)
    assert (tmp_path / "arm.edit.usda").is_file()


def test_solve_writes_json_to_stdout_and_leaves_it_to_that(run: Run, arm_shot: ArmShot) -> None:
    said = run("solve", arm_shot(), "--json", "-")
    (edit,) = json.loads(said.out)["edits"]
    assert edit["constraints"][0]["met"] is True
    assert "wrote" in said.err


def test_solve_writes_json_to_a_file(run: Run, arm_shot: ArmShot, tmp_path: Path) -> None:
    assert run("solve", arm_shot(), "--json", "report.json", "--quiet") == Said(0, "", "")
    assert json.loads((tmp_path / "report.json").read_text())["edits"]


@pytest.mark.parametrize(("lift", "strict", "status"), [(2, False, 0), (2, True, 3), (0, True, 0)])
def test_only_strict_minds_a_constraint_that_is_not_met(
    run: Run, arm_shot: ArmShot, tmp_path: Path, lift: float, strict: bool, status: int
) -> None:
    said = run("solve", arm_shot(lift), *(["--strict"] if strict else []))
    assert said.status == status
    assert (tmp_path / "arm.edit.usda").is_file()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--frames", "5"], "--frames 5 is no range; write --frames A:B, as 1:48"),
        (["--clean", "-3"], "--clean -3 is no cutoff; give hertz, such as 10, or 0 for none"),
        (["--option", "iterations"], "--option iterations says no value"),
        (["--option", "iterations=0"], "option 'iterations' is '0', not a whole number"),
        (["--option", "speed=1"], "'prioritized_ik' has no option 'speed'; it has: iterations"),
        (["--solver", "magic"], "there is no solver 'magic'; there are: "),
        (["--edit", "/Nowhere"], "/Nowhere"),
        (["--json", "absent/report.json"], "absent/report.json: cannot be written"),
        (["-o", "absent/out.usda"], "absent"),
        (["-o", "arm.usda"], "arm.usda"),
    ],
)
def test_an_input_at_fault_ends_with_two_and_one_sentence(
    run: Run, arm_shot: ArmShot, words: list[str], sentence: str
) -> None:
    said = run("solve", arm_shot().name, *words)
    assert said.status == 2
    assert said.err.startswith("usdmotion: ")
    assert sentence in said.err
    assert len(said.err.splitlines()) == 1


def test_a_time_before_zero_can_be_asked_for(run: Run, arm_shot: ArmShot) -> None:
    said = run("solve", arm_shot(), "--frames", "-5:4", "--json", "-")
    assert json.loads(said.out)["edits"][0]["frames"] == 4


@pytest.mark.parametrize("words", [["solve"], ["solve", "a", "b"], ["sing"], ["solve", "--loud"]])
def test_a_wrong_call_ends_with_two(run: Run, words: list[str]) -> None:
    assert run(*words).status == 2


def test_a_bug_ends_with_one_and_its_traceback(arm_shot: ArmShot) -> None:
    script = (
        "import sys; from usdmotion import cli, demos, pipeline\n"
        "def burst(*words, **names): raise RuntimeError('burst')\n"
        "pipeline.solve = burst\n"
        "sys.argv = ['usdmotion', 'solve', 'shot.usda']\n"
        "cli.main()"
    )
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert said.returncode == 1
    assert "Traceback (most recent call last)" in said.stderr
    assert said.stderr.endswith("RuntimeError: burst\n")


def test_solve_tells_who_breaks_the_recruiting_rule(
    run: Run, arm_shot: ArmShot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(solved, "broken", lambda scene: ["it"])
    monkeypatch.setattr(solved, "sentence", lambda violation: f"{violation} breaks the rule")
    assert "note: it breaks the rule" in run("solve", arm_shot()).err


def test_solve_reports_what_report_does(run: Run, arm_shot: ArmShot, tmp_path: Path) -> None:
    said = run("solve", arm_shot(), "--report", "one.html")
    assert said.status == 0 and "wrote one.html" in said.out
    said = run("report", "arm.edit.usda", "--png", "pictures")
    assert said.status == 0
    assert "wrote arm.edit.html" in said.out and "wrote pictures" in said.out
    assert (tmp_path / "arm.edit.html").read_bytes() == (tmp_path / "one.html").read_bytes()
    assert (tmp_path / "pictures/Edit.overview.png").is_file()


def test_report_tells_what_is_stale(run: Run, arm_shot: ArmShot) -> None:
    run("solve", arm_shot())
    arm_shot(0.07)
    said = run("report", "arm.edit.usda")
    assert said.status == 0
    assert "note: the result of </Arm/Skeleton/Edit> is stale" in said.err


@pytest.mark.parametrize("verb", ["solve", "report"])
def test_without_matplotlib_a_report_is_refused_before_anything_is_done(
    run: Run, arm_shot: ArmShot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, verb: str
) -> None:
    arm_shot()
    words = {"solve": ("arm.usda", "--report", "a.html"), "report": ("arm.usda",)}
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    said = run(verb, *words[verb])
    assert said.status == 2
    assert said.err == (
        "usdmotion: pictures are drawn with matplotlib, which is not installed; "
        "pip install 'usdmotion[report]'\n"
    )
    assert [each.name for each in tmp_path.iterdir()] == ["arm.usda"]


def test_import_tells_what_it_noticed_and_where_it_wrote(run: Run, tmp_path: Path) -> None:
    (tmp_path / "walk.bvh").write_text(BVH)
    said = run("import", "walk.bvh", "--name", "Hero")
    assert said.status == 0
    assert "wrote walk.usda: Hero, 3 frames of 1 joints" in said.out
    assert "note: " in said.err


def test_inspect_shows_tables_and_gives_json(run: Run, arm_shot: ArmShot) -> None:
    shown, given = run("inspect", arm_shot()), run("inspect", arm_shot(name="b.usda"), "--json=-")
    assert "/Arm/Skeleton/Edit/Wrist" in shown.out
    assert "no faults found" in shown.out
    assert json.loads(given.out)["edits"][0]["path"] == "/Arm/Skeleton/Edit"


def test_plugins_are_listed_with_their_options(run: Run) -> None:
    document = json.loads(run("plugins", "--json", "-").out)
    assert {line["name"] for line in document["plugins"]} >= {"bvh", "prioritized_ik"}
    names = [line["option"] for line in document["options"] if line["of"] == "prioritized_ik"]
    assert "iterations" in names
    assert "prioritized_ik" in run("plugins").out


def test_demos_are_listed_where_none_is_named(run: Run) -> None:
    assert "reaching" in run("demo").out.split()
    said = run("demo", "flying")
    assert said.status == 2 and "there is no demo 'flying'; there are: " in said.err


def test_the_schema_can_be_found_without_usd() -> None:
    for word in ("path", "env"):
        script = (
            "import sys; sys.modules['pxr'] = None; "
            f"sys.argv = ['usdmotion', 'schema', '{word}']; "
            "from usdmotion.cli import main; main()"
        )
        said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        assert said.returncode == 0, said.stderr
        folder = said.stdout.strip().removeprefix("PXR_PLUGINPATH_NAME=").split(os.pathsep)[0]
        assert Path(folder, "plugInfo.json").is_file()


def test_the_schema_is_checked(run: Run) -> None:
    said = run("schema", "check")
    assert said.status == 0
    assert "USD knows its" in said.out


def test_the_installed_command_runs() -> None:
    command = Path(sys.executable).with_name("usdmotion")
    said = subprocess.run([command, "--help"], capture_output=True, text=True)
    assert said.returncode == 0 and "solve" in said.stdout


def test_the_module_runs_too() -> None:
    said = subprocess.run(
        [sys.executable, "-m", "usdmotion", "plugins", "--json", "-"],
        capture_output=True,
        text=True,
    )
    assert len(json.loads(said.stdout)["plugins"]) == len(host().plugins)

"""Every command and example of the documents is carried out, in their order.

A fenced block is one of these; `text` and blocks without a language are only shown.

* `sh`: run in an empty folder that has copies of `stages/` and a captured `walk.bvh`, with this
  environment in place of `.venv`. What sets an environment up or runs whole suites is left to
  `.ci/run` and `test_house.py`; here only the program has to be there.
* `python`: run as a script in the same folder.
* `usda`: has to parse; with a name after the language, as in "usda shot.usda", it is written to
  that file, for the blocks below it.
"""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from pxr import Sdf

from usdmotion import cli

HOUSE = Path(__file__).parents[1]
BIN = Path(sys.executable).parent
DOCUMENTS = [HOUSE / name for name in ("README.md", "CONTRIBUTING.md")]
LEFT_TO_OTHERS = ("pytest", "ruff", "mypy", "lint-imports", "build", "pip install", "-m venv")
WALK = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftUpLeg
  {
    OFFSET 9 -5 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT LeftLeg
    {
      OFFSET 0 -42 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {
        OFFSET 0 -42 0
      }
    }
  }
}
MOTION
Frames: 24
Frame Time: 0.0333333
""" + "".join(f"0 90 {3 * frame} 0 0 0 0 {-frame} 0 0 {2 * frame} 0\n" for frame in range(24))


@dataclass(frozen=True)
class Block:
    language: str
    name: str
    text: str


def blocks(document: Path) -> list[Block]:
    text = document.read_text(encoding="utf-8")
    found = re.findall(r"^```(\w+)[ ]*(\S*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [Block(*each) for each in found]


def run(command: list[str], folder: Path) -> None:
    path = os.pathsep.join([str(BIN), os.environ["PATH"]])
    said = subprocess.run(
        command, cwd=folder, env=os.environ | {"PATH": path}, capture_output=True, text=True
    )
    assert said.returncode == 0, f"{command[-1]}\n{said.stdout}\n{said.stderr}"


def run_shell(text: str, folder: Path) -> None:
    for line in text.replace("\\\n", " ").splitlines():
        steps = [step.strip() for step in line.split("&&")]
        own = [step for step in steps if step and not is_left_to_others(step)]
        if own:
            command = " && ".join(own).replace(".venv/bin/", f"{BIN}/")
            run(["bash", "-euc", command], folder)


def is_left_to_others(step: str) -> bool:
    """Tell whether a step is carried out elsewhere; its program has to be there all the same."""
    if step.startswith(("#", "bash .ci/run", ".ci/run", "git clone", "cd ")):
        return True
    if not any(word in step for word in LEFT_TO_OTHERS):
        return False
    program = step.split()[0].removeprefix(".venv/bin/")
    assert shutil.which(program, path=f"{BIN}{os.pathsep}{os.environ['PATH']}"), program
    return True


def read_stage(text: str) -> None:
    whole = text if text.startswith("#usda") else f"#usda 1.0\n{text}"
    assert Sdf.Layer.CreateAnonymous(".usda").ImportFromString(whole), text


@pytest.mark.slow
@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_every_block_of_a_document_works(document: Path, tmp_path: Path) -> None:
    if not document.is_file():
        pytest.skip(f"{document.name} is not beside these tests")
    (tmp_path / "walk.bvh").write_text(WALK)
    if (HOUSE / "stages").is_dir():
        shutil.copytree(HOUSE / "stages", tmp_path / "stages")
    for block in blocks(document):
        if block.language == "sh":
            run_shell(block.text, tmp_path)
        elif block.language == "python":
            run([sys.executable, "-c", block.text], tmp_path)
        elif block.language == "usda":
            read_stage(block.text)
            if block.name:
                (tmp_path / block.name).write_text(block.text, encoding="utf-8")


@pytest.mark.skipif(not DOCUMENTS[0].is_file(), reason="README.md is not beside these tests")
def test_the_readme_names_every_verb() -> None:
    text = DOCUMENTS[0].read_text(encoding="utf-8")
    apps = (("", cli.app), ("schema ", cli.schema))
    for prefix, app in apps:
        for command in app.registered_commands:
            name = command.name or getattr(command.callback, "__name__", "")
            assert f"usdmotion {prefix}{name}" in text

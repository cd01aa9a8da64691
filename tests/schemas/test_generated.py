"""The committed files are what usdGenSchema makes of the source."""

import os
import shutil
import subprocess
import sys

import pytest
import usdmotion_schemas
from pxr import Usd

COMMITTED = ("schema.usda", "generatedSchema.usda", "plugInfo.json")


def generate(folder, *options):
    command = [sys.executable, "-m", "pxr.Usd.usdGenSchema", "-q", *options, "schema.usda", "."]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture
def folder(tmp_path):
    pytest.importorskip("jinja2")
    # Only the newest release wrote the committed files; an older one orders metadata differently.
    if Usd.GetVersion() < (0, 26, 5):
        pytest.skip("the committed files were generated with a later USD")
    for name in COMMITTED:
        shutil.copy(usdmotion_schemas.plugin_path() / name, tmp_path)
    return tmp_path


def test_the_committed_files_pass_the_validation_of_usdgenschema(folder):
    done = generate(folder, "-v")
    assert done.returncode == 0, done.stdout + done.stderr


def test_generating_again_changes_no_byte(folder):
    before = {name: (folder / name).read_bytes() for name in COMMITTED}
    done = generate(folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert {name: (folder / name).read_bytes() for name in COMMITTED} == before


def test_a_change_of_the_source_is_noticed(folder):
    source = (folder / "schema.usda").read_text()
    (folder / "schema.usda").write_text(
        source.replace("usdmotion:passes = 1", "usdmotion:passes = 2")
    )
    assert generate(folder, "-v").returncode != 0


def test_the_plugin_folder_is_found_without_importing_usd():
    code = (
        "import sys, usdmotion_schemas as s; p = s.plugin_path(); s.environment();"
        "assert (p / 'plugInfo.json').is_file() and (p / 'generatedSchema.usda').is_file();"
        "assert not any(name.split('.')[0] == 'pxr' for name in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], env=importable(), check=False)
    assert done.returncode == 0


def importable():
    """Return an environment in which a new process imports what this one does."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


def test_the_environment_names_our_folders_and_keeps_what_was_there(monkeypatch, tmp_path):
    monkeypatch.setenv("PXR_PLUGINPATH_NAME", "/studio/usd")
    (line,) = usdmotion_schemas.environment([tmp_path])
    name, _, value = line.partition("=")
    assert name == "PXR_PLUGINPATH_NAME"
    folders = value.split(os.pathsep)
    assert folders[0] == str(usdmotion_schemas.plugin_path())
    assert folders[1] == str(usdmotion_schemas.validation_path())
    assert folders[2] == str(usdmotion_schemas.usdview_path())
    assert folders[3:] == [str(tmp_path), "/studio/usd"]


def test_the_environment_is_enough_for_a_process_that_never_imports_usdmotion():
    lines = dict(line.split("=", 1) for line in usdmotion_schemas.environment())
    code = (
        "import sys; from pxr import Usd;"
        "assert Usd.SchemaRegistry().FindConcretePrimDefinition('MotionEdit');"
        "assert not any(name.split('.')[0] == 'usdmotion' for name in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], env={**importable(), **lines}, check=False)
    assert done.returncode == 0

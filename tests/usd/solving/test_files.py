"""Files in, files out: of either format, in any folder, once or again."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf

from usdmotion import pipeline

NAMES = ("translations", "rotations", "scales")
EXTRAS = """
    custom asset studio:near = @./textures/a.png@
    custom asset studio:gone = @../gone.png@
    custom asset[] studio:many = [@./textures/a.png@, @http://studio/b.png@]
    custom asset studio:takes.timeSamples = { 1: @./textures/a.png@, 3: @textures/a.png@ }
    custom asset studio:fixed = @/fixed/c.png@
"""


@pytest.fixture
def shot(text, save):
    held = text.hold(text.goal('uniform token usdmotion:mode = "offset"'))
    return save(text.man(edit=text.edit(held)))


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usd"])
def test_either_format_in_and_out_gives_the_same_arrays(shot, solve, suffix):
    wanted = solve(shot)
    other = shot.with_name(f"other{suffix}")
    Sdf.Layer.FindOrOpen(str(shot)).Export(str(other))
    answer = solve(other, suffix=suffix)
    for name in NAMES:
        for code in (1, 2, 3, 4, 5):
            found, same = (np.asarray(each.result(name).Get(code)) for each in (answer, wanted))
            assert found.tobytes() == same.tobytes()
    assert answer.layer.customLayerData == wanted.layer.customLayerData


@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
def test_solving_the_answer_again_gives_the_same_bytes(shot, solve, tmp_path, suffix):
    answer = solve(shot, suffix=suffix)
    first = Path(answer.layer.realPath).read_bytes()
    composed = Path(answer.new.GetRootLayer().realPath)
    for name in ("second", "third"):
        layer, above = tmp_path / f"{name}{suffix}", tmp_path / f"{name}.all.usda"
        pipeline.solve(composed, layer, compose=above)
        assert layer.read_bytes() == first
        composed = above


def test_a_muted_answer_is_the_shot(shot, solve):
    answer = solve(shot)
    answer.new.MuteLayer(answer.layer.identifier)
    before, after = answer.both("hip/head", (1, 2, 3))
    np.testing.assert_array_equal(after, before)


@pytest.fixture
def textured(text, save, tmp_path):
    """Return a shot whose source, in a folder of its own, names files beside it."""
    (tmp_path / "assets" / "textures").mkdir(parents=True)
    (tmp_path / "assets" / "textures" / "a.png").touch()
    animation = text.poses() + EXTRAS
    save(text.man(animation=animation), "assets/man.usda", "metersPerUnit = 1")
    return save('def "Man" (references = @./assets/man.usda@</Man>) {}')


def test_paths_of_assets_lead_from_the_answer_to_the_same_files(textured, solve):
    answer = solve(textured)
    source = answer.old.GetPrimAtPath("/Man/Walk")
    result = answer.new.GetPrimAtPath("/Man/Bones/Edit_result")
    for code in (1, 3):
        for name in ("near", "takes"):
            old, new = (prim.GetAttribute(f"studio:{name}").Get(code) for prim in (source, result))
            assert old.resolvedPath == new.resolvedPath != ""
            assert new.path == "../assets/textures/a.png"
    assert result.GetAttribute("studio:gone").Get().path == "../gone.png"
    assert result.GetAttribute("studio:fixed").Get().path == "/fixed/c.png"
    many = [each.path for each in result.GetAttribute("studio:many").Get()]
    assert many == ["../assets/textures/a.png", "http://studio/b.png"]


def test_answers_say_nothing_of_the_machine_and_hashes_nothing_of_the_folder(
    textured, solve, tmp_path
):
    answer = solve(textured)
    assert str(tmp_path) not in answer.layer.ExportToString()
    moved = tmp_path.with_name(f"{tmp_path.name}_moved")
    textured.parent.rename(moved)
    first = (moved / "answers" / "edit.usda").read_bytes()
    for shot in ("shot.usda", "answers/composed.usda"):
        pipeline.solve(moved / shot, moved / "answers" / "again.usda")
        assert (moved / "answers" / "again.usda").read_bytes() == first

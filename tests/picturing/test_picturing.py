"""Pictures are files: whole or not at all, the same bytes each time, and no file of a stage."""

import re
import sys

import pytest

from usdmotion import pipeline
from usdmotion.errors import FileError, InputError

FRAMES = (2.0,)


def test_a_picture_is_the_same_bytes_each_time_and_small(shots, tmp_path):
    told = [
        pipeline.picture(shots.composed, tmp_path / name, frames=FRAMES)
        for name in ("one.png", "two.png")
    ]
    first, second = ((tmp_path / name).read_bytes() for name in ("one.png", "two.png"))
    assert first == second
    assert first.startswith(b"\x89PNG")
    assert len(first) < 60_000
    assert told[0].frames == FRAMES
    assert told[0].rows == ("before", "after")
    assert told[0].skeletons == ("/Asked/Skeleton", "/Idle/Skeleton")
    assert not told[0].notes
    assert sorted(each.name for each in tmp_path.iterdir()) == ["one.png", "two.png"]


def test_a_picture_may_be_lines(shots, tmp_path):
    from xml.etree import ElementTree

    pipeline.picture(shots.shot, tmp_path / "strip.svg", frames=FRAMES)
    root = ElementTree.parse(tmp_path / "strip.svg").getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.get("width").endswith("pt")


def test_what_is_stale_is_drawn_and_told(shots, tmp_path):
    for each in (shots.shot, shots.layer, shots.composed):
        text = each.read_text()
        assert each is not shots.shot or "(0, 0.05, 0)" in text
        (tmp_path / each.name).write_text(text.replace("(0, 0.05, 0)", "(0, 0.07, 0)"))
    told = pipeline.picture(tmp_path / "both.usda", tmp_path / "both.png", frames=FRAMES)
    assert any("is stale" in note for note in told.notes)


@pytest.mark.parametrize("name", ["strip.jpg", "strip", "strip.usda"])
def test_what_is_no_picture_is_refused(shots, tmp_path, name):
    with pytest.raises(FileError, match=re.escape(".png or .svg")):
        pipeline.picture(shots.shot, tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there_is_refused(shots, tmp_path):
    with pytest.raises(FileError, match="there is no folder"):
        pipeline.picture(shots.shot, tmp_path / "absent" / "strip.png", frames=FRAMES)


def test_a_picture_that_a_stage_is_made_of_is_not_written_to(shots, tmp_path):
    shot = tmp_path / "shot.usda"
    shot.write_text(shots.shot.read_text())
    linked = tmp_path / "shot.png"
    linked.symlink_to(shot)
    with pytest.raises(FileError, match="no input is written to"):
        pipeline.picture(shot, linked, frames=FRAMES)
    assert shot.read_text() == shots.shot.read_text()


def test_without_matplotlib_a_person_is_told_what_to_install(shots, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(InputError, match=re.escape("pip install 'usdmotion[report]'")):
        pipeline.picture(shots.shot, tmp_path / "strip.png")

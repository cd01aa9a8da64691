"""Guides from file to file: over a shot, a result or a layer, in a file or in the layer itself."""

import json
import shutil
from pathlib import Path

import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import demos, pipeline
from usdmotion.errors import FileError, SceneError

EDIT = "/Arm/Skeleton/Edit"


@pytest.fixture
def edited(arm_shot, tmp_path):
    """Return a shot, and the layer of a result in which a wrist is too far away."""
    shot = arm_shot(2.0)
    pipeline.solve(shot, tmp_path / "arm.edit.usda", compose=tmp_path / "composed.usda")
    return shot, tmp_path / "arm.edit.usda", tmp_path / "composed.usda"


def drawn(path: Path) -> list[str]:
    """Return the paths of what is drawn on a stage and bounded."""
    stage = Usd.Stage.Open(str(path))
    return [
        str(prim.GetPath())
        for prim in stage.Traverse()
        if UsdGeom.Gprim(prim) and UsdGeom.Gprim(prim).ComputePurpose() == "guide"
    ]


def content(path: Path) -> str:
    """Return what a layer says of its prims."""
    layer = Sdf.Layer.OpenAsAnonymous(str(path))
    layer.subLayerPaths.clear()
    layer.customLayerData = {}
    return layer.ExportToString()


def test_a_shot_is_drawn_as_it_asks_and_a_result_with_what_became_of_it(edited, tmp_path):
    output = tmp_path / "guides.usda"
    shot, edit, composed = edited
    (asked,) = pipeline.guides(shot, output).edits
    assert (asked.solved, asked.trajectories, asked.goals, asked.missed) == (False, 1, 1, ())
    before = drawn(output)
    (became,) = pipeline.guides(edit, output).edits
    assert became.solved and became.missed == ("Wrist",)
    assert set(before) < set(drawn(output))
    as_layer = content(output)
    pipeline.guides(composed, output)
    assert content(output) == as_layer


def test_what_is_drawn_over_are_the_sublayers(edited, tmp_path):
    shot, edit, _ = edited
    output = tmp_path / "folder" / "guides.usda"
    output.parent.mkdir()
    pipeline.guides(edit, output)
    layer = Sdf.Layer.FindOrOpen(str(output))
    assert list(layer.subLayerPaths) == ["../arm.edit.usda", "../arm.usda"]
    elsewhere = Path(shutil.move(shot, tmp_path / "other.usda"))
    with pytest.raises(SceneError, match="name it with --shot FILE"):
        pipeline.guides(edit, output)
    pipeline.guides(edit, tmp_path / "again.usda", shot=elsewhere)
    assert drawn(tmp_path / "again.usda")


def test_guides_are_never_read_as_anything_but_guides(edited, tmp_path):
    _, edit, composed = edited
    first, again, solved = (tmp_path / name for name in ("one.usda", "two.usda", "again.usda"))
    pipeline.guides(composed, first)
    assert not pipeline.inspect(first).faults
    pipeline.guides(first, again)
    assert content(first) == content(again)
    pipeline.solve(first, solved)
    assert solved.read_bytes() == edit.read_bytes()
    pipeline.guides(first, again)
    assert pipeline.guides(composed, first).notes == ()


def test_the_same_stage_gives_the_same_bytes(edited, tmp_path):
    outputs = [tmp_path / name for name in ("one.usda", "two.usda")]
    for output in outputs:
        pipeline.guides(edited[2], output)
    assert outputs[0].read_bytes() == outputs[1].read_bytes()


def test_a_solve_draws_into_its_layer_or_into_a_file(edited, tmp_path):
    shot, edit, _ = edited
    within, beside, file = (tmp_path / name for name in ("in.usda", "beside.usda", "guides.usda"))
    pipeline.solve(shot, within, guides=True)
    pipeline.solve(shot, beside, guides=file)
    assert beside.read_bytes() == edit.read_bytes()
    layer = Sdf.Layer.FindOrOpen(str(file))
    assert list(layer.subLayerPaths) == ["./beside.usda", "./arm.usda"]
    stage = Usd.Stage.Open(str(within))
    there = [prim for prim in stage.TraverseAll() if prim.GetName().startswith("Guides")]
    assert there and not pipeline.guides(within, file, shot=shot).notes


def test_a_detection_draws_its_contacts_itself_or_all_there_is_into_a_file(arm_shot, tmp_path):
    shot = arm_shot()
    within, beside, none, file = (tmp_path / f"{name}.usda" for name in "abcd")
    pipeline.detect(shot, within, joints=["base"])
    pipeline.detect(shot, none, joints=["base"], guides=False)
    pipeline.detect(shot, beside, joints=["base"], guides=file)
    assert content(none) == content(beside) and drawn(none) == []
    assert drawn(within) and set(drawn(within)) <= set(drawn(file))


def test_contacts_of_props_are_drawn_where_nothing_is_asked(tmp_path):
    shot, found = demos.build("dice", tmp_path), tmp_path / "contacts.usda"
    pipeline.detect(shot, found, prims=["/Dice/First"], guides=False)
    report = pipeline.guides(found, tmp_path / "guides.usda")
    assert report.edits == () and report.contacts > 0
    assert [each.object for each in report.objects] == ["/Dice/First"]
    assert json.loads(report.to_json())["objects"][0]["contacts"] == report.contacts
    with pytest.raises(SceneError, match=r"dice.usda: there is nothing to draw"):
        pipeline.guides(shot, tmp_path / "more.usda")
    assert not (tmp_path / "more.usda").exists()


def test_nothing_is_written_where_something_is_at_fault(edited, tmp_path):
    shot, edit, _ = edited
    there = {path: path.read_bytes() for path in tmp_path.iterdir()}
    for output, said in (
        (shot, "no input is written to"),
        (tmp_path / "none" / "guides.usda", "there is no folder"),
        (tmp_path / "guides.txt", "name a file that ends in"),
    ):
        with pytest.raises(FileError, match=said):
            pipeline.guides(edit, output)
        with pytest.raises(FileError, match=said):
            pipeline.solve(shot, tmp_path / "new.usda", guides=output)
        with pytest.raises(FileError, match=said):
            pipeline.detect(shot, tmp_path / "new.usda", joints=["base"], guides=output)
    with pytest.raises(FileError, match="two things are to be written there"):
        pipeline.solve(shot, tmp_path / "new.usda", guides=tmp_path / "new.usda")
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == there

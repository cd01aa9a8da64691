"""Where results go, and that they are seen there."""

import pytest
from pxr import Sdf, Usd

from usdmotion.errors import FileError
from usdmotion.usdview.destinations import choose, destination, put_over
from usdmotion.usdview.running import Desk


@pytest.fixture
def stage(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "shot.usda"))
    stage.SetTimeCodesPerSecond(30)
    stage.DefinePrim("/World", "Xform")
    stage.GetRootLayer().Save()
    return stage


def edit(stage, desk):
    """Do something there, and return what its place is called."""
    with destination(stage, desk) as place:
        attribute = stage.GetPrimAtPath("/World").CreateAttribute("note", Sdf.ValueTypeNames.Double)
        attribute.Set(1.0, 15.0)
    assert stage.GetPrimAtPath("/World").GetAttribute("note").GetTimeSamples() == [15.0]
    return place


def chosen(stage, file):
    desk = Desk()
    choose(stage, desk, str(file))
    return desk


def has_it(layer):
    return bool(layer.GetAttributeAtPath("/World.note"))


def test_the_session_layer_at_first(stage):
    stage.SetEditTarget(stage.GetRootLayer())
    assert edit(stage, Desk()) == "the session layer"
    assert has_it(stage.GetSessionLayer()) and not stage.GetRootLayer().dirty
    assert stage.GetEditTarget().GetLayer() == stage.GetRootLayer()


def test_the_edit_target_that_is_set(stage):
    stage.SetEditTarget(stage.GetRootLayer())
    assert edit(stage, Desk(destination="to_target")) == "shot.usda"
    assert has_it(stage.GetRootLayer()) and not has_it(stage.GetSessionLayer())


@pytest.mark.parametrize("ending", ["usda", "usdc"])
def test_a_file_is_made_shown_and_on_disk_after_each_command(stage, tmp_path, ending):
    file = tmp_path / f"results.{ending}"
    desk = chosen(stage, file)
    for _ in range(2):
        assert edit(stage, desk) == str(file)
    layer = Sdf.Layer.OpenAsAnonymous(str(file))
    assert has_it(layer) and layer.timeCodesPerSecond == 30
    assert list(stage.GetSessionLayer().subLayerPaths) == [str(file)]
    assert not stage.GetRootLayer().dirty


def test_a_file_is_put_over_a_stage_that_is_opened_again(stage, tmp_path):
    file = tmp_path / "results.usda"
    desk = chosen(stage, file)
    edit(stage, desk)
    again = Usd.Stage.Open(stage.GetRootLayer(), Sdf.Layer.CreateAnonymous())
    assert not again.GetPrimAtPath("/World").HasAttribute("note")
    edit(again, desk)


def test_a_file_is_not_for_another_stage_that_is_opened_then(stage, tmp_path):
    file = tmp_path / "results.usda"
    desk = chosen(stage, file)
    before = file.read_bytes()
    other = Usd.Stage.CreateNew(str(tmp_path / "other.usda"))
    other.DefinePrim("/World", "Xform")
    assert edit(other, desk) == "the session layer"
    assert desk.destination == "to_session" and file.read_bytes() == before
    assert not other.GetSessionLayer().subLayerPaths


def test_what_is_in_a_file_stays(stage, tmp_path):
    file = tmp_path / "results.usda"
    file.write_text('#usda 1.0\n(\ntimeCodesPerSecond = 60\n)\ndef Scope "Kept" {}\n')
    edit(stage, chosen(stage, file))
    layer = Sdf.Layer.OpenAsAnonymous(str(file))
    assert layer.GetPrimAtPath("/Kept")
    assert layer.ListTimeSamplesForPath("/World.note") == [30.0]  # its own time codes


def test_a_sublayer_of_the_stage_is_written_where_it_is(stage, tmp_path):
    file = tmp_path / "beneath.usda"
    Sdf.Layer.CreateNew(str(file)).Save()
    stage.GetRootLayer().subLayerPaths.append("./beneath.usda")
    put_over(stage, str(file))
    assert not stage.GetSessionLayer().subLayerPaths


def refusal(stage, path):
    with pytest.raises(FileError) as refused:
        put_over(stage, str(path))
    assert not stage.GetSessionLayer().subLayerPaths
    return str(refused.value)


def test_what_is_no_place_for_results(stage, tmp_path):
    assert "this is the stage itself" in refusal(stage, tmp_path / "shot.usda")
    assert "name a file that ends in .usda" in refusal(stage, tmp_path / "results.txt")
    assert "there is no folder" in refusal(stage, tmp_path / "nowhere" / "results.usda")
    (tmp_path / "broken.usda").write_text("no layer")
    assert "USD cannot read it" in refusal(stage, tmp_path / "broken.usda")


def test_a_file_that_the_stage_refers_to_is_no_place_either(stage, tmp_path):
    file = tmp_path / "asset.usda"
    file.write_text('#usda 1.0\n(\ndefaultPrim = "Asset"\n)\ndef Scope "Asset" {}\n')
    stage.DefinePrim("/Asset").GetReferences().AddReference(str(file))
    assert "the stage refers to it" in refusal(stage, file)

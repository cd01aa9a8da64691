"""A layer over a shot while it is being made."""

import pytest
from pxr import Sdf, Tf, Ts, Usd

from usdmotion import FileError, SceneError
from usdmotion.usd import Overlay
from usdmotion.usd.layers import save

HEADER = """metersPerUnit = 0.01
upAxis = "Z"
timeCodesPerSecond = 48
framesPerSecond = 12
startTimeCode = 3
endTimeCode = 9
defaultPrim = "World\""""


@pytest.fixture
def shot(save):
    return save('def Xform "World" {}', header=HEADER)


def test_it_shows_the_shot_and_is_read_alike(shot, tmp_path):
    overlay = Overlay.open(shot, tmp_path / "over.usda")
    overlay.stage.DefinePrim("/World/Made", "Scope")
    overlay.write()
    stage = Usd.Stage.Open(str(tmp_path / "over.usda"))
    assert stage.GetPrimAtPath("/World/Made")
    assert stage.GetDefaultPrim().GetName() == "World"
    assert stage.GetMetadata("upAxis") == "Z"
    assert stage.GetMetadata("metersPerUnit") == 0.01
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (48.0, 12.0)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (3.0, 9.0)
    assert stage.GetMetadata("fallbackPrimTypes")["MotionDetection"] == ["Scope"]


def test_it_names_its_shot_by_the_way_there(shot, tmp_path):
    (tmp_path / "deep").mkdir()
    overlay = Overlay.open(shot, tmp_path / "deep" / "over.usda")
    overlay.write()
    layer = Sdf.Layer.FindOrOpen(str(tmp_path / "deep" / "over.usda"))
    assert list(layer.subLayerPaths) == ["../shot.usda"]
    # What is open goes on: nothing of it has changed by being written.
    assert overlay.stage.GetPrimAtPath("/World")


def test_it_adds_to_what_it_says_of_itself(shot, tmp_path):
    overlay = Overlay.open(shot, tmp_path / "over.usda")
    overlay.remember(one={"a": "b"})
    overlay.remember(two=2)
    said = overlay.stage.GetRootLayer().customLayerData["usdmotion"]
    assert {key: said[key] for key in ("one", "two")} == {"one": {"a": "b"}, "two": 2}
    assert said["version"]


def test_an_input_is_not_written_to_and_nothing_is_made_before_it_is_whole(shot, tmp_path):
    with pytest.raises(FileError, match="no input is written to"):
        Overlay.open(shot, shot)
    with pytest.raises(FileError, match="there is no such file"):
        Overlay.open(tmp_path / "none.usda", tmp_path / "over.usda")
    Overlay.open(shot, tmp_path / "over.usda")
    assert not (tmp_path / "over.usda").exists()


def test_a_shot_that_does_not_compose_is_refused(save, tmp_path):
    broken = save('def Xform "World" (references = @./gone.usda@) {}')
    with pytest.raises(SceneError, match=r"shot.usda: .*does not compose"):
        Overlay.open(broken, tmp_path / "over.usda")


def test_usd_warns_of_nothing_when_a_spline_is_written(tmp_path, capfd):
    stage = Usd.Stage.CreateInMemory(".usda")
    spline = Ts.Spline("double")
    spline.SetKnot(Ts.Knot(typeName="double", time=1.0, value=2.0, nextInterp=Ts.InterpCurve))
    curve = stage.DefinePrim("/A").CreateAttribute("curve", Sdf.ValueTypeNames.Double)
    curve.SetSpline(spline)
    capfd.readouterr()
    save(stage.GetRootLayer(), tmp_path / "curve.usda")
    assert capfd.readouterr().err == ""
    Tf.Warn("heard")
    assert "heard" in capfd.readouterr().err

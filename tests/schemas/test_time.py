"""Times follow a layer offset, doubles do not, and splines carry what is animated."""

import pytest
from pxr import Sdf, Ts, Usd

from usdmotion.usd import registration

registration.register()

TIMED = [
    ("MotionEdit", "range"),
    ("MotionPositionConstraint", "times"),
    ("MotionGoal", "times"),
    ("MotionTrajectoryConstraint", "keys"),
    ("MotionTrajectoryConstraint", "releases"),
]
SPLINED = [
    ("MotionPositionConstraint", "activity"),
    ("MotionGoal", "activity"),
    ("MotionDetection", "sigmaMax"),
    ("MotionDetection", "epsilonMax"),
]


def author(schema):
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    return layer, stage, stage.DefinePrim("/Prim", schema)


def under(layer, offset):
    """Return the prim as a stage sees it that has the layer as a sublayer with an offset."""
    root = Sdf.Layer.CreateAnonymous(".usda")
    root.subLayerPaths.append(layer.identifier)
    root.subLayerOffsets[0] = offset
    stage = Usd.Stage.Open(root)
    return stage, stage.GetPrimAtPath("/Prim")


@pytest.mark.parametrize("schema, name", TIMED)
def test_times_are_moved_and_scaled_with_their_layer(schema, name):
    layer, _source, prim = author(schema)
    prim.GetAttribute(f"usdmotion:{name}").Set(Sdf.TimeCodeArray([1.0, 2.0]))
    _stage, seen = under(layer, Sdf.LayerOffset(10.0, 2.0))
    found = seen.GetAttribute(f"usdmotion:{name}").Get()
    assert [float(time) for time in found] == [12.0, 14.0]


def test_doubles_stay_what_they_are_under_a_layer_offset():
    layer, _source, prim = author("MotionDetection")
    prim.GetAttribute("usdmotion:gap").Set(0.4)
    _stage, seen = under(layer, Sdf.LayerOffset(10.0, 2.0))
    assert seen.GetAttribute("usdmotion:gap").Get() == 0.4


def test_times_follow_a_change_of_the_rate():
    layer, source, prim = author("MotionGoal")
    source.SetTimeCodesPerSecond(30.0)
    prim.GetAttribute("usdmotion:times").Set(Sdf.TimeCodeArray([30.0, 60.0]))
    root = Sdf.Layer.CreateAnonymous(".usda")
    root.timeCodesPerSecond = 24.0
    root.subLayerPaths.append(layer.identifier)
    stage = Usd.Stage.Open(root)
    found = stage.GetPrimAtPath("/Prim").GetAttribute("usdmotion:times").Get()
    assert [float(time) for time in found] == [24.0, 48.0]


def spline(*knots):
    made = Ts.Spline("double")
    for time, value in knots:
        made.SetKnot(Ts.Knot(time=time, value=value, nextInterp=Ts.InterpLinear))
    return made


@pytest.mark.parametrize("schema, name", SPLINED)
def test_what_is_meant_for_a_spline_takes_one_and_is_read_between_its_knots(schema, name):
    layer, _source, prim = author(schema)
    prim.GetAttribute(f"usdmotion:{name}").SetSpline(spline((0.0, 0.0), (10.0, 1.0)))
    read = Sdf.Layer.CreateAnonymous(".usda")
    assert read.ImportFromString(layer.ExportToString())
    stage = Usd.Stage.Open(read)
    attribute = stage.GetPrimAtPath("/Prim").GetAttribute(f"usdmotion:{name}")
    assert attribute.HasSpline() and attribute.GetTimeSamples() == []
    assert attribute.Get(2.5) == pytest.approx(0.25)


def test_a_spline_is_moved_and_scaled_with_its_layer():
    layer, _source, prim = author("MotionGoal")
    prim.GetAttribute("usdmotion:activity").SetSpline(spline((0.0, 0.0), (10.0, 1.0)))
    _stage, seen = under(layer, Sdf.LayerOffset(100.0, 2.0))
    assert seen.GetAttribute("usdmotion:activity").Get(105.0) == pytest.approx(0.25)

"""Prims go from a layer of a stage to a weaker one, and the stage shows the same."""

import pytest
from pxr import Sdf, Usd

from usdmotion.usd.drafts import move_prims

SAID = """#usda 1.0
(
    customLayerData = {
        dictionary usdmotion = { string version = "1" }
        int studio = 7
    }
    timeCodesPerSecond = 24
)
over "World" {
    double moved.timeSamples = { 0: 0, 10: 5 }
    def Scope "New" { uniform timecode[] times = [5, 10] }
}
"""
THERE = """#usda 1.0
(
    timeCodesPerSecond = 48
)
def Xform "World" {
    double moved = 3
    def Scope "Kept" {}
}
"""


@pytest.fixture
def stage():
    beneath = Sdf.Layer.CreateAnonymous("beneath.usda")
    beneath.ImportFromString(THERE.replace("{}", "{\n}"))
    root = Sdf.Layer.CreateAnonymous("root.usda")
    root.timeCodesPerSecond = 24
    root.subLayerPaths.append(beneath.identifier)
    root.subLayerOffsets[0] = Sdf.LayerOffset(100.0)
    session = Sdf.Layer.CreateAnonymous("session.usda")
    session.ImportFromString(SAID.replace("[5, 10] }", "[5, 10]\n}"))
    return Usd.Stage.Open(root, session), beneath


def shown(stage):
    times = stage.GetAttributeAtPath("/World/New.times").Get()
    moved = stage.GetAttributeAtPath("/World.moved")
    return [float(code) for code in times], moved.GetTimeSamples(), moved.Get(5.0)


def test_the_stage_shows_the_same_and_the_other_layer_is_empty(stage):
    stage, beneath = stage
    before = shown(stage)
    assert before == ([5.0, 10.0], [0.0, 10.0], 2.5)
    move_prims(stage, stage.GetSessionLayer(), beneath)
    assert shown(stage) == before
    assert not stage.GetSessionLayer().rootPrims
    assert beneath.ListTimeSamplesForPath("/World.moved") == [-200.0, -180.0]
    assert beneath.GetPrimAtPath("/World/Kept")


def test_what_we_say_of_a_layer_goes_along_and_what_others_say_stays(stage):
    stage, beneath = stage
    move_prims(stage, stage.GetSessionLayer(), beneath)
    assert beneath.customLayerData == {"usdmotion": {"version": "1"}}
    assert stage.GetSessionLayer().customLayerData == {"studio": 7}


VARIANTS = """#usda 1.0
over "World" (
    variants = { string look = "new" }
    prepend variantSets = "look"
) {
    variantSet "look" = {
        "new" {
            over "Ball" {
                double size.timeSamples = { 0: 1, 10: 2 }
            }
        }
        "own" {
        }
    }
}
"""


def test_what_is_said_in_variants_goes_along(stage):
    stage, beneath = stage
    there = VARIANTS.replace("over", "def").replace("1, 10: 2", "7").replace('"own"', '"old"')
    beneath.ImportFromString(there)
    session = stage.GetSessionLayer()
    session.ImportFromString(VARIANTS)
    ball = "/World/Ball.size"
    before = [stage.GetAttributeAtPath(ball).Get(code) for code in (0.0, 5.0, 10.0)]
    assert before == [1.0, 1.5, 2.0]
    move_prims(stage, session, beneath)
    assert [stage.GetAttributeAtPath(ball).Get(code) for code in (0.0, 5.0, 10.0)] == before
    assert not session.rootPrims
    look = stage.GetPrimAtPath("/World").GetVariantSets().GetVariantSet("look")
    assert set(look.GetVariantNames()) == {"new", "own", "old"}

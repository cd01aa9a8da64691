"""What one layer says, put into another."""

import pytest
from pxr import Sdf, Usd

from usdmotion.usd.drafts.merging import merge, whole_or_not

THERE = """#usda 1.0
def Xform "A" (
    apiSchemas = ["GeomModelAPI"]
    customData = {
        int kept = 1
    }
    kind = "group"
)
{
    double size.timeSamples = { 1: 3, 2: 4 }
    double size (
        doc = "how big"
    )
    double other = 2
    rel aim = </B>
    def "Child"
    {
        int old = 1
    }
}
"""
MADE = """#usda 1.0
over "A" (
    prepend apiSchemas = ["MotionAPI"]
    customData = {
        int made = 2
    }
)
{
    double size = 5
    rel aim = </C>
    def "Child"
    {
        int young = 1
    }
    def "Other" {}
}
"""


def layer(text: str) -> Sdf.Layer:
    made = Sdf.Layer.CreateAnonymous(".usda")
    assert made.ImportFromString(text)
    return made


def test_it_is_as_if_one_layer_were_over_the_other() -> None:
    there, made = layer(THERE), layer(MADE)
    above = Sdf.Layer.CreateAnonymous(".usda")
    above.subLayerPaths[:] = [made.identifier, there.identifier]
    expected = Usd.Stage.Open(above).Flatten()
    merged = layer(THERE)
    merge(made, merged, set())
    found = Usd.Stage.Open(merged).Flatten()
    assert found.GetPrimAtPath("/A").GetAsText() == expected.GetPrimAtPath("/A").GetAsText()
    assert merged.GetAttributeAtPath("/A.size").GetInfo("documentation") == "how big"


def test_a_prim_that_is_put_whole_takes_the_place_of_what_is_there() -> None:
    merged = layer(THERE)
    merge(layer(MADE), merged, {Sdf.Path("/A/Child")})
    assert [each.name for each in merged.GetPrimAtPath("/A/Child").properties] == ["young"]
    assert merged.GetPrimAtPath("/A/Other")


def test_a_layer_is_as_it_was_when_something_fails() -> None:
    merged = layer(THERE)
    with pytest.raises(RuntimeError), whole_or_not(merged):
        merge(layer(MADE), merged, set())
        raise RuntimeError
    assert merged.ExportToString() == layer(THERE).ExportToString()

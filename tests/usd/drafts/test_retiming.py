"""A layer in other time codes says what USD makes of it under the same layer offset."""

import pytest
from pxr import Sdf, Usd

from usdmotion.usd.drafts.retiming import retime

LAYER = """#usda 1.0
def "A" (
    customData = {
        dictionary usdmotion = {
            timecode[] times = [1, 2]
            double plain = 4
        }
    }
)
{
    double moving.timeSamples = { 1: 0, 2: 3, 8: 5 }
    timecode when = 7
    timecode[] times.timeSamples = { 1: [1, 2], 3: [4, 5] }
    double still = 7
    double curve.spline = {
        pre: sloped(0.5),
        post: held,
        1: 0; post curve (1, 0.5),
        5: 2; pre (1, 0.2),
    }
    double round.spline = {
        post: loop repeat,
        1: 0; post curve (1, 0.5),
        5: 2; pre (1, 0.2),
    }
    double within.spline = {
        loop: (1, 5, 1, 2, 0.5),
        1: 0; post curve (1, 0.5),
        5: 2; pre (1, 0.2),
    }
}
"""


@pytest.mark.parametrize(("offset", "scale"), [(3.0, 2.0), (-1.25, 0.625), (10.0, 1.0)])
def test_it_is_as_it_would_be_under_that_offset(offset: float, scale: float) -> None:
    layer, above = Sdf.Layer.CreateAnonymous(".usda"), Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(LAYER)
    above.subLayerPaths.append(layer.identifier)
    above.subLayerOffsets[0] = Sdf.LayerOffset(offset, scale)
    moved = Sdf.Layer.CreateAnonymous(".usda")
    moved.TransferContent(layer)
    retime(moved, Sdf.LayerOffset(offset, scale))
    stages = [Usd.Stage.Open(each) for each in (above, moved)]
    expected, found = (stage.GetPrimAtPath("/A") for stage in stages)
    codes = [Usd.TimeCode.Default(), *(0.5 * half for half in range(-30, 90))]
    for attribute in expected.GetAttributes():
        other = found.GetAttribute(attribute.GetName())
        assert other.GetTimeSamples() == pytest.approx(attribute.GetTimeSamples())
        for code in codes:
            assert told(other.Get(code)) == pytest.approx(told(attribute.Get(code))), attribute
    remembered = [told(each.GetCustomDataByKey("usdmotion:times")) for each in (expected, found)]
    assert remembered[1] == pytest.approx(remembered[0])
    assert found.GetCustomDataByKey("usdmotion:plain") == 4.0


def told(value: object) -> list[float]:
    if value is None:
        return []
    return [float(each) for each in value] if hasattr(value, "__len__") else [float(value)]

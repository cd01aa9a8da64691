"""What a stronger layer would hide is refused, whatever the times of the layers are."""

import pytest
from pxr import Sdf, Usd

from usdmotion.errors import SceneError
from usdmotion.usd import Draft

STRONG = """#usda 1.0
def Scope "World" {
    double moved.timeSamples = { 1: 5 }
}
"""


@pytest.fixture
def stage():
    """Return a stage whose edit target is under a layer that is 100 time codes later."""
    strong, weak = (Sdf.Layer.CreateAnonymous(f"{name}.usda") for name in ("strong", "weak"))
    strong.ImportFromString(STRONG)
    root = Sdf.Layer.CreateAnonymous("root.usda")
    root.subLayerPaths[:] = [strong.identifier, weak.identifier]
    root.subLayerOffsets[0] = Sdf.LayerOffset(100.0)
    stage = Usd.Stage.Open(root)
    stage.SetEditTarget(weak)
    return stage, strong, weak


def drafted(stage, code):
    draft = Draft(stage)
    prim = Sdf.CreatePrimInLayer(draft.layer, "/World")
    Sdf.AttributeSpec(prim, "moved", Sdf.ValueTypeNames.Double)
    draft.layer.SetTimeSample("/World.moved", code, 5.0)
    return draft


def test_equal_numbers_at_other_times_hide_what_is_written(stage):
    stage, _, weak = stage
    with pytest.raises(SceneError, match=r"moved> is authored in strong\.usda"):
        drafted(stage, 1.0).put()
    assert not weak.rootPrims
    drafted(stage, 101.0).put()
    assert weak.ListTimeSamplesForPath("/World.moved") == [101.0]


def test_a_list_of_schemas_that_leaves_one_out_hides_it(stage):
    stage, strong, weak = stage
    for listed, hides in ((["OtherAPI", "SkelBindingAPI"], False), (["OtherAPI"], True)):
        said = Sdf.TokenListOp.CreateExplicit(listed)
        strong.GetPrimAtPath("/World").SetInfo("apiSchemas", said)
        draft = Draft(stage)
        prim = Sdf.CreatePrimInLayer(draft.layer, "/World")
        prim.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=["SkelBindingAPI"]))
        if hides:
            with pytest.raises(SceneError, match="</World> is authored"):
                draft.put()
        else:
            draft.put()
            assert weak.GetPrimAtPath("/World").HasInfo("apiSchemas")

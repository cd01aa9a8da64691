"""What is drawn again is the same, and nothing stays of what is gone."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import guiding

EDIT = "/Walker/Skeleton/Reaching"
WRIST = f"{EDIT}/LeftWrist"


@pytest.fixture
def drawn_again(reached, reaching):
    """Return what draws on the stage of the result, in memory, over what was drawn or not."""
    stages = []

    def run(change=lambda stage: None, *, behind=False):
        below = reaching.GetRootLayer().identifier if behind else str(reached)
        layer = Sdf.Layer.CreateAnonymous(".usda")
        layer.subLayerPaths.append(below)
        stage = Usd.Stage.Open(layer)
        stages.append(stage)
        for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
            stage.SetMetadata(name, reaching.GetMetadata(name))
        stage.SetStartTimeCode(reaching.GetStartTimeCode())
        stage.SetEndTimeCode(reaching.GetEndTimeCode())
        guiding.guides_over(stage, Path("here.usda"))
        change(stage)
        guiding.guides_over(stage, Path("here.usda"))
        return stage

    return run


def everything(stage):
    """Return what is seen of guides at a moment, by their paths."""
    seen = {}
    for prim in stage.Traverse():
        if "/Guides" in str(prim.GetPath()) and prim.IsA(UsdGeom.PointBased):
            points = UsdGeom.PointBased(prim).GetPointsAttr().Get(73.0)
            matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(73.0)
            seen[str(prim.GetPath())] = np.array([matrix.Transform(each) for each in points])
    return seen


def assert_same(one, other):
    assert one.keys() == other.keys()
    for path, points in one.items():
        np.testing.assert_allclose(points, other[path], atol=1e-4, err_msg=path)


@pytest.mark.parametrize("behind", [False, True])
def test_again_draws_the_same(drawn_again, reaching, behind):
    assert_same(everything(drawn_again(behind=behind)), everything(reaching))


def test_again_writes_the_same(drawn_again):
    texts = []
    drawn_again(lambda stage: texts.append(stage.GetRootLayer().ExportToString()))
    stage = drawn_again()
    assert stage.GetRootLayer().ExportToString() == texts[0]


def test_of_what_is_switched_off_nothing_is_left_in_the_layer(drawn_again):
    stage = drawn_again(lambda stage: stage.GetPrimAtPath(WRIST).SetActive(False))
    assert not stage.GetRootLayer().GetPrimAtPath(f"{WRIST}/Guides")
    assert stage.GetRootLayer().GetPrimAtPath(f"{EDIT}/LeftHeel/Guides/After")


@pytest.mark.parametrize("behind", [False, True])
def test_of_a_goal_that_is_gone_nothing_is_seen(drawn_again, behind):
    def change(stage):
        stage.GetPrimAtPath(f"{WRIST}/Reach").SetActive(False)

    stage = drawn_again(change, behind=behind)
    guide = stage.GetPrimAtPath(f"{WRIST}/Guides/Reach")
    assert not guide or not guide.IsActive()
    assert stage.GetPrimAtPath(f"{WRIST}/Guides/After").IsActive()
    if not behind:
        assert not stage.GetRootLayer().GetPrimAtPath(f"{WRIST}/Guides/Reach")


@pytest.mark.parametrize("behind", [False, True])
def test_what_comes_back_is_seen_again(drawn_again, reaching, behind):
    def change(stage):
        goal = stage.GetPrimAtPath(f"{WRIST}/Reach")
        goal.SetActive(False)
        guiding.guides_over(stage, Path("here.usda"))
        goal.SetActive(True)

    assert_same(everything(drawn_again(change, behind=behind)), everything(reaching))


def test_what_somebody_calls_guides_is_left_to_him(drawn_again):
    def change(stage):
        stage.RemovePrim(f"{WRIST}/Guides")
        UsdGeom.Sphere.Define(stage, f"{WRIST}/Guides")

    stage = drawn_again(change)
    assert stage.GetPrimAtPath(f"{WRIST}/Guides").IsA(UsdGeom.Sphere)
    assert not stage.GetPrimAtPath(f"{WRIST}/Guides").GetChildren()
    assert stage.GetPrimAtPath(f"{WRIST}/Guides2/After")
    before = stage.GetRootLayer().ExportToString()
    guiding.guides_over(stage, Path("here.usda"))
    assert stage.GetRootLayer().ExportToString() == before


def test_in_a_layer_under_an_offset_times_are_those_of_the_stage(reached, reaching):
    layer, below = (Sdf.Layer.CreateAnonymous(".usda") for _ in range(2))
    layer.subLayerPaths.append(below.identifier)
    layer.subLayerPaths.append(str(reached))
    layer.subLayerOffsets[0] = Sdf.LayerOffset(7.0, 0.5)
    stage = Usd.Stage.Open(layer)
    for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
        stage.SetMetadata(name, reaching.GetMetadata(name))
    stage.SetStartTimeCode(reaching.GetStartTimeCode())
    stage.SetEndTimeCode(reaching.GetEndTimeCode())
    stage.SetEditTarget(stage.GetEditTargetForLocalLayer(below))
    guiding.guides_over(stage, Path("here.usda"))
    assert not layer.GetPrimAtPath(EDIT)
    assert_same(everything(stage), everything(reaching))
    opacities = [
        each.GetAttributeAtPath(f"{WRIST}/Guides/Reach.primvars:displayOpacity")
        for each in (stage, reaching)
    ]
    for code in (1.0, 55.0, 66.0, 73.0, 100.0):
        assert opacities[0].Get(code)[0] == pytest.approx(opacities[1].Get(code)[0])


def test_nothing_is_said_twice(reaching, carried):
    for stage in (reaching, carried):
        layer = stage.GetRootLayer()
        paths = []
        layer.Traverse("/", paths.append)
        for path in paths:
            codes = layer.ListTimeSamplesForPath(path) if path.IsPropertyPath() else []
            values = {str(layer.QueryTimeSample(path, code)) for code in codes}
            assert not codes or len(values) > 1, path


def test_what_somebody_else_has_drawn_for_people_is_left_to_him(drawn_again):
    own = ("/Sketches/Guides", "/Walker/Sketches/Guides")

    def change(stage):
        for path in own:
            guides = UsdGeom.Xform.Define(stage, path)
            guides.CreatePurposeAttr(UsdGeom.Tokens.guide)
            UsdGeom.Sphere.Define(stage, f"{path}/Ball")
            guides.GetPrim().GetParent().SetActive(False)

    layer = drawn_again(change).GetRootLayer()
    assert all(layer.GetPrimAtPath(f"{path}/Ball") for path in own)


def test_of_a_constraint_that_is_taken_away_nothing_is_left_in_the_layer(drawn_again):
    extra = f"{EDIT}/Extra"

    def change(stage):
        prim = stage.DefinePrim(extra, "MotionPositionConstraint")
        prim.GetAttribute("usdmotion:joint").Set("Hips/Spine")
        guiding.guides_over(stage, Path("here.usda"))
        spec = stage.GetRootLayer().GetPrimAtPath(extra)
        assert spec.nameChildren
        spec.specifier = Sdf.SpecifierOver
        spec.ClearInfo("typeName")
        del spec.properties["usdmotion:joint"]

    stage = drawn_again(change)
    assert not stage.GetRootLayer().GetPrimAtPath(extra)

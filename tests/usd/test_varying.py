"""A copy of a stage that asks for something else is that stage otherwise, and the stage stays."""

from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from usdmotion import demos
from usdmotion.errors import SceneError
from usdmotion.usd import vary

EDIT = "/Walker/Skeleton/Grasp"


@pytest.fixture(scope="module")
def shot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return demos.build("grasp", tmp_path_factory.mktemp("varied"))


def test_it_has_the_variant_without_what_is_switched_off_or_hidden(shot, tmp_path) -> None:
    before = shot.read_bytes()
    copy = tmp_path / "copy.usda"
    vary(shot, copy, variant="unreachable", without=["Balance"], hidden=["Walker"])
    stage = Usd.Stage.Open(str(copy))
    assert stage.GetPrimAtPath(EDIT).GetVariantSet("asked").GetVariantSelection() == "unreachable"
    assert not stage.GetPrimAtPath(f"{EDIT}/Balance").IsActive()
    assert stage.GetPrimAtPath(f"{EDIT}/LeftHeel").IsActive()
    walker = UsdGeom.Imageable(stage.GetPrimAtPath("/Walker"))
    assert walker.ComputeVisibility() == UsdGeom.Tokens.invisible
    assert shot.read_bytes() == before


def test_nothing_varied_is_the_stage_as_it_is(shot, tmp_path) -> None:
    vary(shot, tmp_path / "same.usda")
    assert (tmp_path / "same.usda").read_text() == shot.read_text()


@pytest.mark.parametrize(
    "varied", [{"variant": "sideways"}, {"without": ["Nobody"]}, {"hidden": ["Nobody"]}]
)
def test_what_is_not_there_is_named(shot, tmp_path, varied) -> None:
    with pytest.raises(SceneError, match=r"sideways|Nobody"):
        vary(shot, tmp_path / "not.usda", **varied)

"""Characters that other people made: each is read as UsdSkel has it, or refused in a sentence."""

from pathlib import Path

import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSkel

from usdmotion import usd
from usdmotion.constraints import built_in

NAMES = (
    "usd/CesiumMan.usdz",
    "usd/RiggedFigure.usdz",
    "usd/RiggedSimple.usdz",
    "usd/SoC-ElephantWithMonochord.usdc",
    "usd/arm_sparse_anim.usda",
    "usd/skel_dqs.usda",
    "usd/skel_lbs.usda",
    "usd/skeleton_66.usda",
    "usd/skinnedArm.usda",
    "odd/usd/twoBends.usda",
)
WITHOUT = ("odd/usd/badSkelBindingAPIApplied.usda", "odd/usd/badSkelBindingNoSkelRoot.usda")


def edited(source: Path, folder: Path) -> Path:
    """Write a stage over a captured one, with an edit of every skeleton."""
    below = Usd.Stage.Open(str(source))
    layer = Sdf.Layer.CreateNew(str(folder / "shot.usda"))
    layer.subLayerPaths.append(str(source))
    layer.timeCodesPerSecond = below.GetTimeCodesPerSecond()
    layer.framesPerSecond = below.GetFramesPerSecond()
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageMetersPerUnit(stage, UsdGeom.GetStageMetersPerUnit(below))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.GetStageUpAxis(below))
    for prim in stage.Traverse():
        if prim.IsA(UsdSkel.Skeleton):
            usd.author_edit(stage, f"{prim.GetPath()}/Edit")
    layer.Save()
    return folder / "shot.usda"


@pytest.mark.parametrize("name", NAMES)
def test_each_is_read_as_usd_has_it_and_written_back(mocap, tmp_path, check, name):
    span = (100, 200) if "Elephant" in name else None
    # Two of them have rotations of four digits, which are not quite of length one.
    rough = name in ("usd/arm_sparse_anim.usda", "usd/skinnedArm.usda")
    shot = check(edited(mocap / name, tmp_path), frames=span, atol=1e-4 if rough else 1e-5)
    assert shot.scenes


@pytest.mark.parametrize("name", NAMES + WITHOUT)
def test_each_can_be_inspected(mocap, name):
    found = usd.inspect(mocap / name, built_in())
    assert len(found.skeletons) == (0 if name in WITHOUT else 2 if "Elephant" in name else 1)

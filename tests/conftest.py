"""What several tests need."""

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.testing import arm_scene


@pytest.fixture(scope="session")
def mocap() -> Path:
    """Return the folder of captured clips, which are not part of the project."""
    named = os.environ.get("USDMOTION_MOCAP")
    places = [Path(named)] if named else [up / "shared/mocap" for up in Path(__file__).parents]
    for place in places:
        if place.is_dir():
            return place
    pytest.skip("the captured clips are not here; USDMOTION_MOCAP may name their folder")


ArmShot = Callable[..., Path]


@pytest.fixture
def arm_shot(tmp_path: Path) -> ArmShot:
    """Return what writes a stage whose edit </Arm/Skeleton/Edit> lifts a wrist by so much [m]."""
    from pxr import Usd, UsdGeom

    from usdmotion.usd import author, author_character, author_edit

    def write(lift: float = 0.05, *, name: str = "arm.usda", solver: str = "") -> Path:
        stage = Usd.Stage.CreateNew(str(tmp_path / name))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(24.0)
        stage.SetStartTimeCode(1.0)
        scene = arm_scene()
        (arm,) = scene.characters
        codes = scene.time_codes
        path = author_character(stage, "/Arm", arm.skeleton, arm.body, arm.motion, time_codes=codes)
        stage.SetEndTimeCode(codes[-1])
        author_edit(stage, f"{path}/Edit", solver=solver)
        wrist = PositionConstraint(
            path="",
            skeleton=path,
            joint="base/shoulder/elbow/wrist",
            recruits=("base/shoulder", "base/shoulder/elbow"),
            goals=(Goal(mode="offset", translation=np.array([0.0, lift, 0.0])),),
        )
        author(stage, f"{path}/Edit/Wrist", wrist)
        stage.GetRootLayer().Save()
        return tmp_path / name

    return write

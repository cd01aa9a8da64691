"""A stage with two arms, of which one is asked for something, and what became of it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from usdmotion import Goal, PositionConstraint, pipeline
from usdmotion.testing import arm_scene
from usdmotion.usd import author, author_character, author_edit

ASKED, IDLE = "/Asked/Skeleton", "/Idle/Skeleton"
WRIST = "base/shoulder/elbow/wrist"


@dataclass(frozen=True)
class Shots:
    """Files of one shot."""

    shot: Path
    """The arms as they are."""
    layer: Path
    """What lifts the wrist of one of them."""
    composed: Path
    """That layer over the shot."""


@pytest.fixture(scope="session")
def shots(tmp_path_factory: pytest.TempPathFactory) -> Shots:
    folder = tmp_path_factory.mktemp("arms")
    made = Shots(*(folder / name for name in ("arms.usda", "arms.edit.usda", "both.usda")))
    stage = Usd.Stage.CreateNew(str(made.shot))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(24.0)
    scene = arm_scene()
    (arm,) = scene.characters
    codes = scene.time_codes
    stage.SetStartTimeCode(codes[0])
    stage.SetEndTimeCode(codes[-1])
    for place, name in enumerate(("/Asked", "/Idle")):
        author_character(stage, name, arm.skeleton, arm.body, arm.motion, time_codes=codes)
        above = UsdGeom.Xformable(stage.GetPrimAtPath(name))
        above.AddTranslateOp().Set(Gf.Vec3d(0.0, 0.0, 0.5 * place))
    author_edit(stage, f"{ASKED}/Edit")
    up = Goal(mode="offset", translation=np.array((0.0, 0.05, 0.0)))
    asks = {"recruits": ("base/shoulder", "base/shoulder/elbow"), "goals": (up,)}
    author(
        stage, f"{ASKED}/Edit/Wrist", PositionConstraint(path="", skeleton="", joint=WRIST, **asks)
    )
    box = UsdGeom.Cube.Define(stage, "/Box")
    box.CreateSizeAttr(0.2)
    camera = UsdGeom.Camera.Define(stage, "/Camera")
    camera.AddTranslateOp().Set(Gf.Vec3d(0.0, 0.5, 4.0))
    stage.GetRootLayer().Save()
    pipeline.solve(made.shot, made.layer, compose=made.composed)
    return made

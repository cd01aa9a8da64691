"""Contacts of the dice, and of a walk that is carried about, with what is drawn of them."""

from pathlib import Path

import pytest
from pxr import Sdf, Usd

from usdmotion import demos, guiding, pipeline

DICE = ("/Dice/First", "/Dice/Second")
FEET = ("LeftFoot", "RightFoot")
CARRIED = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
    timeCodesPerSecond = 24
    framesPerSecond = 24
    startTimeCode = 12
    endTimeCode = 300
)
def Xform "World"
{
    double3 xformOp:translate.timeSamples = { 150: (50, 0, 0), 300: (150, 20, -40) }
    double xformOp:rotateY.timeSamples = { 150: 30, 300: 50 }
    double3 xformOp:scale = (0.5, 0.5, 0.5)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY", "xformOp:scale"]

    def "Walker" (
        references = @./reaching.usda@</Walker> (offset = 10; scale = 2)
    )
    {
    }
}
"""
"""A walker on something that sets off halfway, at half his size and other time codes."""


WRAPPED = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
    timeCodesPerSecond = 24
    startTimeCode = 1
    endTimeCode = 400
)
def Xform "World"
{{
    double3 xformOp:translate.timeSamples = {{ 1: (0, 0, 0), 400: (300, 20, -40) }}
    float xformOp:rotateY = 70
    double3 xformOp:scale = (0.5, 0.5, 0.5)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY", "xformOp:scale"]

    def "{name}" (
        references = @{path}@</{name}> (offset = 10; scale = 2)
    )
    {{
    }}
}}
"""
"""Somebody on what moves, smaller and at other time codes."""


@pytest.fixture(scope="session")
def wrapped(tmp_path_factory):
    """Return what references a prim of a stage below one that moves, and opens that."""

    def run(stage: Usd.Stage, name: str) -> Usd.Stage:
        path = tmp_path_factory.mktemp("wrapped") / "wrapped.usda"
        path.write_text(WRAPPED.format(path=stage.GetRootLayer().realPath, name=name))
        return Usd.Stage.Open(str(path))

    return run


@pytest.fixture(scope="session")
def detected(tmp_path_factory):
    """Return what looks for contacts on a stage and opens what it wrote."""

    def run(shot: Path, name: str = "contacts.usda", **asked) -> Usd.Stage:
        output = tmp_path_factory.mktemp("detected") / name
        pipeline.detect(shot, output, **asked)
        return Usd.Stage.Open(str(output))

    return run


@pytest.fixture(scope="session")
def dice_shot(tmp_path_factory):
    return demos.build("dice", tmp_path_factory.mktemp("dice"))


@pytest.fixture(scope="session")
def dice(dice_shot, detected):
    return detected(dice_shot, prims=DICE, kinds=("space", "line", "point"))


@pytest.fixture(scope="session")
def walk_shot(tmp_path_factory):
    folder = tmp_path_factory.mktemp("walk")
    demos.build("reaching", folder)
    (folder / "carried.usda").write_text(CARRIED)
    return folder / "carried.usda"


@pytest.fixture(scope="session")
def walk(walk_shot, detected):
    return detected(walk_shot, joints=FEET, minimum=0.1)


@pytest.fixture(scope="session")
def contacts_of():
    """Return what lists the contacts of a stage that are on."""

    def run(stage: Usd.Stage) -> list[Usd.Prim]:
        kind = "MotionContactConstraint"
        return [prim for prim in stage.Traverse() if prim.GetTypeName() == kind]

    return run


@pytest.fixture
def over(tmp_path):
    """Return what writes a layer over a stage, which is edited before it is saved."""

    def run(stage: Usd.Stage, edit, name: str = "person.usda") -> Path:
        path = tmp_path / name
        layer = Sdf.Layer.CreateNew(str(path))
        layer.subLayerPaths.append(stage.GetRootLayer().realPath)
        above = Usd.Stage.Open(layer)
        for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
            above.SetMetadata(name, stage.GetMetadata(name))
        edit(above)
        layer.Save()
        return path

    return run


@pytest.fixture(scope="session")
def guided(tmp_path_factory):
    """Return what draws what there is to see of a stage, in a layer over it."""

    def run(shot: Path) -> Usd.Stage:
        output = tmp_path_factory.mktemp("guided") / "guides.usda"
        guiding.guides(shot, output)
        return Usd.Stage.Open(str(output))

    return run


@pytest.fixture(scope="session")
def solved(tmp_path_factory):
    """Return what solves a stage, and gives the stage with the result."""

    def run(shot: Path) -> Path:
        folder = tmp_path_factory.mktemp("solved")
        pipeline.solve(shot, folder / "edit.usda", compose=folder / "composed.usda")
        return folder / "composed.usda"

    return run


@pytest.fixture(scope="session")
def reached(walk_shot, solved):
    """Return the stage of `reaching` with its result."""
    return solved(walk_shot.parent / "reaching.usda")


@pytest.fixture(scope="session")
def reaching(reached, guided):
    return guided(reached)


@pytest.fixture(scope="session")
def carried(walk_shot, solved, guided):
    """Return the same walker while he is carried about, at half his size."""
    return guided(solved(walk_shot))

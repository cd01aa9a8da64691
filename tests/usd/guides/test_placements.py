"""What is drawn stays in its place in the world below what moves, whoever drew there before."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import guiding, usd

EDIT = "/World/Walker/Skeleton/Reaching"
FOOT = "Hips/LeftUpLeg/LeftLeg/LeftFoot"
WORLD = f"{EDIT}/Guides/World"
NEAR = 0.3
"""How far what is drawn may be from its place: three millimetres."""
TURNING = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
    timeCodesPerSecond = 24
    framesPerSecond = 24
)
def Xform "World"
{{
    double xformOp:rotateY.timeSamples = {{ 1: 0, 145: 180 }}
    uniform token[] xformOpOrder = ["xformOp:rotateY"]
    def "Walker" ( references = @{path}@</Walker> )
    {{
        over "Skeleton"
        {{
            over "Reaching"
            {{
                def MotionContactConstraint "Stands"
                {{
                    uniform token usdmotion:joint = "{joint}"
                    uniform timecode[] usdmotion:times = [49, 49, 61, 61]
                }}
            }}
        }}
    }}
}}
"""
"""A walker with a contact that somebody wrote, on what turns, on a stage that says no range."""


@pytest.fixture
def turning(walk_shot):
    layer = Sdf.Layer.CreateAnonymous(".usda")
    shot = walk_shot.parent / "reaching.usda"
    layer.ImportFromString(TURNING.format(path=shot, joint=FOOT))
    return Usd.Stage.Open(layer)


def draw_all(stage):
    guiding.guides_over(stage, Path("turning.usda"))


def draw_contacts(stage):
    usd.author_contact_marks(stage, usd.read_contact_marks(stage))


def placed(stage):
    """Return the samples of the class in which all that is below the edit has the world's frame."""
    attribute = stage.GetPrimAtPath(WORLD).GetAttribute("xformOp:transform:guide")
    return {code: attribute.Get(code) for code in attribute.GetTimeSamples()}


def strays(prim):
    """Return how far the points of a guide that does not move are from where they began."""
    points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get())
    frames = np.arange(1.0, 146.0)
    xform = UsdGeom.Xformable(prim)
    turns = np.array([xform.ComputeLocalToWorldTransform(frame) for frame in frames])
    there = points @ turns[:, :3, :3] + turns[:, None, 3, :3]
    return np.linalg.norm(there - points, axis=2).max()


def test_contacts_of_a_person_are_drawn_with_all_else_where_the_edit_is_carried(turning):
    draw_all(turning)
    drawn = [prim for prim in turning.Traverse() if prim.GetName() in ("Before", "Held", "Sole")]
    assert {prim.GetName() for prim in drawn} == {"Before", "Held", "Sole"}
    assert len(drawn) > 4
    assert max(strays(prim) for prim in drawn) < NEAR


def test_it_does_not_matter_what_is_drawn_first(turning):
    draw_contacts(turning)
    alone = placed(turning)
    draw_all(turning)
    assert len(alone) > 20
    assert placed(turning) == alone
    draw_contacts(turning)
    assert placed(turning) == alone


def test_what_was_drawn_where_something_moved_loses_its_transform_when_that_is_still(turning):
    draw_all(turning)
    turning.GetPrimAtPath("/World").GetAttribute("xformOp:rotateY").Clear()
    draw_all(turning)
    guides = turning.GetPrimAtPath(f"{EDIT}/Stands/Guides")
    assert not UsdGeom.Xformable(guides).GetOrderedXformOps()
    assert strays(guides.GetChild("Held")) == 0.0

"""Contacts are read as they are, however they came to the stage, and drawn all alike."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSkel

from usdmotion import pipeline, usd

EDIT = "/Walker/Skeleton/Reaching"
FOOT = "Hips/LeftUpLeg/LeftLeg/LeftFoot"
BALL = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
    startTimeCode = 1
    endTimeCode = 20
)
def Sphere "Ball"
{
    double radius = 4
    double3 xformOp:translate = (5, 6, 4)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def MotionContactConstraint "Lies"
{
    rel usdmotion:object = </Ball>
    uniform point3d usdmotion:location = (5, 6, 4)
    uniform timecode[] usdmotion:times = [2, 4, 9, 12]
}
"""


def contact(stage, name, joint=FOOT, times=(12.0, 14.0, 22.0, 24.0)):
    prim = stage.DefinePrim(f"{EDIT}/{name}", "MotionContactConstraint")
    prim.GetAttribute("usdmotion:joint").Set(joint)
    prim.GetAttribute("usdmotion:times").Set([Sdf.TimeCode(code) for code in times])
    return prim


@pytest.fixture
def by_hand(walk_shot):
    """Return a walker with contacts that somebody wrote, in memory."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.subLayerPaths.append(str(walk_shot.parent / "reaching.usda"))
    stage = Usd.Stage.Open(layer)
    beneath = Usd.Stage.Open(str(walk_shot.parent / "reaching.usda"))
    for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
        stage.SetMetadata(name, beneath.GetMetadata(name))
    stage.SetStartTimeCode(1.0)
    stage.SetEndTimeCode(145.0)
    contact(stage, "Stands")
    contact(stage, "StandsAgain", times=(40.0, 42.0, 50.0, 52.0))
    return stage


def place(stage, joint, code):
    skeleton = UsdSkel.Skeleton(stage.GetPrimAtPath("/Walker/Skeleton"))
    query = UsdSkel.Cache().GetSkelQuery(skeleton)
    index = list(query.GetJointOrder()).index(joint)
    return np.array(query.ComputeJointSkelTransforms(code)[index])[3, :3]


def test_marks_say_what_the_prims_do(dice, contacts_of):
    marks = {mark.path: mark for mark in usd.read_contact_marks(dice)}
    prims = contacts_of(dice)
    assert list(marks) == [str(prim.GetPath()) for prim in prims]
    for prim in prims:
        mark = marks[str(prim.GetPath())]
        times = [float(code) for code in prim.GetAttribute("usdmotion:times").Get()]
        assert [mark.first, mark.start, mark.end, mark.last] == times
        assert mark.kind == prim.GetAttribute("usdmotion:kind").Get()
        assert mark.object == str(prim.GetRelationship("usdmotion:object").GetTargets()[0])
        assert mark.number == int(prim.GetName().removeprefix("Contact"))
    assert len({(mark.object, mark.color) for mark in marks.values()}) == 2


def test_contacts_of_nobodys_detection_are_drawn_where_the_joint_is(by_hand):
    marks = usd.read_contact_marks(by_hand)
    assert [mark.path for mark in marks] == [f"{EDIT}/Stands", f"{EDIT}/StandsAgain"]
    assert [mark.number for mark in marks] == [1, 2]
    usd.author_contact_marks(by_hand, marks)
    for mark, code in zip(marks, (18.0, 46.0), strict=True):
        held = UsdGeom.PointBased(by_hand.GetPrimAtPath(f"{mark.path}/Guides/Held"))
        gaps = np.array(held.GetPointsAttr().Get()) - place(by_hand, FOOT, code)
        assert np.linalg.norm(gaps, axis=1).min() < 0.1


def test_what_they_hold_is_written_once(by_hand):
    usd.author_contact_marks(by_hand, usd.read_contact_marks(by_hand))
    shapes = [prim for prim in Usd.PrimRange.AllPrims(by_hand.GetPseudoRoot()) if prim.IsAbstract()]
    assert [str(prim.GetPath()) for prim in shapes] == [f"{EDIT}/Guides/Shape_LeftFoot"]
    for name in ("Stands", "StandsAgain"):
        ghost = UsdGeom.Mesh(by_hand.GetPrimAtPath(f"{EDIT}/{name}/Guides/Ghost"))
        assert len(ghost.GetPointsAttr().Get()) > 4


def test_a_foot_that_stands_leaves_its_sole_on_the_ground(by_hand):
    contact(by_hand, "Hangs", "Hips/Spine/Spine1/Spine2/LeftShoulder/LeftArm")
    usd.author_contact_marks(by_hand, usd.read_contact_marks(by_hand))
    sole = by_hand.GetPrimAtPath(f"{EDIT}/Stands/Guides/Sole")
    points = np.array(UsdGeom.Mesh(sole).GetPointsAttr().Get())
    np.testing.assert_allclose(points[:, 1], 0.0, atol=1e-3)
    ankle = place(by_hand, FOOT, 18.0)
    assert points[:, 2].min() < ankle[2] < points[:, 2].max()
    assert points[:, 0].min() < ankle[0] < points[:, 0].max()
    assert not by_hand.GetPrimAtPath(f"{EDIT}/Hangs/Guides/Sole")


def test_an_object_keeps_its_colour(by_hand):
    before = {mark.object: mark.color for mark in usd.read_contact_marks(by_hand)}
    usd.author_contact_marks(by_hand, usd.read_contact_marks(by_hand))
    contact(by_hand, "AFirst", "Hips/RightUpLeg/RightLeg/RightFoot")
    after = {mark.object: mark.color for mark in usd.read_contact_marks(by_hand)}
    assert {name: after[name] for name in before} == before
    assert len(set(after.values())) == 2


def test_a_prop_that_never_moves_may_be_held_too():
    stage = Usd.Stage.CreateInMemory()
    stage.GetRootLayer().ImportFromString(BALL)
    (mark,) = usd.read_contact_marks(stage)
    assert (mark.first, mark.start, mark.end, mark.last) == (2.0, 4.0, 9.0, 12.0)
    usd.author_contact_marks(stage, [mark])
    held = UsdGeom.PointBased(stage.GetPrimAtPath("/Lies/Guides/Held")).GetPointsAttr().Get()
    np.testing.assert_allclose(np.mean(held, axis=0), (5.0, 6.0, 4.0), atol=1e-3)
    assert stage.GetPrimAtPath("/Lies/Guides/Ghost/Ball")


def test_where_an_effector_goes_has_the_colour_of_the_contact(by_hand, solved, guided, tmp_path):
    by_hand.GetRootLayer().Export(str(tmp_path / "held.usda"))
    stage = guided(solved(tmp_path / "held.usda"))

    def color(name):
        return tuple(UsdGeom.Gprim.Get(stage, f"{EDIT}/{name}").GetDisplayColorAttr().Get()[0])

    assert color("Stands/Guides/Held") == color("Stands/Guides/After")
    assert color("Stands/Guides/Held") != color("LeftWrist/Guides/After")


def test_what_a_detection_shows_of_an_object_is_drawn_once(walk_shot, tmp_path, guided):
    found = tmp_path / "found.usda"
    pipeline.detect(walk_shot.parent / "reaching.usda", found, joints=["LeftFoot"], minimum=0.1)
    drawn = guided(found)
    (detection,) = (p for p in drawn.Traverse() if p.GetTypeName() == "MotionDetection")
    assert detection.GetPrimAtPath("Guides/Trajectory")
    assert drawn.GetPrimAtPath(f"{EDIT}/LeftWrist/Guides/Before")
    for prim in detection.GetChildren():
        assert not prim.GetPrimAtPath("Guides/Before")

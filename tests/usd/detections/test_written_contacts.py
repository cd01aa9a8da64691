"""What a detection writes: contacts that hold as they stand, wherever their parents are."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from usdmotion import pipeline, usd
from usdmotion.asking import Example
from usdmotion.constraints import ContactConstraint, built_in
from usdmotion.kernels import conjugate, multiply, rotate, world_points
from usdmotion.usd.detections.contact_prims import contact_prims

TURNED = """
    double xformOp:rotateX = -90
    double3 xformOp:translate = (10000, 3, 2)
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX", "xformOp:scale"]
"""
WALKING = """
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 24: (10, 1, 2) }
    double xformOp:rotateY.timeSamples = { 1: 0, 24: 90 }
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY"]
"""
CENTIMETRES = """metersPerUnit = 0.01
upAxis = "Z"
timeCodesPerSecond = 48
framesPerSecond = 24
startTimeCode = 1
endTimeCode = 24"""


def contacts_of(path):
    """Return the contacts of the one edit of a stage, as a solver would be given them."""
    shot = usd.read(path, kinds=built_in())
    (scene,) = shot.scenes
    found = [each for each in scene.edits[0].constraints if isinstance(each, ContactConstraint)]
    return scene, found


def places(scene, contact):
    """Return where the joint's point is, and where a contact holds it, in the world [m]."""
    cast = scene.cast
    node = cast.index[contact.skeleton, contact.joint]
    point = world_points(cast.positions[:, node], cast.orientations[:, node], contact.point)
    space = contact.space
    held = space.translation + rotate(space.rotation, contact.location)
    return point, np.broadcast_to(held, point.shape)


def test_there_is_a_contact_for_each_stand_with_its_times(shot, detect, opened, steps):
    report = detect(shot())
    (foot,) = report.objects
    assert foot.path == steps.detection
    assert [(each.start, each.end) for each in foot.contacts] == list(steps.stands)
    detection = opened().GetPrimAtPath(steps.detection)
    assert detection.GetTypeName() == "MotionDetection"
    assert detection.GetParent().GetTypeName() == "MotionEdit"
    assert [prim.GetName() for prim in contact_prims(detection)] == [
        "Contact01",
        "Contact02",
        "Contact03",
    ]


def test_a_contact_eases_for_a_fifth_of_a_second_or_half_the_free_time(shot, detect, opened, steps):
    detect(shot())
    times = [
        [float(code) for code in prim.GetAttribute("usdmotion:times").Get()]
        for prim in contact_prims(opened().GetPrimAtPath(steps.detection))
    ]
    # 24 time codes a second: 4.8 are a fifth of one, and 5 are free between two stands.
    assert times == [[-3.8, 1, 6, 8.5], [8.5, 11, 16, 18.5], [18.5, 21, 24, 28.8]]


@pytest.mark.parametrize("root", ["", TURNED, WALKING])
@pytest.mark.parametrize("header", [None, CENTIMETRES])
def test_a_contact_is_held_where_the_joint_is(shot, detect, opened, tmp_path, root, header):
    given = {} if header is None else {"header": header}
    # Where its parents walk the foot never stands, unless standing is taken generously.
    options = {"slack": "1000"} if root == WALKING else {"slack": "1e-6"}
    detect(shot(root=root, **given), options=options)
    scene, found = contacts_of(tmp_path / "out.usda")
    assert found
    for contact in found:
        point, held = places(scene, contact)
        first, last = np.searchsorted(scene.times, np.array(contact.times[1:3]) - 1e-9)
        middle = (first + last) // 2
        np.testing.assert_allclose(point[middle], held[middle], atol=1e-8)
        node = scene.cast.index[contact.skeleton, contact.joint]
        turned = multiply(contact.space.rotation, contact.orientation)
        apart = multiply(conjugate(turned), scene.cast.orientations[middle, node])
        np.testing.assert_allclose(np.abs(apart), [0, 0, 0, 1], atol=1e-7)
        axis = rotate(contact.space.rotation, contact.axis)
        np.testing.assert_allclose(axis, [0, 1, 0], atol=1e-7)
        assert contact.residual == pytest.approx(0.001)


def test_a_layer_of_contacts_is_a_stage_that_can_be_solved(shot, detect, tmp_path, steps):
    detect(shot())
    report = pipeline.solve(tmp_path / "out.usda", tmp_path / "edit.usda")
    (edit,) = report.edits
    assert edit.path == steps.edit
    assert [each.path for each in edit.constraints] == [
        f"{steps.detection}/Contact0{number}" for number in (1, 2, 3)
    ]
    assert report.met


def test_a_template_is_solved_as_any_contact(shot, detect, tmp_path, steps):
    detect(shot(), templates=[Example("foot", 12, 15)])
    report = pipeline.solve(tmp_path / "out.usda", tmp_path / "edit.usda")
    assert len(report.edits[0].constraints) == 3
    assert report.met


def test_the_world_stands_beside_contacts_whose_parents_move(shot, detect, opened, steps):
    detect(shot(root=WALKING), options={"slack": "1000"})
    stage = opened()
    world = stage.GetPrimAtPath(f"{steps.detection}/World")
    contact = stage.GetPrimAtPath(f"{steps.detection}/Contact01")
    assert contact.GetRelationship("usdmotion:space").GetTargets() == [world.GetPath()]
    for code in (1.0, 12.0, 24.0):
        cache = UsdGeom.XformCache(Usd.TimeCode(code))
        assert np.array_equal(np.array(cache.GetLocalToWorldTransform(world)), np.eye(4))


def test_the_layer_has_the_shot_under_it_and_is_read_alike(shot, detect, opened, tmp_path):
    source = shot(header=CENTIMETRES)
    before = source.read_bytes()
    detect(source)
    stage = opened()
    assert list(stage.GetRootLayer().subLayerPaths) == ["./shot.usda"]
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (48.0, 24.0)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1.0, 24.0)
    assert source.read_bytes() == before
    assert {each.name for each in tmp_path.iterdir()} == {"shot.usda", "out.usda"}


def test_the_same_shot_gives_the_same_bytes(shot, detect, tmp_path):
    source = shot()
    detect(source, "one.usda")
    detect(source, "two.usda")
    assert (tmp_path / "one.usda").read_bytes() == (tmp_path / "two.usda").read_bytes()


def test_the_layer_says_how_it_was_made(shot, detect, opened, steps):
    detect(shot(), options={"slack": "0.5"})
    said = opened().GetRootLayer().customLayerData["usdmotion"]
    assert said["version"]
    assert said["detection"]["detectors"] == {steps.detection: "contacts"}
    assert said["detection"]["options"] == {steps.detection: {"slack": 0.5}}
    assert len(said["detection"]["hashes"][steps.detection]) == 64

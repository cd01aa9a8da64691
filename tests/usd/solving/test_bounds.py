"""Distances and regions, as UsdSkel sees the answer."""

import numpy as np

CODES = (1, 2, 3, 4, 5)
DECIMETRES = "metersPerUnit = 0.1"
ANKLE, HEAD = "hip/knee/ankle", "hip/head"


def test_a_distance_to_another_is_kept_while_that_one_is_solved(text, save, solve):
    reach = text.hold(
        kind="MotionDistanceConstraint",
        attributes=f"""rel usdmotion:otherSkeleton = </Bob/Bones>
        uniform token usdmotion:otherJoint = "{HEAD}"
        uniform point3d usdmotion:otherPoint = (0, 0.5, 0)
        double usdmotion:distance = 3""",
    )
    up = text.goal('uniform token usdmotion:mode = "offset"', translate="(0, 4, 0)")
    lift = text.edit(text.hold(up).replace(ANKLE, HEAD))
    ann = text.man("Ann", edit=text.edit(reach))
    bob = text.man("Bob", edit=lift, animation=text.poses(seed=3), xform=text.SCALED)
    answer = solve(save(ann + bob, header=DECIMETRES))
    was, head = answer.both(HEAD, CODES, "/Bob/Bones")
    np.testing.assert_allclose(head - was, [(0, 8, 0)] * 5, atol=1e-3)  # Bob is scaled by two
    _, ankle = answer.both(ANKLE, CODES, "/Ann/Bones")
    axes = answer.turns(HEAD, CODES, "/Bob/Bones")
    crown = head + 2.0 * 0.5 * axes[:, 1]
    np.testing.assert_allclose(np.linalg.norm(ankle - crown, axis=1), 3.0, atol=2e-3)
    assert answer.report.met


def test_a_point_stays_out_of_a_shape_that_moves(text, save, solve):
    keep = text.hold(
        kind="MotionRegionConstraint", attributes="rel usdmotion:region = </World/Ball>"
    )
    ball = """
    def Xform "World" {
        double3 xformOp:translate.timeSamples = { 1: (0, 1, 0), 5: (4, 1, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Sphere "Ball" {
            double radius = 6
        }
    }"""
    answer = solve(save(text.man(edit=text.edit(keep)) + ball))
    was, ankle = answer.both(ANKLE, CODES)
    centers = np.array([(code - 1.0, 1.0, 0.0) for code in CODES])
    before, after = (np.linalg.norm(place - centers, axis=1) for place in (was, ankle))
    assert before.min() < 5.0
    assert after.min() > 6.0 - 1e-3
    assert answer.report.met


def test_an_axis_aims_at_a_prop(text, save, solve):
    look = text.hold(
        text.goal("rel usdmotion:space = </Lamp>", translate="(0, 0, 0)"),
        kind="MotionAimConstraint",
        attributes="uniform vector3f usdmotion:aim = (0, 2, 0)",
    ).replace(ANKLE, HEAD)
    lamp = """def Xform "Lamp" {
        double3 xformOp:translate.timeSamples = { 1: (20, 10, 0), 5: (0, 10, 20) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }"""
    answer = solve(save(text.man(edit=text.edit(look)) + lamp))
    _, head = answer.both(HEAD, CODES)
    lamps = np.linspace((20, 10, 0), (0, 10, 20), 5)
    ways = (lamps - head) / np.linalg.norm(lamps - head, axis=1, keepdims=True)
    axes = answer.turns(HEAD, CODES)[:, 1]
    np.testing.assert_allclose(axes, ways, atol=1e-5)
    assert answer.report.met

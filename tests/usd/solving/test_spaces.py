"""Goals in the frames of prims and of joints that move."""

import numpy as np
from pxr import UsdGeom

ANKLE = "hip/knee/ankle"
PROP = """
def Xform "Prop" {
    double3 xformOp:translate.timeSamples = { 1: (0, 8, 0), 5: (4, 9, 40) }
    double xformOp:rotateZ.timeSamples = { 1: 0, 5: 120 }
    float3 xformOp:scale.timeSamples = { 1: (2, 2, 2), 5: (3, 3, 3) }
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]
}"""


def in_space(stage, goal, space, codes):
    """Return where a goal is in a prim's frame, as UsdGeom has it, in stage units."""
    found = []
    for code in codes:
        local = UsdGeom.Xformable(stage.GetPrimAtPath(goal)).GetLocalTransformation(code)
        world = UsdGeom.XformCache(code).GetLocalToWorldTransform(stage.GetPrimAtPath(space))
        found.append((local * world).ExtractTranslation())
    return np.array(found)


def test_a_goal_follows_a_prim_that_moves_and_grows_under_a_layer_offset(text, save, solve):
    held = text.hold(text.goal("rel usdmotion:space = </World/Prop>"))
    man = text.man(edit=text.edit(held), home="World/Man", xform=text.MOVING)
    save(f'def Xform "World" {{\n{man}\n{PROP}\n}}', "asset.usda", "metersPerUnit = 0.01")
    body = 'def "Stage" (references = @./asset.usda@</World> (offset = 7; scale = 3)) {}'
    answer = solve(save(body, header=text.CENTIMETRES))
    codes = [10, 13, 16, 19, 22]
    assert answer.result(path="/Stage/Man/Bones/Edit_result").GetTimeSamples() == codes
    goal = in_space(answer.old, "/Stage/Man/Bones/Edit/Hold/Goal", "/Stage/Prop", codes)
    assert np.ptp(goal, axis=0).min() > 1.0
    _, after = answer.both(ANKLE, codes, "/Stage/Man/Bones")
    np.testing.assert_allclose(after, goal, atol=1e-3)
    assert answer.report.met


def test_a_goal_without_a_space_follows_its_parents(text, save, solve):
    man = text.man(edit=text.edit(text.hold(text.goal())), xform=text.MOVING)
    answer = solve(save(man))
    codes = (1, 2, 3, 4, 5)
    goal = in_space(answer.old, "/Man/Bones/Edit/Hold/Goal", "/Man/Bones", codes)
    np.testing.assert_allclose(answer.both(ANKLE, codes)[1], goal, atol=1e-4)


def test_the_axes_that_are_held_are_those_of_the_space(text, save, solve):
    attributes = 'uniform token usdmotion:axes = "x"'
    held = text.hold(text.goal("rel usdmotion:space = </Prop>"), attributes=attributes)
    answer = solve(save(text.man(edit=text.edit(held)) + PROP))
    codes = (1, 2, 3, 4, 5)
    goal = in_space(answer.old, "/Man/Bones/Edit/Hold/Goal", "/Prop", codes)
    _, after = answer.both(ANKLE, codes)
    for place, wanted, code in zip(after, goal, codes, strict=True):
        prop = answer.old.GetPrimAtPath("/Prop")
        axis = UsdGeom.XformCache(code).GetLocalToWorldTransform(prop).GetRow3(0).GetNormalized()
        np.testing.assert_allclose((place - wanted) @ np.array(axis), 0.0, atol=1e-4)
    assert np.abs(after - goal).max() > 0.1

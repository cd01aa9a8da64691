"""Goals are drawn where, and how turned, they are wanted, and no more often than they move."""

import numpy as np
import pytest
from pxr import UsdGeom

from usdmotion.plugins import host
from usdmotion.showing import shown
from usdmotion.usd import outcomes_of

HEADER = 'metersPerUnit = 0.01\nupAxis = "{}"\ntimeCodesPerSecond = 24'
KIND = "MotionOrientationConstraint"
TURNS = """
    quatf xformOp:orient.timeSamples = { 1: (1, 0, 0, 0), 3: (0.6, 0, 0.8, 0), 5: (0, 0, 1, 0) }
    uniform token[] xformOpOrder = ["xformOp:orient"]
"""


@pytest.fixture
def drawn_with(text, save, solved, guided):
    """Return what solves and draws an edit with a constraint, and what there is to see of it."""

    def run(goal, kind=KIND, axis="Y", xform="") -> tuple:
        asked = text.edit(text.hold(goal, kind=kind))
        result = solved(save(text.man(edit=asked, xform=xform), header=HEADER.format(axis)))
        stage = guided(result)
        (outcome,) = outcomes_of(stage, result, host().constraints)
        (mark,) = shown(outcome).edits[0].goals
        return stage, mark, outcome.scene.time_codes

    return run


def place(stage, path, code):
    prim = stage.GetPrimAtPath(f"/Man/Bones/Edit/Hold/Guides/{path}")
    points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(code))
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
    return points @ matrix[:3, :3] + matrix[3, :3]


@pytest.mark.parametrize("axis", ["Y", "Z"])
@pytest.mark.parametrize("moving", [False, True])
def test_axes_of_a_goal_turn_with_it_wherever_its_effector_is(drawn_with, text, axis, moving):
    goal = f'def MotionGoal "Goal" {{\n{TURNS}\n}}'
    stage, mark, codes = drawn_with(goal, axis=axis, xform=text.MOVING if moving else "")
    for frame, code in enumerate(codes):
        x, y, z, w = mark.rotations[frame]
        lines = place(stage, "Goal/Axes", code).reshape(3, 2, 3)
        np.testing.assert_allclose(0.01 * lines[:, 0], [mark.translations[frame]] * 3, atol=2e-3)
        along = lines[:, 1] - lines[:, 0]
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        from_quaternion = np.array(
            [
                (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
                (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
                (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)),
            ]
        )
        np.testing.assert_allclose(along, from_quaternion, atol=0.03)


@pytest.mark.parametrize(
    ("place_of_goal", "sampled"),
    [(" = (1, 2, 3)", 0), (".timeSamples = { 1: (1, 2, 3), 5: (9, 2, 3) }", 2)],
)
def test_one_that_stays_is_written_once_and_one_that_moves_as_it_moves(
    drawn_with, text, place_of_goal, sampled
):
    goal = text.goal(translate="HERE").replace(" = HERE", place_of_goal)
    stage, mark, codes = drawn_with(goal, kind="MotionPositionConstraint")
    guide = stage.GetPrimAtPath("/Man/Bones/Edit/Hold/Guides/Goal")
    assert guide.GetAttribute("xformOp:translate:guide").GetNumTimeSamples() == sampled
    for frame, code in enumerate(codes):
        middle = place(stage, "Goal/Marker", code).mean(axis=0)
        np.testing.assert_allclose(0.01 * middle, mark.translations[frame], atol=1e-4)


def test_a_distance_is_a_line_between_its_joints_as_opaque_as_it_is_active(
    text, save, solved, guided, skel
):
    asked = text.hold(
        kind="MotionDistanceConstraint",
        attributes='uniform token usdmotion:otherJoint = "hip/head"\n'
        "double usdmotion:distance = 2\nuniform timecode[] usdmotion:times = [1, 2, 3, 4]",
    )
    result = solved(save(text.man(edit=text.edit(asked)), header=HEADER.format("Y")))
    stage = guided(result)
    guide = stage.GetPrimAtPath("/Man/Bones/Edit/Hold/Guides/Distance")
    opacity = UsdGeom.PrimvarsAPI(guide).GetPrimvar("displayOpacity")
    for code, share in ((1.0, 0.0), (2.0, 1.0), (3.0, 1.0), (4.0, 0.0)):
        joints, _ = skel.truth(result, "/Man/Bones", [code])
        ends = 0.01 * place(stage, "Distance", code)
        np.testing.assert_allclose(ends, joints[0, [2, 3]], atol=2e-4)
        assert opacity.Get(code)[0] == pytest.approx(0.1 + 0.9 * share, abs=0.02)

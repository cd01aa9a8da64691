"""Joints are told apart by their names, and found by what is near them."""

import pytest
from pxr import Gf, UsdGeom, UsdSkel

from usdmotion import SceneError
from usdmotion.usdview.joints import labels, nearest_joint


def test_a_list_of_joints_reads_as_a_tree_with_no_name_twice():
    tokens = ("Hips", "Hips/Spine", "Hips/L/Foot", "Hips/R/Foot")
    assert labels(tokens) == ["Hips", "    Spine", "        Hips/L/Foot", "        Hips/R/Foot"]


@pytest.mark.parametrize("time_code", [1.0, 40.0, 97.0])
@pytest.mark.parametrize("joint", ["Head", "LeftHand", "RightToeBase"])
def test_the_nearest_joint_is_that_where_a_prim_is_at_that_time(seat, joint, time_code):
    stage = seat("reaching").stage
    skeleton = stage.GetPrimAtPath("/Walker/Skeleton")
    prop = UsdGeom.Cube.Define(stage, "/Set/Prop")
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(skeleton))
    index = [token.rsplit("/", 1)[-1] for token in query.GetJointOrder()].index(joint)
    matrix = query.ComputeJointWorldTransforms(UsdGeom.XformCache(time_code))[index]
    prop.AddTranslateOp().Set(matrix.ExtractTranslation() + Gf.Vec3d(0.1))
    found = nearest_joint(skeleton, prop.GetPrim(), time_code)
    assert found.rsplit("/", 1)[-1] == joint


def test_a_skeleton_without_a_pose(seat):
    stage = seat("dice").stage
    skeleton = UsdSkel.Skeleton.Define(stage, "/Bones").GetPrim()
    with pytest.raises(SceneError, match="</Bones> has no pose"):
        nearest_joint(skeleton, stage.GetPrimAtPath("/Dice/First"), 1.0)

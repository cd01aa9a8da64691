"""Captured skeletons: each is known from head to foot, or refused with what it lacks."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdSkel
from usdmotion_bvh import BvhReader

import usdmotion.usd  # noqa: F401  registers the schema, which nobody can once a stage is open
from usdmotion.errors import FileError, SceneError
from usdmotion.humanoid import PartMap, guess
from usdmotion.motion import Skeleton

CHAINS = {
    # joints that are: pelvis, head, left shoulder, left wrist, left hip, left ankle, left toes
    "cmu/daz/*": "hip head lShldr lHand lThigh lFoot -",
    "cmu/daz_hands/*": "hip head lshoulder lhand lhip lfoot -",
    "cmu/iclone/*": "CC_Base_Hip CC_Base_Head CC_Base_L_Upperarm CC_Base_L_Hand "
    "CC_Base_L_Thigh CC_Base_L_Foot CC_Base_L_ToeBase",
    "cmu/mb/[0-9]*": "Hips Head LeftArm LeftHand LeftUpLeg LeftFoot LeftToeBase",
    "cmu/mb/jump*": "Hips Head LeftShoulder LeftWrist LeftHip LeftAnkle LeftToe",
    "other/fair*": "Hips Head LeftArm LeftHand LeftUpLeg LeftFoot LeftToeBase",
    "other/rokoko*": "Hips Head LeftArm LeftHand LeftUpLeg LeftFoot LeftToeBase",
    "other/mixamorig*": "mixamorig_Hips mixamorig_Head mixamorig_LeftArm mixamorig_LeftHand "
    "mixamorig_LeftUpLeg mixamorig_LeftFoot mixamorig_LeftToeBase",
    "other/mocapbank*": "Hips Head LeftShoulder LeftWrist LeftHip LeftAnkle -",
    "odd/bvh/102_01cc*": "hip head lshoulder lhand lhip lfoot lefttoebase",
    "odd/bvh/frames_250*": "hip Head lshoulder lhand lhip lfoot LeftToeBase",
    "odd/bvh/makehuman*": "root head upperarm01_L wrist_L upperleg01_L foot_L -",
    "odd/bvh/mixed_orders_fingers*": "Hips Head LeftArm LeftHand LeftUpLeg LeftFoot LeftForeFoot",
    "odd/bvh/mixed_orders_vicon*": "Hips Head LeftArm LeftHand LeftUpLeg LeftFoot LeftToeBase",
    "odd/bvh/xsens*": "Hips Head LeftShoulder LeftWrist LeftHip LeftAnkle LeftToe",
}
PLACES = (
    *("humanoid_root", "skullbase", "l_shoulder", "l_radiocarpal"),
    *("l_hip", "l_talocrural", "l_metatarsophalangeal"),
)
NO_BODIES = {
    "odd/bvh/full_precision*": "l_shoulder, .*r_talocrural",
    "odd/bvh/rotation_first_root*": "l_shoulder, .*r_talocrural",
    "odd/bvh/reproductions/*": "no joint of the skeleton can be told to be part of a human body",
}
UNREADABLE = ("frontkick_world_space_6dof", "head_219_values_213_channels")
VERTEBRAE = {"cmu/mb/*": (3, 2), "cmu/iclone/*": (3, 2), "cmu/daz/*": (2, 1), "other/fair*": (4, 1)}


def read(path: Path) -> Skeleton:
    # One file mixes two units and wants to be told; none of them matters here.
    scale = 1.0 if "scale_clash" in path.name else 0.0
    return BvhReader(root_scale=scale).read(path).skeleton


def leaf(skeleton: Skeleton, found: PartMap, part: str) -> str:
    joint = found.joint(part)
    return "-" if joint is None else skeleton.joints[joint].rpartition("/")[2]


@pytest.mark.parametrize("pattern", CHAINS)
def test_a_captured_body_is_known_from_head_to_foot(mocap: Path, pattern: str) -> None:
    paths = sorted(mocap.glob(f"{pattern}.bvh"))
    assert paths
    for path in paths:
        skeleton = read(path)
        found = guess(skeleton)
        assert [leaf(skeleton, found, part) for part in PLACES] == CHAINS[pattern].split()


@pytest.mark.parametrize("pattern", VERTEBRAE)
def test_its_back_and_neck_are_counted(mocap: Path, pattern: str) -> None:
    for path in mocap.glob(f"{pattern}.bvh"):
        found = guess(read(path))
        assert (len(found.spine), len(found.neck)) == VERTEBRAE[pattern]


@pytest.mark.parametrize("pattern", NO_BODIES)
def test_a_captured_prop_is_refused_by_what_it_lacks(mocap: Path, pattern: str) -> None:
    for path in mocap.glob(f"{pattern}.bvh"):
        try:
            skeleton = read(path)
        except FileError:
            continue  # the reader has refused it
        with pytest.raises(SceneError, match=NO_BODIES[pattern]):
            guess(skeleton)


def test_every_file_stands_in_a_table_above(mocap: Path) -> None:
    listed = {path for pattern in (*CHAINS, *NO_BODIES) for path in mocap.glob(f"{pattern}.bvh")}
    listed |= {mocap / f"odd/bvh/{name}.bvh" for name in UNREADABLE}
    assert listed == set(mocap.rglob("*.bvh"))


PEOPLE = {
    "CesiumMan.usdz": "Skeleton_torso_joint_1 Skeleton_neck_joint_2 Skeleton_arm_joint_L__4_ "
    "Skeleton_arm_joint_L__2_ leg_joint_L_1 leg_joint_L_3 leg_joint_L_5",
    "RiggedFigure.usdz": "torso_joint_1 neck_joint_2 arm_joint_L_1 arm_joint_L_3 leg_joint_L_1 "
    "leg_joint_L_3 leg_joint_L_5",
    "skeleton_66.usda": "Hips Head LArm LHand LLeg LFoot LToes",
}
OTHERS = {
    "SoC-ElephantWithMonochord.usdc": "because of its joint '.*/Tail'|no joint",
    "RiggedSimple.usdz": "no joint of the skeleton can be told to be part of a human body",
    "arm_sparse_anim.usda": "no joint",
    "skinnedArm.usda": "no joint",
    "skel_lbs.usda": "no joint",
    "skel_dqs.usda": "no joint",
}


def skeletons(path: Path) -> list[Skeleton]:
    stage = Usd.Stage.Open(str(path))
    prims = [UsdSkel.Skeleton(prim) for prim in stage.Traverse() if prim.IsA(UsdSkel.Skeleton)]
    assert prims
    return [_skeleton(prim) for prim in prims]


def _skeleton(prim: UsdSkel.Skeleton) -> Skeleton:
    joints = [str(token) for token in prim.GetJointsAttr().Get()]
    parents = UsdSkel.Topology(joints).GetParentIndices()
    rest = [matrix.ExtractTranslation() for matrix in prim.GetRestTransformsAttr().Get()]
    upright = np.tile((0.0, 0.0, 0.0, 1.0), (len(joints), 1))
    return Skeleton(tuple(joints), np.array(parents), np.array(rest), upright)


@pytest.mark.parametrize("name", PEOPLE)
def test_a_person_of_somebody_else_is_known(mocap: Path, name: str) -> None:
    (skeleton,) = skeletons(mocap / "usd" / name)
    found = guess(skeleton)
    assert [leaf(skeleton, found, part) for part in PLACES] == PEOPLE[name].split()


@pytest.mark.parametrize("name", OTHERS)
def test_animals_arms_and_props_are_refused(mocap: Path, name: str) -> None:
    for skeleton in skeletons(mocap / "usd" / name):
        with pytest.raises(SceneError, match=OTHERS[name]):
            guess(skeleton)

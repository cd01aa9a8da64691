"""Every family of names that riggers and recorders use."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from pxr import Usd

import usdmotion.usd  # noqa: F401  registers the schema
from usdmotion.demos.body import humanoid
from usdmotion.humanoid import NEEDED, PARTS, PartMap, guess
from usdmotion.motion import Skeleton

Tree = dict[str, str]
SkeletonOf = Callable[..., Skeleton]
Told = Callable[[Tree, PartMap], dict[str, str]]

ARM = ("sternoclavicular", "shoulder", "elbow", "radiocarpal")
LEG = ("hip", "knee", "talocrural", "metatarsophalangeal")

FAMILIES = {
    # trunk up to the chest; neck; head; left arm; left leg; left and right
    "mixamo": (
        "mixamorig:Hips mixamorig:Spine mixamorig:Spine1 mixamorig:Spine2",
        "mixamorig:Neck",
        "mixamorig:Head",
        "mixamorig:LeftShoulder mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand",
        "mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot mixamorig:LeftToeBase",
        "Left Right",
    ),
    "mixamo, as USD has it": (
        "mixamorig7_Hips mixamorig7_Spine mixamorig7_Spine1",
        "mixamorig7_Neck",
        "mixamorig7_Head",
        "mixamorig7_LeftShoulder mixamorig7_LeftArm mixamorig7_LeftForeArm mixamorig7_LeftHand",
        "mixamorig7_LeftUpLeg mixamorig7_LeftLeg mixamorig7_LeftFoot mixamorig7_LeftToeBase",
        "Left Right",
    ),
    "Rokoko, FAIR, Vicon": (
        "Hips Spine Spine1 Spine2 Spine3",
        "Neck Neck1",
        "Head",
        "LeftShoulder LeftArm LeftForeArm LeftHand",
        "LeftUpLeg LeftLeg LeftFoot LeftForeFoot",
        "Left Right",
    ),
    "mocapbank": (
        "Hips Chest Chest2",
        "Neck",
        "Head",
        "LeftCollar LeftShoulder LeftElbow LeftWrist",
        "LeftHip LeftKnee LeftAnkle",
        "Left Right",
    ),
    "DAZ": (
        "hip abdomen chest",
        "neck",
        "head",
        "lCollar lShldr lForeArm lHand",
        "lThigh lShin lFoot",
        "l r",
    ),
    "all small": (
        "hip lowerback abdomen chest",
        "neck neck1",
        "head",
        "lcollar lshoulder lelbow lhand",
        "lhip lknee lfoot ltoebase",
        "l r",
    ),
    "bones of anatomy": (
        "pelvis thorax",
        "",
        "head",
        "lclavicle lhumerus lradius lhand",
        "lfemur ltibia lfoot ltoes",
        "l r",
    ),
    "iClone": (
        "CC_Base_Hip CC_Base_Waist CC_Base_Spine01 CC_Base_Spine02",
        "CC_Base_NeckTwist01 CC_Base_NeckTwist02",
        "CC_Base_Head",
        "CC_Base_L_Clavicle CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand",
        "CC_Base_L_Thigh CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase",
        "L_ R_",
    ),
    "Unreal": (
        "pelvis spine_01 spine_02 spine_03",
        "neck_01",
        "head",
        "clavicle_l upperarm_l lowerarm_l hand_l",
        "thigh_l calf_l foot_l ball_l",
        "_l _r",
    ),
    "Blender": (
        "hips spine chest upper_chest",
        "neck",
        "head",
        "shoulder.L upper_arm.L forearm.L hand.L",
        "thigh.L shin.L foot.L toe.L",
        ".L .R",
    ),
    "Unity": (
        "Hips Spine Chest UpperChest",
        "Neck",
        "Head",
        "LeftShoulder LeftUpperArm LeftLowerArm LeftHand",
        "LeftUpperLeg LeftLowerLeg LeftFoot LeftToes",
        "Left Right",
    ),
    "VRM": (
        "J_Bip_C_Hips J_Bip_C_Spine J_Bip_C_Chest",
        "J_Bip_C_Neck",
        "J_Bip_C_Head",
        "J_Bip_L_Shoulder J_Bip_L_UpperArm J_Bip_L_LowerArm J_Bip_L_Hand",
        "J_Bip_L_UpperLeg J_Bip_L_LowerLeg J_Bip_L_Foot J_Bip_L_ToeBase",
        "_L_ _R_",
    ),
    "Xsens": (
        "Pelvis L5 L3 T12 T8",
        "Neck",
        "Head",
        "LeftShoulder LeftUpperArm LeftForeArm LeftHand",
        "LeftUpperLeg LeftLowerLeg LeftFoot LeftToe",
        "Left Right",
    ),
    "SMPL": (
        "m_avg_Pelvis m_avg_Spine1 m_avg_Spine2 m_avg_Spine3",
        "m_avg_Neck",
        "m_avg_Head",
        "m_avg_L_Collar m_avg_L_Shoulder m_avg_L_Elbow m_avg_L_Wrist",
        "m_avg_L_Hip m_avg_L_Knee m_avg_L_Ankle m_avg_L_Foot",
        "_L_ _R_",
    ),
    "suffixed": (
        "hips_jnt spine_a_jnt spine_b_jnt",
        "neck_jnt",
        "head_jnt",
        "L_clavicle_jnt L_shoulder_jnt L_elbow_jnt L_wrist_jnt",
        "L_hip_jnt L_knee_jnt L_ankle_jnt L_toe_jnt",
        "L_ R_",
    ),
    "hip, leg": (
        "Hips Torso Chest UpChest",
        "Neck",
        "Head",
        "LShldr LArm LElbow LHand",
        "LLeg LKnee LFoot LToes",
        "L R",
    ),
    "Genesis": (
        "hip abdomenLower abdomenUpper chestLower chestUpper",
        "neckLower neckUpper",
        "head",
        "lCollar lShldrBend lForearmBend lHand",
        "lThighBend lShin lFoot lToe",
        "l r",
    ),
    "Biped": (
        "Bip01_Pelvis Bip01_Spine Bip01_Spine1 Bip01_Spine2",
        "Bip01_Neck",
        "Bip01_Head",
        "Bip01_L_Clavicle Bip01_L_UpperArm Bip01_L_Forearm Bip01_L_Hand",
        "Bip01_L_Thigh Bip01_L_Calf Bip01_L_Foot Bip01_L_Toe0",
        "_L_ _R_",
    ),
    "hip as leg, in words": (
        "Hips Spine Chest",
        "Neck",
        "Head",
        "Left_shoulder Left_arm Left_elbow Left_wrist",
        "Left_leg Left_knee Left_ankle Left_toe",
        "Left Right",
    ),
    "numbered": (
        "torso_joint_1 torso_joint_2 torso_joint_3",
        "neck_joint_1",
        "neck_joint_2",
        "arm_joint_L__4_ arm_joint_L__3_ arm_joint_L__2_",
        "leg_joint_L_1 leg_joint_L_2 leg_joint_L_3 leg_joint_L_5",
        "_L_ _R_",
    ),
}


def row(above: str, names: Sequence[str]) -> Tree:
    """Return joints one below the other."""
    return dict(zip(names, (above, *names), strict=False))


def family(name: str) -> tuple[Tree, dict[str, str]]:
    """Return the hierarchy of a family, and the part of each of its joints beside vertebrae."""
    trunk, neck, head, arm, leg, sides = (text.split() for text in FAMILIES[name])
    tree, parts = (
        row("", [*trunk, *neck, *head]),
        {trunk[0]: "humanoid_root", head[0]: "skullbase"},
    )
    for side, letter in zip(sides, "lr", strict=True):
        arms = [each.replace(sides[0], side, 1) for each in arm]
        legs = [each.replace(sides[0], side, 1) for each in leg]
        tree |= row(trunk[-1], arms) | row(trunk[0], legs)
        chain = ARM if len(arm) == 4 else ARM[1:]
        parts |= {each: f"{letter}_{part}" for each, part in zip(arms, chain, strict=True)}
        parts |= {each: f"{letter}_{part}" for each, part in zip(legs, LEG, strict=False)}
    return tree, parts


def is_vertebra(part: str) -> bool:
    return part.startswith(("vl", "vt", "vc"))


def test_the_parts_are_those_of_the_schema() -> None:
    schema = Usd.SchemaRegistry().FindAppliedAPIPrimDefinition("MotionSkeletonAPI")
    tokens = schema.GetPropertyMetadata("usdmotion:parts", "allowedTokens")
    assert ("", *PARTS) == tuple(tokens)
    assert set(NEEDED) <= set(PARTS)


@pytest.mark.parametrize("name", FAMILIES)
def test_a_family_of_names_is_known(name: str, skeleton_of: SkeletonOf, told: Told) -> None:
    tree, wanted = family(name)
    found = told(tree, guess(skeleton_of(tree)))
    assert {joint: part for joint, part in found.items() if not is_vertebra(part)} == wanted
    column = FAMILIES[name][0].split()[1:] + FAMILIES[name][1].split()
    assert [joint for joint, part in found.items() if is_vertebra(part)] == column


@pytest.mark.parametrize("name", FAMILIES)
def test_twists_ends_props_and_order_change_nothing(
    name: str, skeleton_of: SkeletonOf, told: Told
) -> None:
    tree, _ = family(name)
    found = told(tree, guess(skeleton_of(tree)))
    more = {"World": ""} | {joint: above or "World" for joint, above in tree.items()}
    bare = [joint for joint in tree if joint != "neck_joint_2"]  # a head because it is the end
    more |= {f"{joint}_twist_01": joint for joint in bare}
    more |= {f"{joint}_end": joint for joint in bare if joint not in tree.values()}
    more |= {"sword": bare[-1], "hilt": "sword"}
    order = sorted(more, key=lambda joint: (depth(more, joint), joint))
    other = {joint: more[joint] for joint in order}
    assert told(other, guess(skeleton_of(other))) == found


def depth(tree: Tree, joint: str) -> int:
    return 1 + depth(tree, tree[joint]) if joint else 0


@pytest.mark.parametrize("name", FAMILIES)
def test_the_side_that_a_body_faces_changes_nothing(name: str, skeleton_of: SkeletonOf) -> None:
    skeleton = skeleton_of(family(name)[0])
    rng = np.random.default_rng(1)
    anywhere = Skeleton(
        skeleton.joints,
        skeleton.parents,
        0.2 * _unit(rng.normal(size=skeleton.rest_translations.shape)),
        _unit(rng.normal(size=skeleton.rest_rotations.shape)),
    )
    assert guess(anywhere) == guess(skeleton)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def test_h_anim_names_are_taken_as_they_are(skeleton_of: SkeletonOf) -> None:
    tree = row("", ["humanoid_root", "vl4", "vt3", "vc4", "skullbase"])
    tree |= {"sacroiliac": "humanoid_root"}
    for side in "lr":
        tree |= row("vt3", [f"{side}_{part}" for part in (ARM[0], "acromioclavicular", *ARM[1:])])
        tree |= row("sacroiliac", [f"{side}_{part}" for part in LEG])
    assert guess(skeleton_of(tree)).parts == tuple(tree)


def test_the_demo_body_is_guessed_as_it_says_itself() -> None:
    skeleton, _, parts = humanoid()
    assert guess(skeleton).parts == parts


def test_the_original_names_are_read_where_tokens_say_nothing(
    skeleton_of: SkeletonOf, body: Tree
) -> None:
    skeleton = skeleton_of(body)
    bare = Skeleton(
        tuple(f"n{joint}" for joint in range(len(body))),
        skeleton.parents,
        skeleton.rest_translations,
        skeleton.rest_rotations,
    )
    assert guess(bare, names=list(body)) == guess(skeleton)

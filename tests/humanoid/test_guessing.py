"""What the hierarchy decides, what wins over a guess, and what is refused."""

from collections.abc import Callable

import pytest

from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap, guess, pelvis, recognize
from usdmotion.motion import Skeleton

Tree = dict[str, str]
SkeletonOf = Callable[..., Skeleton]
Told = Callable[[Tree, PartMap], dict[str, str]]


def without(tree: Tree, *names: str) -> Tree:
    """Return a hierarchy without some joints; what is below them moves up."""
    kept = dict(tree)
    for name in names:
        above = kept.pop(name)
        kept = {joint: above if parent == name else parent for joint, parent in kept.items()}
    return kept


def test_vertebrae_are_spread_over_the_column(skeleton_of, told, body) -> None:
    assert told(body, guess(skeleton_of(body)))["Spine"] == "vl5"
    found = guess(skeleton_of(body))
    assert [list(body)[joint] for joint in found.spine] == ["Spine", "Chest"]
    assert [list(body)[joint] for joint in found.neck] == ["Neck"]


def test_the_joint_between_pelvis_and_legs_is_the_sacroiliac(skeleton_of, told, body) -> None:
    """As iClone and Genesis have it: a hip that carries all, a pelvis that carries the legs."""
    tree = {"Root": "", **body, "Hips": "Root", "Pelvis": "Hips"}
    tree = {j: "Pelvis" if j.endswith("UpLeg") else above for j, above in tree.items()}
    tree = {joint: tree[joint] for joint in sorted(tree, key=lambda j: "Leg" in j or "Foot" in j)}
    tree = {joint: tree[joint] for joint in sorted(tree, key=lambda j: "Toe" in j)}
    found = told(tree, guess(skeleton_of(tree)))
    assert (found["Hips"], found["Pelvis"]) == ("humanoid_root", "sacroiliac")
    assert "Root" not in found


def test_legs_on_the_first_vertebra_leave_the_pelvis_where_it_is(skeleton_of, told, body) -> None:
    """As old bipeds have it."""
    tree = {j: "Spine" if j.endswith("UpLeg") else above for j, above in body.items()}
    found = told(tree, guess(skeleton_of(tree)))
    assert (found["Hips"], found["Spine"]) == ("humanoid_root", "vl5")


def test_a_joint_without_length_that_carries_something_is_a_part(skeleton_of, told, body) -> None:
    """As CMU has it: `LHipJoint` at the pelvis, `Neck` at the chest, a thumb that is nothing."""
    tree = {**body, "Neck1": "Neck", "LThumb": "LeftHand"}
    tree["Head"] = "Neck1"
    tree = {joint: tree[joint] for joint in sorted(tree, key=lambda joint: joint == "Head")}
    tree = {"Hips": "", "LHipJoint": "Hips", **tree, "LeftUpLeg": "LHipJoint"}
    nothing = dict.fromkeys(("LHipJoint", "Neck", "LThumb"), 0.0)
    found = told(tree, guess(skeleton_of(tree, nothing)))
    assert found["LeftUpLeg"] == "l_hip"
    assert (found["Neck"], found["Neck1"]) == ("vc7", "vc4")
    assert not {"LHipJoint", "LThumb"} & set(found)


def test_names_below_a_side_need_not_say_it_again(skeleton_of, body) -> None:
    tree = {}
    for joint, above in body.items():
        inner = joint.endswith(("ForeArm", "Hand", "Leg", "Foot")) and "Up" not in joint
        side = next((s for s in ("Left", "Right") if joint.startswith(s)), "")
        tree[joint.replace(side, f"{side[0]} ") if inner else joint] = above
    names = [joint[2:] if joint[1] == " " else joint for joint in tree]
    assert guess(skeleton_of(body), names=names) == guess(skeleton_of(body))


def test_of_two_halves_of_a_limb_the_upper_is_the_joint(skeleton_of, told, body) -> None:
    """As MakeHuman has it, with a shoulder beside the clavicle too."""
    tree = {}
    for joint, above in body.items():
        tree[joint] = f"{above}02" if above.endswith(("UpLeg", "ForeArm")) else above
        if joint.endswith(("UpLeg", "ForeArm")):
            tree[f"{joint}02"] = joint
    assert told(tree, guess(skeleton_of(tree))) == told(body, guess(skeleton_of(body)))


FINGERS = {
    "LeftHandIndex1 LeftHandIndex2 LeftHandIndex3 LeftHandIndex4": "mcp pip dip",
    "LeftHandIndex LeftHandIndex1 LeftHandIndex2 LeftHandIndex3": "cmc mcp pip dip",
    "LeftInHandIndex LeftHandIndex1 LeftHandIndex2 LeftHandIndex3": "cmc mcp pip dip",
    "index_metacarpal_l index_01_l index_02_l index_03_l": "cmc mcp pip dip",
    "palm.01.L finger2-1.L finger2-2.L finger2-3.L": "- mcp pip dip",
    "f_index.01.L f_index.02.L f_index.03.L": "mcp pip dip",
    "Index Mid Tip End": "mcp pip dip",
}
JOINTS = {
    "cmc": "l_carpometacarpal_2",
    "mcp": "l_metacarpophalangeal_2",
    "pip": "l_carpal_proximal_interphalangeal_2",
    "dip": "l_carpal_distal_interphalangeal_2",
}


@pytest.mark.parametrize("names", FINGERS)
def test_a_finger_is_counted_from_its_knuckle(names, skeleton_of, told, body) -> None:
    finger = names.split()
    tree = body | dict(zip(finger, ("LeftHand", *finger), strict=False))
    found = told(tree, guess(skeleton_of(tree)))
    wanted = [JOINTS.get(joint, "") for joint in FINGERS[names].split()]
    assert [found.get(name, "") for name in finger][: len(wanted)] == wanted
    assert len(found) == len(body) + len([joint for joint in wanted if joint])


def test_toes_are_counted_where_the_foot_has_no_ball(skeleton_of, told, body) -> None:
    tree = without(body, "LeftToeBase") | {"toe1-1.L": "LeftFoot", "toe2-1.L": "LeftFoot"}
    found = told(tree, guess(skeleton_of(tree)))
    assert found["toe1-1.L"] == "l_metatarsophalangeal_1"
    assert found["toe2-1.L"] == "l_metatarsophalangeal_2"


def test_what_is_given_wins_and_the_rest_is_guessed(skeleton_of, told, body) -> None:
    tree = body | {"LeftClaw": "LeftForeArm"}
    given = ["l_radiocarpal" if joint == "LeftClaw" else "" for joint in tree]
    found = told(tree, guess(skeleton_of(tree), given=given))
    assert found["LeftClaw"] == "l_radiocarpal" and "LeftHand" not in found
    assert found["RightHand"] == "r_radiocarpal"


def test_a_guess_that_is_given_is_guessed_again(skeleton_of, body) -> None:
    found = guess(skeleton_of(body))
    assert guess(skeleton_of(body), given=found.parts) == found
    strangers = [f"j{joint}" for joint in range(len(body))]
    assert guess(skeleton_of(body), names=strangers, given=found.parts) == found


@pytest.mark.parametrize(
    ("given", "fault"),
    [
        (["humanoid_root"], "has 1 names for 21 joints"),
        (["pelvis"] + [""] * 20, "names 'pelvis', which is no part of a body"),
        (["skullbase"] * 2 + [""] * 19, "names 'skullbase' twice"),
    ],
)
def test_given_parts_that_cannot_be_are_refused(given, fault, skeleton_of, body) -> None:
    with pytest.raises(SceneError, match=f"usdmotion:parts of </A> {fault}"):
        guess(skeleton_of(body), given=given, who="</A>")
    assert pelvis(skeleton_of(body), given) is None


REFUSED = {
    "a hand short": (lambda body: without(body, "LeftHand"), "told to be l_radiocarpal; author"),
    "no head": (lambda body: without(body, "Head"), "told to be skullbase; author"),
    "two heads": (lambda body: {**body, "Head2": "Neck"}, "several joints .* could be skullbase"),
    "two hands": (
        lambda body: {**body, "LeftForeArm_B": "LeftArm", "LeftHand_2": "LeftForeArm"},
        "several joints of </A> could be l_radiocarpal; author",
    ),
    "no sides": (
        lambda body: {joint: above for joint, above in body.items() if "Right" not in joint},
        "told to be r_shoulder, r_elbow, .*r_talocrural; author",
    ),
    "no back": (lambda body: without(body, "Spine", "Chest"), "told to be vl5; author"),
    "a tail": (lambda body: {**body, "Tail1": "Hips"}, "because of its joint 'Hips/Tail1'; author"),
    "a trunk": (lambda body: {**body, "Trunk": "Head"}, "because of its joint '.*/Head/Trunk'"),
    "an arm": (lambda _: {"Shoulder": "", "Elbow": "Shoulder"}, "no joint .* a human body; author"),
    "a prop": (lambda _: {"Bone": "", "Bone_001": "Bone"}, "no joint of </A> can be told"),
    "four legs": (
        lambda body: {joint.replace("Arm", "FrontLeg"): "" for joint in body},
        "told to be .*l_shoulder",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_sure_is_refused_by_name(name, skeleton_of, body) -> None:
    change, fault = REFUSED[name]
    skeleton = skeleton_of(change(body))
    with pytest.raises(SceneError, match=fault) as refused:
        guess(skeleton, who="</A>")
    assert "author usdmotion:parts" in str(refused.value)
    assert recognize(skeleton) is None
    assert pelvis(skeleton) is None


@pytest.mark.parametrize("length", [0.0, 0.05])
def test_left_and_right_have_to_confirm_each_other(length, skeleton_of, body) -> None:
    with pytest.raises(SceneError, match=r"l_hip to l_knee and 0.2 m on the right"):
        guess(skeleton_of(body, {"LeftLeg": length}))


def test_the_pelvis_is_the_given_one_even_of_a_stranger(skeleton_of, body) -> None:
    prop = skeleton_of({"Bone": "", "Bone_001": "Bone"})
    assert pelvis(prop, ["", "humanoid_root"]) == 1
    assert pelvis(prop, ["", "sacroiliac"]) == 1
    assert pelvis(prop, ["", "vl5"]) is None
    assert pelvis(skeleton_of(body)) == 0
    assert pelvis(skeleton_of(body), [""] * len(body)) == 0

"""The root of a solve: what is read, what is checked and what is shown never differ."""

import pytest

from usdmotion import usd
from usdmotion.constraints import built_in

JOINTS = ("world", "world/hip", "world/hip/knee", "world/hip/knee/ankle")
HELD = """uniform token usdmotion:joint = "world/hip/knee/ankle\""""
EDIT = f"""def MotionEdit "Edit" {{
    def MotionPositionConstraint "High" {{
        {HELD}
        uniform token[] usdmotion:recruits = ["world/hip/knee/ankle"]
    }}
    def MotionPositionConstraint "Low" {{
        {HELD}
        uniform int usdmotion:priority = 2
    }}
}}"""


def moving(text, **travels):
    """Return an animation in which some joints travel so far from one sample to the next."""
    first = {"world": 0, "hip": 9, "knee": -4, "ankle": -4}
    second = [(travels.get(name, 0), y, 0) for name, y in first.items()]
    return f"""uniform token[] joints = {text.quoted(JOINTS)}
    half3[] scales = {text.listed([(1, 1, 1)] * 4)}
    quatf[] rotations = {text.listed([(1, 0, 0, 0)] * 4)}
    float3[] translations.timeSamples = {{
        1: {text.listed((0, y, 0) for y in first.values())},
        2: {text.listed(second)},
    }}"""


@pytest.fixture
def roots(text, save, read):
    """Return a function that builds a stage and tells its root by everyone who has a say."""

    def run(animation, parts=(), body="", **options):
        named = f"uniform token[] usdmotion:parts = {text.quoted(parts)}" if parts else ""
        rest = f"uniform matrix4d[] restTransforms = {text.listed([text.at(0, 1, 0)] * 4)}"
        options = {"edit": EDIT, "skeleton": named, "rest": rest, "bind": ""} | options
        man = text.man(joints=JOINTS, animation=animation, **options).replace(
            '["SkelBindingAPI"]', '["SkelBindingAPI", "MotionSkeletonAPI"]'
        )
        path = save(man + body)
        found = usd.inspect(path, built_in())
        # The lower rank may move everything up to the root, which the higher one does not recruit.
        (rule,) = (fault for fault in found.faults if fault.name == "RecruitingRule")
        checked = rule.sentence.split("'")[1]
        character = read(path).scenes[0].characters[0]
        return {character.skeleton.joints[character.root], checked, found.skeletons[0].root}

    return run


@pytest.mark.parametrize(
    ("parts", "root"),
    [
        (("", "", "humanoid_root", ""), "world/hip/knee"),
        (("", "", "sacroiliac", ""), "world/hip/knee"),
        (("", "sacroiliac", "humanoid_root", ""), "world/hip/knee"),
        (("", "", "l_hip", ""), "world"),
    ],
)
def test_it_is_the_pelvis_where_one_is_named(text, roots, parts, root):
    assert roots(moving(text, world=1), parts) == {root}


@pytest.mark.parametrize(
    ("travels", "root"),
    [
        ({}, "world"),
        ({"hip": 1}, "world/hip"),
        ({"hip": 1, "knee": 1}, "world/hip"),
        ({"hip": 1e-3}, "world"),  # noise
        ({"ankle": 1}, "world"),  # it stretches, and carries too little of the body
    ],
)
def test_else_it_is_the_topmost_joint_that_travels_and_carries_the_body(text, roots, travels, root):
    assert roots(moving(text, **travels)) == {root}


def test_what_usd_does_not_show_does_not_travel(text, roots):
    animation = "\n".join(line for line in moving(text, hip=1).splitlines() if "scales" not in line)
    assert roots(animation) == {"world"}


def test_it_is_that_of_the_motion_that_the_edit_starts_from(text, roots):
    run = f'def SkelAnimation "Run" {{\n{moving(text, hip=1)}\n}}'
    edit = EDIT.replace("{", "{\nrel usdmotion:source = </Run>", 1)
    assert roots(moving(text), edit=edit, body=run) == {"world/hip"}


def test_a_result_that_travels_does_not_change_the_root_of_its_own_edit(text, roots):
    result = f"""def SkelAnimation "Edit_result" (
        prepend apiSchemas = ["MotionResultAPI"]
    )
    {{
        rel usdmotion:result:edit = </Man/Bones/Edit>
        rel usdmotion:result:source = </Man/Walk>
        {moving(text, hip=1)}
    }}
    """
    bound = "rel skel:animationSource = </Man/Bones/Edit_result>"
    assert roots(moving(text), edit=result + EDIT, on_skeleton=bound) == {"world"}

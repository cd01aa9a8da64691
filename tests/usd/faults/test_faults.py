"""Every check fires on a stage made for it, and is silent on a good one."""

from pathlib import Path

import pytest
from pxr import Sdf, UsdSkel

import usdmotion.usd.faults
from usdmotion.usd.faults import find

SKELETON = "/Body/Skeleton"
EDIT = f"{SKELETON}/Edit"


def test_a_fault_is_found_and_named_with_its_prim_and_what_would_do(stage, case):
    name, change = case
    change(stage)
    found = [fault for fault in find(stage) if fault.name == name]
    assert found, find(stage)
    for fault in found:
        assert fault.sentence.startswith(f"<{fault.path}> ")
        assert stage.GetPrimAtPath(fault.path)
        assert "\n" not in fault.sentence and len(fault.sentence) < 300
        # What is wrong, and after the last of these what would do.
        assert any(mark in fault.sentence for mark in ("; ", ", so ", "?"))


def test_nothing_is_found_on_a_good_stage(stage):
    assert find(stage) == []


def test_every_fault_that_can_be_found_has_a_case(named):
    folder = Path(usdmotion.usd.faults.__file__).parent
    source = "".join(path.read_text() for path in sorted(folder.glob("*.py")))
    calls = source.split("yield error(")[1:] + source.split("yield warning(")[1:]
    calls += source.split("yield note(")[1:]
    assert {call.split('"')[1] for call in calls} == named


def test_one_fault_of_a_skeleton_is_not_told_by_everything_that_uses_it(stage, put):
    put(SKELETON, "joints", [])(stage)
    assert [fault.name for fault in find(stage)] == ["NoJoints"]


def test_an_unknown_joint_is_answered_with_what_was_meant(stage, put):
    put(f"{EDIT}/Hand", "usdmotion:joint", "hand")(stage)
    (fault,) = find(stage)
    assert fault.path == f"{EDIT}/Hand"
    assert "'hand'" in fault.sentence
    assert "did you mean 'hips/spine/arm/hand'?" in fault.sentence


def test_a_broken_recruiting_rule_names_the_joints_that_mend_it(stage, put):
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    found = [fault for fault in find(stage) if fault.path == f"{EDIT}/Hand"]
    assert [fault.severity for fault in found] == ["warning"]
    assert "'hips'" in found[0].sentence and f"<{EDIT}/Foot>" in found[0].sentence


def test_mending_the_recruits_as_told_silences_the_rule(stage, put):
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg", "hips"])(stage)
    assert find(stage) == []


def test_the_default_recruits_end_at_the_joint_that_travels_where_no_part_names_the_root(
    stage, put
):
    # Of the five joints only the hips travel; a foot that recruits from them down keeps the rule.
    put(SKELETON, "usdmotion:parts", ["", "", "", "", ""])(stage)
    assert find(stage) == []


def test_joints_above_the_root_of_the_solve_are_not_recruited_by_default(stage, put):
    put(SKELETON, "usdmotion:parts", ["", "humanoid_root", "", "", ""])(stage)
    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    # The arm now ends at the spine, and only what crosses over to the leg needs the hips.
    lows = {fault.path for fault in find(stage) if fault.name == "RecruitingRule"}
    assert f"{EDIT}/Aim" not in lows


def test_an_inactive_constraint_is_not_looked_at(stage, put):
    put(f"{EDIT}/Aim", "usdmotion:aim", (0, 0, 0))(stage)
    stage.GetPrimAtPath(f"{EDIT}/Aim").SetActive(False)
    assert find(stage) == []


def test_a_skeleton_inside_an_instance_is_looked_at(stage):
    inner = stage.DefinePrim("/Class/Skeleton", "Skeleton")
    UsdSkel.Skeleton(inner).CreateJointsAttr(["a/b", "a"])
    stage.GetPrimAtPath("/Class").SetSpecifier(Sdf.SpecifierClass)
    instance = stage.DefinePrim("/Instance", "SkelRoot")
    instance.GetReferences().AddInternalReference("/Class")
    instance.SetInstanceable(True)
    assert "/Instance/Skeleton" in {fault.path for fault in find(stage)}


def test_an_edit_without_any_motion_cannot_be_solved_but_a_skeleton_may_rest(stage, point):
    point(SKELETON, "skel:animationSource")(stage)
    severities = {fault.path: fault.severity for fault in find(stage)}
    assert severities == {SKELETON: "warning", EDIT: "error"}


@pytest.mark.parametrize("kind", ["line", "plane", "slide"])
def test_only_kinds_of_contact_with_an_axis_need_one(stage, put, kind):
    contact = f"{EDIT}/Detection/Contact"
    put(contact, "usdmotion:axis", (0, 0, 0))(stage)
    assert find(stage) == []
    put(contact, "usdmotion:kind", kind)(stage)
    assert [fault.name for fault in find(stage)] == ["ZeroAxis"]

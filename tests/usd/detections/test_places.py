"""Where detections go: into the edit of their skeleton, outside of instances, beside props."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import SceneError, pipeline

STAGES = Path(__file__).parents[3] / "stages"
TWO = """
def SkelRoot "Woman" (references = </Man>) {
    double3 xformOp:translate = (0, 0, 50)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def paths(report):
    return [each.path for each in report.objects]


def test_a_skeleton_without_an_edit_gets_one_for_all_of_its_joints(shot, detect, opened):
    report = detect(shot(), joints=["foot", "hand"])
    assert paths(report) == ["/Man/Bones/Contacts/foot", "/Man/Bones/Contacts/hand"]
    edits = [prim for prim in opened().Traverse() if prim.GetTypeName() == "MotionEdit"]
    assert [str(prim.GetPath()) for prim in edits] == ["/Man/Bones/Contacts"]


def test_an_edit_that_is_there_is_used_and_a_name_that_is_taken_is_not(shot, detect):
    there = """def MotionEdit "Mine" { def MotionPositionConstraint "foot" {
        uniform token usdmotion:joint = "hips/foot"
    }
    }"""
    assert paths(detect(shot(skeleton=there))) == ["/Man/Bones/Mine/foot2"]


def test_what_is_called_as_the_edit_would_be_is_left_alone(shot, detect):
    assert paths(detect(shot(skeleton='def Scope "Contacts" {}'))) == ["/Man/Bones/Contacts2/foot"]


def test_every_skeleton_that_has_the_joint_is_looked_at(shot, detect, still):
    report = detect(shot(more=TWO))
    assert paths(report) == ["/Man/Bones/Contacts/foot", "/Woman/Bones/Contacts/foot"]
    man, woman = still.seen
    np.testing.assert_allclose(woman.translations - man.translations, [[0, 0, 50]] * 24)


def test_an_instance_has_its_edit_beside_it(shot, detect, opened, tmp_path):
    body = TWO.replace("(references = </Man>)", "(instanceable = true\nreferences = </Man>)")
    report = detect(shot(more=body))
    assert paths(report)[1] == "/Woman_Contacts/foot"
    edit = opened().GetPrimAtPath("/Woman_Contacts")
    assert [str(each) for each in edit.GetRelationship("usdmotion:skeleton").GetTargets()] == [
        "/Woman/Bones"
    ]
    again = detect(tmp_path / "out.usda", "again.usda")
    assert sorted(paths(again)) == sorted(paths(report))


def test_all_joints_of_an_instance_share_one_edit_and_it_is_told_why_nothing_solves_it(
    tmp_path, opened
):
    shot = instanced(tmp_path)
    report = pipeline.detect(shot, tmp_path / "out.usda", joints=["LeftFoot", "RightFoot"])
    assert paths(report) == ["/Hero_Contacts/LeftFoot", "/Hero_Contacts/RightFoot"]
    edit = opened().GetPrimAtPath("/Hero_Contacts")
    assert edit.GetRelationship("usdmotion:skeleton").GetTargets() == ["/Hero/Skeleton"]
    (note,) = [each for each in report.notes if "cannot be solved" in each]
    assert "make the instance not instanceable" in note
    with pytest.raises(SceneError, match="make the instance not instanceable"):
        pipeline.solve(tmp_path / "out.usda", tmp_path / "edit.usda")


def test_contacts_of_an_instance_that_binds_its_own_motion_are_solved(tmp_path):
    report = pipeline.detect(
        instanced(tmp_path, bound_outside=True), tmp_path / "out.usda", joints=["LeftFoot"]
    )
    assert report.count > 0
    assert not [each for each in report.notes if "cannot be solved" in each]
    (solved,) = pipeline.solve(tmp_path / "out.usda", tmp_path / "edit.usda").edits
    assert solved.path == "/Hero_Contacts"


def instanced(folder, *, bound_outside=False):
    """Write a stage on which the walker of `skating.usda` is an instance."""
    layer = Sdf.Layer.FindOrOpen(str(STAGES / "skating.usda"))
    walker = Sdf.Layer.CreateAnonymous(".usda")
    walker.TransferContent(layer)
    binding = ""
    if bound_outside:
        skeleton = walker.GetPrimAtPath("/Walker/Skeleton")
        skeleton.RemoveProperty(skeleton.relationships["skel:animationSource"])
        binding = "rel skel:animationSource = </Hero/Animation>"
    walker.Export(str(folder / "walker.usda"))
    rates = "\n".join(
        f"{name} = {getattr(layer, name):g}"
        for name in ("timeCodesPerSecond", "startTimeCode", "endTimeCode")
    )
    shot = folder / "shot.usda"
    shot.write_text(f"""#usda 1.0
(
metersPerUnit = 0.01
upAxis = "Y"
{rates}
)
def "Hero" (
    instanceable = true
    prepend apiSchemas = ["SkelBindingAPI"]
    prepend references = @./walker.usda@
) {{
    {binding}
}}
""")
    return shot


def test_the_motion_that_is_looked_at_is_the_source_and_not_the_result(
    shot, detect, still, tmp_path
):
    detect(shot(), "first.usda")
    hold = """def MotionPositionConstraint "Lift" {
        uniform token usdmotion:joint = "hips/foot"
        def MotionGoal "Up" {
            uniform token usdmotion:mode = "offset"
            double3 xformOp:translate = (0, 1, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }"""
    for name in ("Contacts", "Bones", "Man"):
        hold = f'over "{name}" {{\n{hold}\n}}'
    layer = tmp_path / "lift.usda"
    head = 'metersPerUnit = 1\nupAxis = "Y"\nsubLayers = [@./first.usda@]'
    layer.write_text(f"#usda 1.0\n(\n{head}\n)\n{hold}")
    pipeline.solve(layer, tmp_path / "edit.usda", compose=tmp_path / "solved.usda")
    stage = Usd.Stage.Open(str(tmp_path / "solved.usda"))
    result = stage.GetPrimAtPath("/Man/Bones/Contacts_result")
    assert result.GetAttribute("translations").Get(1) is not None
    detect(tmp_path / "solved.usda", "second.usda")
    first, second = still.seen
    np.testing.assert_array_equal(first.translations, second.translations)


def test_a_skeleton_that_nothing_moves_is_not_looked_at(shot, detect):
    bare = shot()
    bare.write_text(bare.read_text().replace("rel skel:animationSource = </Man/Walk>", ""))
    with pytest.raises(SceneError, match="no Skeleton and no MotionDetection"):
        detect(bare)


def test_a_stage_that_does_not_compose_is_refused(shot, detect):
    with pytest.raises(SceneError, match=r"shot.usda: .*does not compose"):
        detect(shot(more='def Xform "Gone" (references = @./gone.usda@) {}'))

"""What `inspect` says of a stage, in whatever state it is."""

import dataclasses
import json

import pytest

from usdmotion import usd
from usdmotion.constraints import built_in
from usdmotion.errors import FileError

EDIT = """def MotionEdit "Edit" {
    uniform timecode[] usdmotion:range = [2, 4]
    custom int usdmotion:option:iterations = 7
    def MotionPositionConstraint "Wrist" {
        uniform int usdmotion:priority = 2
        uniform token usdmotion:joint = "hip/head"
        uniform token[] usdmotion:recruits = ["hip"]
        uniform timecode[] usdmotion:times = [1, 2]
        def MotionGoal "Here" {}
        def MotionGoal "Further" {
            uniform token usdmotion:mode = "offset"
        }
    }
    def MotionDetection "Foot" {
        uniform token usdmotion:joint = "hip/knee/ankle"
        def MotionContactConstraint "Stance" {
            uniform token usdmotion:joint = "hip/knee/ankle"
            uniform token usdmotion:kind = "point"
            uniform timecode[] usdmotion:times = [2, 3]
            uniform bool usdmotion:template = true
        }
    }
}"""


@pytest.fixture
def found(text, save):
    path = save(text.man(edit=EDIT), header="metersPerUnit = 0.01\ntimeCodesPerSecond = 48")
    return usd.inspect(path, built_in())


def test_units_and_rates_are_told(found):
    assert (found.meters_per_unit, found.up_axis) == (0.01, "Y")
    assert (found.time_codes_per_second, found.frames_per_second) == (48, 24)
    assert found.start is None


def test_skeletons_and_clips_are_told(found, text):
    (skeleton,) = found.skeletons
    assert (skeleton.path, skeleton.joint_count, skeleton.root) == ("/Man/Bones", 4, "hip")
    assert skeleton.joints == text.JOINTS
    assert (skeleton.animation, skeleton.rest, skeleton.bind) == ("/Man/Walk", True, True)
    (clip,) = found.clips
    assert (clip.samples, clip.first, clip.last, clip.rate) == (5, 1, 5, 48)


def test_edits_constraints_and_goals_are_told(found):
    (edit,) = found.edits
    assert (edit.skeleton, edit.source, edit.solver) == (
        "/Man/Bones",
        "/Man/Walk",
        "prioritized_ik",
    )
    assert (edit.range, edit.options) == ((2, 4), ("iterations=7",))
    wrist, stance = found.constraints
    assert (wrist.type, wrist.priority, wrist.joint) == ("MotionPositionConstraint", 2, "hip/head")
    assert (wrist.recruits, wrist.times) == (("hip",), (1, 2))
    assert wrist.goals == ("Here (position)", "Further (offset)")
    assert wrist.solvable
    assert stance.solvable


def test_contacts_are_told(found):
    (contact,) = found.contacts
    assert (contact.kind, contact.target) == ("point", "hip/knee/ankle")
    assert (contact.times, contact.template) == ((2, 3), True)


def test_detections_are_told_with_how_many_contacts_they_have(found):
    (foot,) = found.detections
    assert (foot.path, foot.object) == ("/Man/Bones/Edit/Foot", "hip/knee/ankle")
    assert (foot.edit, foot.detector, foot.kinds) == ("/Man/Bones/Edit", "contacts", ("space",))
    assert (foot.contacts, foot.templates, foot.switched_off) == (1, 1, 0)
    assert not foot.pattern


def test_everything_goes_into_json(found):
    data = json.loads(json.dumps(dataclasses.asdict(found)))
    assert data["constraints"][0]["goals"] == ["Here (position)", "Further (offset)"]


def test_faults_of_every_sort_are_listed_without_solving(text, save):
    man = text.man(edit=EDIT.replace('"hip/head"', '"nose"'), animation=text.poses(scales=False))
    path = save(man, header="subLayers = [@./gone.usda@]")
    names = {fault.name for fault in usd.inspect(path, built_in()).faults}
    assert {"Composition", "UnknownJoint", "MissingTransforms"} <= names


@pytest.mark.parametrize(
    "body",
    [
        "",
        'def Skeleton "Bones" {}',
        'def Skeleton "Bones" {\nuniform token[] joints = ["a/b", "a", "a"]\n}',
        'def MotionEdit "Edit" {}',
        'def SkelAnimation "Walk" {\nuniform token[] joints = ["a"]\nhalf3[] scales = []\n}',
        'def MotionPositionConstraint "Alone" {}',
    ],
)
def test_nothing_is_too_broken_to_be_inspected(save, body):
    assert usd.inspect(save(body), built_in()).file.endswith("shot.usda")


def test_a_result_says_what_it_was_made_from(text, save, read, leave, tmp_path):
    shot = read(save(text.man()))
    usd.write(shot, leave(shot), tmp_path / "edit.usda")
    usd.compose(shot, tmp_path / "edit.usda", tmp_path / "all.usda")
    clips = {clip.path: clip for clip in usd.inspect(tmp_path / "all.usda", built_in()).clips}
    result = clips["/Man/Bones/Edit_result"]
    assert (result.edit, result.source) == ("/Man/Bones/Edit", "/Man/Walk")


def test_a_file_that_is_no_stage_is_refused(tmp_path):
    with pytest.raises(FileError, match="there is no such file"):
        usd.inspect(tmp_path / "none.usda", built_in())

"""What a detection carries, and what words say over it."""

import pytest

from usdmotion import OptionError, SceneError, inspect

CARRIED = """def MotionEdit "Mine" { def MotionDetection "Foot" {
    uniform token usdmotion:joint = "hips/foot"
    uniform token[] usdmotion:kinds = ["line", "point"]
    uniform double usdmotion:step = 0.05
    uniform double usdmotion:parallelAngle = 7
    uniform double usdmotion:mergeDistance = 4
    uniform double usdmotion:gap = 0.3
    uniform double usdmotion:gapDistance = 12
    uniform double usdmotion:minimum = 0.22
    double usdmotion:option:slack = 0.125
}
}"""
HEADER = 'metersPerUnit = 0.01\nupAxis = "Z"'


def test_attributes_are_honoured_in_metres_and_seconds(shot, detect, still, opened):
    detect(shot(skeleton=CARRIED, header=HEADER))
    (search,) = still.seen
    assert search.kinds == ("line", "point")
    assert (search.step, search.parallel_angle, search.gap) == (0.05, 7.0, 0.3)
    assert search.merge_distance == pytest.approx(0.04)
    assert search.gap_distance == pytest.approx(0.12)
    assert search.minimum == 0.22
    assert search.up.tolist() == [0.0, 0.0, 1.0]
    said = opened().GetRootLayer().customLayerData["usdmotion"]["detection"]
    assert said["options"]["/Man/Bones/Mine/Foot"] == {"slack": 0.125}


def test_what_is_not_said_is_left_at_its_default(shot, detect, still):
    detect(shot())
    (search,) = still.seen
    assert (search.parallel_angle, search.merge_distance, search.gap) == (5.0, 0.03, 0.4)


def test_words_win_and_are_written_down(shot, detect, still, tmp_path):
    detect(
        shot(skeleton=CARRIED),
        "first.usda",
        kinds=["space"],
        minimum=0.0,
        options={"slack": "0.5"},
    )
    detect(tmp_path / "first.usda", "second.usda")
    assert [search.kinds for search in still.seen] == [("space",)] * 2
    assert [search.minimum for search in still.seen] == [0.0, 0.0]


def test_another_detector_has_not_the_options_of_the_first(shot, detect, tmp_path):
    report = detect(shot(skeleton=CARRIED), "first.usda", detector="loose")
    assert report.objects[0].detector == "loose"
    again = detect(tmp_path / "first.usda", "second.usda")
    assert again.objects[0].detector == "loose"


def test_a_detector_that_there_is_not(shot, detect):
    with pytest.raises(OptionError, match="no detector 'tight'; there are: contacts, loose"):
        detect(shot(), detector="tight")


def test_an_option_that_there_is_not(shot, detect):
    with pytest.raises(OptionError, match="has no option 'slick'; it has: slack"):
        detect(shot(), options={"slick": 1})


def test_a_detection_may_stand_anywhere_and_its_contacts_are_data_there(
    shot, detect, still, tmp_path
):
    elsewhere = """def MotionDetection "Foot" {
        rel usdmotion:skeleton = </Man/Bones>
        uniform token usdmotion:joint = "hips/foot"
    }"""
    report = detect(shot(more=elsewhere))
    assert [each.path for each in report.objects] == ["/Foot"]
    found = inspect(tmp_path / "out.usda")
    assert not found.faults
    assert [(each.edit, each.contacts) for each in found.detections] == [("", 3)]
    assert not found.constraints


def test_what_holds_the_joint_already_is_told_of(shot, detect):
    held = """def MotionEdit "Mine" { def MotionPositionConstraint "Heel" {
        uniform token usdmotion:joint = "hips/foot"
    }
    }"""
    report = detect(shot(skeleton=held), joints=["foot", "hand"])
    (note,) = report.notes
    assert note.startswith("</Man/Bones/Mine/Heel> holds the joint 'foot' as well; where it")


def test_an_edit_that_is_named_is_where_contacts_go(shot, detect):
    two = 'def MotionEdit "One" {}\ndef MotionEdit "Two" {}'
    assert detect(shot(skeleton=two)).objects[0].path == "/Man/Bones/One/foot"
    named = detect(shot("b.usda", skeleton=two), "b.out.usda", edit="/Man/Bones/Two")
    assert named.objects[0].path == "/Man/Bones/Two/foot"
    with pytest.raises(SceneError, match="<Two> is no MotionEdit; there are: /Man/Bones/One"):
        detect(shot("c.usda", skeleton=two), "c.out.usda", edit="Two")


def test_a_template_outside_of_the_motion_is_named(shot, detect):
    late = """def MotionEdit "Mine" { def MotionDetection "Foot" {
        uniform token usdmotion:joint = "hips/foot"
        def MotionContactConstraint "Shown" {
            uniform bool usdmotion:template = true
            uniform timecode[] usdmotion:times = [30, 36]
        }
    }
    }"""
    with pytest.raises(SceneError, match="</Man/Bones/Mine/Foot/Shown> is from 30 to 36, outside"):
        detect(shot(skeleton=late))

"""Ordinary edits of detected contacts in a stronger layer, and detecting again over them."""

from pathlib import Path

import pytest
from pxr import Sdf

from usdmotion import FileError, SceneError

CONTACT = "/Man/Bones/Contacts/foot"


def said(contact, body):
    return f'over "{contact}" {{\n{body}\n}}'


def within(body, contact=""):
    """Return the text of a layer that says something of the detection, or of one contact."""
    if contact:
        body = f'over "{contact}" {body}' if body.startswith("(") else said(contact, body)
    return (
        f'over "Man" {{ over "Bones" {{ over "Contacts" {{ over "foot" {{\n{body}\n}}\n}}\n}}\n}}'
    )


def spans_of(stage, name=CONTACT):
    """Return the intervals of the contacts that are switched on, by their names."""
    return {
        child.GetName(): tuple(float(code) for code in child.GetAttribute("usdmotion:times").Get())[
            1:3
        ]
        for child in stage.GetPrimAtPath(name).GetChildren()
        if child.GetTypeName() == "MotionContactConstraint"
    }


def states_of(report):
    return [each.state for each in report.objects[0].contacts]


@pytest.fixture
def again(shot, detect, over, opened):
    """Return what detects, lets somebody say something in a stronger layer, and detects again."""

    def run(body, *, places=None, offset="", **asked):
        detect(shot(), "first.usda")
        if places is not None:
            shot(places=places)
        person = over("first.usda", body, offset=offset)
        report = detect(person, "second.usda", **asked)
        return report, opened("second.usda")

    return run


def test_nothing_said_means_nothing_changes(again, opened, steps):
    report, stage = again("")
    assert states_of(report) == ["detected"] * 3
    assert spans_of(stage) == spans_of(opened("first.usda"))
    assert not report.notes


def test_what_somebody_switched_off_stays_off(again, steps):
    report, stage = again(within("(active = false) {}", "Contact02"))
    assert set(spans_of(stage)) == {"Contact01", "Contact03"}
    assert states_of(report) == ["detected", "off", "detected"]
    assert "left out, because Contact02, from 11 to 16, is switched off" in report.notes[0]


def test_what_somebody_moved_stays_where_it_is(again):
    moved = "uniform point3d usdmotion:location = (7, 8, 9)"
    report, stage = again(within(moved, "Contact02"))
    location = stage.GetPrimAtPath(f"{CONTACT}/Contact02").GetAttribute("usdmotion:location")
    assert tuple(location.Get()) == (7, 8, 9)
    assert states_of(report) == ["detected", "own", "detected"]
    assert set(spans_of(stage)) == {"Contact01", "Contact02", "Contact03"}


def test_what_somebody_lengthened_stays_so_long(again):
    longer = "uniform timecode[] usdmotion:times = [9, 10, 19, 20]"
    report, stage = again(within(longer, "Contact02"))
    assert spans_of(stage)["Contact02"] == (10, 19)
    assert report.objects[0].contacts[1].state == "own"


def test_a_neighbour_makes_room_for_what_somebody_lengthened(again):
    longer = "uniform timecode[] usdmotion:times = [9, 10, 20, 20]"
    _, stage = again(within(longer, "Contact02"))
    times = stage.GetPrimAtPath(f"{CONTACT}/Contact03").GetAttribute("usdmotion:times").Get()
    assert [float(code) for code in times] == [21.5, 23, 24, 28.8]


def test_what_somebody_made_stays_and_keeps_out_what_it_covers(again):
    made = """def MotionContactConstraint "Mine" {
        uniform token usdmotion:joint = "hips/foot"
        uniform timecode[] usdmotion:times = [11, 15]
        uniform point3d usdmotion:location = (1, 2, 10)
    }"""
    report, stage = again(within(made))
    # The contact that was detected there is not found again beside it.
    assert set(spans_of(stage)) - {"Mine"} == {"Contact01", "Contact03"}
    states = {each.path.rsplit("/", 1)[-1]: each.state for each in report.objects[0].contacts}
    assert states == {
        "Contact01": "detected",
        "Contact02": "dropped",
        "Mine": "own",
        "Contact03": "detected",
    }


def test_a_priority_is_a_persons_and_the_contact_is_detected_anew(again, steps):
    ranked = "uniform int usdmotion:priority = 5"
    places = steps.places(((1, 6), (12, 16), (21, 24)))
    report, stage = again(within(ranked, "Contact02"), places=places)
    assert spans_of(stage)["Contact02"] == (12, 16)
    prim = stage.GetPrimAtPath(f"{CONTACT}/Contact02")
    assert prim.GetAttribute("usdmotion:priority").Get() == 5
    assert report.objects[0].contacts[1].state == "detected"


def test_what_is_not_found_again_is_switched_off(again, steps):
    report, stage = again("", places=steps.places(((1, 6), (21, 24))))
    assert set(spans_of(stage)) == {"Contact01", "Contact03"}
    assert states_of(report) == ["detected", "dropped", "detected"]


def test_what_is_found_again_after_all_is_switched_on(shot, detect, opened, steps):
    detect(shot(), "first.usda")
    first = shot(places=steps.places(((1, 6), (21, 24)))).with_name("first.usda")
    detect(first, "second.usda")
    second = shot().with_name("second.usda")
    assert states_of(detect(second, "third.usda")) == ["detected"] * 3
    assert set(spans_of(opened("third.usda"))) == {"Contact01", "Contact02", "Contact03"}


def test_what_was_not_found_again_and_somebody_switches_on_is_his(
    again, detect, over, opened, steps
):
    again("", places=steps.places(((1, 6), (21, 24))))
    on = over("second.usda", within("(active = true) {}", "Contact02"), "on.usda")
    report = detect(on, "third.usda")
    assert report.objects[0].contacts[1].state == "own"
    assert "Contact02" in spans_of(opened("third.usda"))


def test_what_is_new_has_a_new_name(again, steps):
    places = steps.places(((1, 6), (8, 9), (11, 16), (21, 24)))
    _, stage = again("", places=places)
    assert spans_of(stage)["Contact04"] == (8, 9)


def test_a_detection_that_is_switched_off_is_not_looked_at(again):
    off = within("").replace('over "foot"', 'over "foot" (active = false)')
    with pytest.raises(SceneError, match="Contacts/foot> is switched off; activate it"):
        again(off, joints=["foot"])


def test_under_an_offset_of_its_layer_a_contact_is_still_what_was_written(again, opened):
    report, stage = again("", offset="(offset = 100; scale = 2)")
    assert states_of(report) == ["detected"] * 3
    assert spans_of(stage)["Contact02"] == (122, 132)


class TestTemplates:
    """A contact that is marked as an example, and an example that somebody writes."""

    def test_a_marked_contact_is_the_example_and_stays_one(self, again, still):
        mark = "uniform bool usdmotion:template = true"
        report, stage = again(within(mark, "Contact02"))
        (template,) = still.seen[-1].templates
        assert (template.kind, round(template.start * 24), round(template.end * 24)) == (
            "space",
            10,
            15,
        )
        assert report.objects[0].contacts[1].state == "template"
        assert spans_of(stage)["Contact02"] == (11, 16)

    def test_the_interval_that_somebody_gave_is_the_example_whatever_is_found(
        self, again, still, detect
    ):
        rough = """def MotionContactConstraint "Rough" {
            uniform timecode[] usdmotion:times = [12, 14]
            uniform bool usdmotion:template = true
        }"""
        _, stage = again(within(rough))
        assert spans_of(stage)["Rough"] == (11, 16)
        prim = stage.GetPrimAtPath(f"{CONTACT}/Rough")
        assert prim.GetAttribute("usdmotion:joint").Get() == "hips/foot"
        assert prim.GetAttribute("usdmotion:location").HasAuthoredValue()
        detect(Path(stage.GetRootLayer().realPath), "third.usda")
        (template,) = still.seen[-1].templates
        assert (round(template.start * 24), round(template.end * 24)) == (11, 13)

    def test_a_template_that_is_moved_is_another_example(self, again, still, detect, over):
        mark = "uniform bool usdmotion:template = true"
        again(within(mark, "Contact02"))
        moved = within("uniform timecode[] usdmotion:times = [12, 13, 15, 16]", "Contact02")
        detect(over("second.usda", moved, "moved.usda"), "third.usda")
        (template,) = still.seen[-1].templates
        assert (round(template.start * 24), round(template.end * 24)) == (12, 14)

    def test_an_example_where_nothing_is_found_holds_the_object_where_it_is_then(self, again):
        rough = """def MotionContactConstraint "Rough" {
            uniform token usdmotion:joint = "hips/foot"
            uniform timecode[] usdmotion:times = [7, 9]
            uniform bool usdmotion:template = true
            uniform token usdmotion:kind = "line"
        }"""
        report, stage = again(within(rough))
        assert "nothing was found where a line contact from 7 to 9 is a template" in report.notes[0]
        prim = stage.GetPrimAtPath(f"{CONTACT}/Rough")
        assert prim.GetAttribute("usdmotion:location").Get()[1] == pytest.approx(5.0)
        assert prim.GetAttribute("usdmotion:template").Get()


def test_no_layer_that_is_read_is_written_to(again, detect, tmp_path):
    again("")
    for name in ("shot.usda", "first.usda", "person.usda"):
        with pytest.raises(FileError, match="no input is written to"):
            detect(tmp_path / "person.usda", name)


def test_only_what_changed_is_said_in_a_stronger_layer(again):
    _, stage = again(within("(active = false) {}", "Contact02"))
    layer = stage.GetRootLayer()
    assert layer.GetPrimAtPath(f"{CONTACT}/Contact01").specifier == Sdf.SpecifierOver
    assert layer.GetPrimAtPath(f"{CONTACT}/Contact02") is None

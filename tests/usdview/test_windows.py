"""What people see and are asked, with Qt and without."""

import pytest
from pxr import Usd

from usdmotion import SceneError
from usdmotion.usdview.windows import Cancelled, Window

NAMES = ("Hips", "    Spine", "    LeftUpLeg")


@pytest.fixture
def api(seat):
    return seat("dice").api


def test_a_name_is_chosen_from_a_list(api, qt):
    window = Window(api)
    assert window.choose("Which?", NAMES, 2, "") == 2
    qt.answer = "    Spine"
    assert window.choose("Which?", NAMES, 2, "") == 1
    assert qt.asked == ["Which?", "Which?"]


def test_none_of_the_names(api, qt):
    qt.cancels = True
    with pytest.raises(Cancelled):
        Window(api).choose("Which?", NAMES, 0, "")


def test_nobody_can_be_asked_without_qt(api):
    with pytest.raises(SceneError, match="select a prim"):
        Window(api).choose("Which?", NAMES, 0, "select a prim")
    with pytest.raises(SceneError, match="no Qt to ask"):
        Window(api).choose_file("Where?", "/", (".usda",))


def test_a_question_is_answered(api, qt):
    assert Window(api).confirm("Really?")
    qt.cancels = True
    assert not Window(api).confirm("Really?")
    assert qt.asked == ["Really?", "Really?"]


def test_a_question_that_nobody_hears_is_answered_by_no(api):
    assert not Window(api).confirm("Really?")


def test_a_file_is_chosen(api, qt):
    qt.answer = "/there/results.usda"
    assert Window(api).choose_file("Where?", "/there", (".usda", ".usdc")) == "/there/results.usda"
    qt.answer = ""
    with pytest.raises(Cancelled):
        Window(api).choose_file("Where?", "/there", (".usda",))


def test_a_text_is_shown_beside_the_stage_or_printed(api, qt, capsys):
    Window(api).show("what is there", "a table")
    assert qt.shown == ["a table"] and not capsys.readouterr().out


def test_a_text_is_printed_without_qt(api, capsys):
    Window(api).show("what is there", "a table")
    assert capsys.readouterr().out == "a table\n"


def test_long_work_shows_and_events_are_looked_after(api, qt):
    with Window(api).busy() as say:
        assert qt.cursors == ["wait"]
        say("solving /Edit")
        assert (api.told, qt.events) == (["solving /Edit …"], 1)
    assert qt.cursors == []


def test_the_cursor_comes_back_whatever_happens(api, qt):
    with pytest.raises(SceneError), Window(api).busy():
        raise SceneError("something")
    assert qt.cursors == []


def test_long_work_is_told_of_without_qt(api):
    with Window(api).busy() as say:
        say("solving /Edit")
    assert api.told == ["solving /Edit …"]


def test_the_frame_is_exact_and_the_slider_goes_along(api, qt):
    Window(api).go_to(7.25)
    assert api.frame == Usd.TimeCode(7.25)
    assert qt.field == ["7.25", "editingFinished"]


def test_the_frame_is_set_without_qt(api):
    Window(api).go_to(7.25)
    assert api.frame == Usd.TimeCode(7.25)


def test_qt_without_an_application_is_none(api, qt, monkeypatch):
    monkeypatch.setattr(qt, "runs", False)
    Window(api).refuse("something")
    with Window(api).busy() as say:
        say("working")
    assert (qt.asked, qt.cursors, qt.events) == ([], [], 0)

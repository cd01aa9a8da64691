"""Whatever happens in a command, usdview goes on, and people get one sentence."""

import pytest

from usdmotion.errors import SceneError
from usdmotion.usdview import commands
from usdmotion.usdview.running import Desk, run
from usdmotion.usdview.windows import Cancelled


@pytest.fixture
def told(seat, monkeypatch):
    """Return what lets a command raise something, and returns what the status bar says then."""
    here = seat("dice")

    def fail(error):
        def command(_):
            raise error

        monkeypatch.setattr(commands, "inspect", command)
        updates = here.api.updates
        said = here.pick("inspect")
        assert here.api.updates == updates + 1
        return said

    return fail


def test_a_fault_is_the_sentence_that_the_command_line_prints(told, qt, capsys):
    assert told(SceneError("</A> is at fault; move it")) == "</A> is at fault; move it"
    assert qt.asked == ["</A> is at fault; move it"]
    assert capsys.readouterr() == ("", "")


def test_a_fault_without_qt_is_in_the_status_bar(told):
    assert told(SceneError("</A> is at fault; move it")) == "</A> is at fault; move it"


def test_a_bug_is_said_to_be_one_and_the_terminal_has_the_rest(told, qt, capsys):
    said = told(ValueError("broadcast\nof shapes"))
    assert said.startswith("this is a bug in usdmotion (ValueError: broadcast of shapes)")
    assert qt.asked == [said] and "Traceback" not in said
    assert "Traceback" in capsys.readouterr().err


def test_a_package_that_usdview_lacks_is_named(told):
    said = told(ModuleNotFoundError("No module named 'numba'", name="numba"))
    assert said.startswith("the Python of usdview has no package 'numba'")


def test_who_cancels_changes_nothing(told, qt):
    assert told(Cancelled()) == "nothing was done"
    assert qt.asked == []


def test_no_stage_is_open(usdview):
    from pxr.Usdviewq.usdviewApi import UsdviewApi

    api = UsdviewApi(None)
    run("inspect", Desk(), api)
    assert api.told == ["no stage is open; open one first"]


def test_a_second_command_waits_for_the_first(seat, monkeypatch):
    here, begun = seat("dice"), []

    def first(_):
        begun.append("first")
        here.registry.getCommandPlugin("usdmotion.solve").run()
        return "done"

    monkeypatch.setattr(commands, "inspect", first)
    monkeypatch.setattr(commands, "solve", lambda _: begun.append("second"))
    assert here.pick("inspect") == "done"
    assert begun == ["first"]
    monkeypatch.setattr(commands, "inspect", lambda _: "again")
    assert here.pick("inspect") == "again"

"""Every command does what it says, on stages of ours; what it makes is where results go."""

import tempfile
import webbrowser
from pathlib import Path

import pytest
from pxr import Sdf, Usd, UsdGeom

from usdmotion import onstage
from usdmotion.usd.relations import bound_animation
from usdmotion.usdview.menu import DESTINATIONS, GROUPS
from usdmotion.usdview.telling import told_apart

SKELETON = "/Walker/Skeleton"
EDIT = f"{SKELETON}/Reaching"
CONTACTS = f"{SKELETON}/Contacts"
HAND = "Hips/Spine/Spine1/Spine2/LeftShoulder/LeftArm/LeftForeArm/LeftHand"


@pytest.fixture
def walker(seat):
    """Return a seat before a walk in which nothing is asked, and a ball by its left hand."""
    here = seat("skating")
    ball = UsdGeom.Sphere.Define(here.stage, "/Ball")
    ball.AddTranslateOp().Set((35.0, 90.0, 105.0))
    return here


@pytest.fixture
def untouched():
    """Let a test fail that changes a stage of ours."""
    yield
    changed = [layer.identifier for layer in Sdf.Layer.GetLoadedLayers() if layer.dirty]
    assert not [name for name in changed if Path(name).is_file()]


def bound(here):
    return str(bound_animation(here.stage.GetPrimAtPath(SKELETON)).GetPath())


def value(here, path, name):
    return here.stage.GetPrimAtPath(path).GetAttribute(f"usdmotion:{name}").Get()


def test_an_edit_is_solved_its_result_shown_muted_and_judged(seat, qt, untouched):
    here = seat("reaching")

    # Nothing but a goal is selected, and its edit is meant.
    said = here.pick("solve", f"{EDIT}/LeftWrist/Reach")
    assert said == "solved Reaching: 6 constraints met; in the session layer"
    assert f"solving {EDIT} …" in here.api.told and qt.events > 0
    assert bound(here) == f"{EDIT}_result"

    assert here.pick("show", SKELETON).startswith("the source of Reaching is shown")
    assert bound(here) == "/Walker/Animation"
    assert here.pick("show").startswith("the result of Reaching is shown")
    assert bound(here) == f"{EDIT}_result"

    said = here.pick("jump", f"{EDIT}/Balance")
    assert said.startswith("Balance: ") and said.endswith(f" at {here.api.frame}, met")
    assert float(qt.field[0]) == here.api.frame.GetValue()

    assert not here.api.dataModel.viewSettings.displayGuide
    for _ in range(2):
        assert here.pick("guides") == "drew Reaching; in the session layer"
        assert here.stage.GetPrimAtPath(f"{EDIT}/LeftWrist/Guides/After")
    assert here.api.dataModel.viewSettings.displayGuide

    assert here.pick("inspect").startswith("1 skeleton, 1 edit, 6 constraints; no faults")
    assert "Reaching_result" in qt.shown[0]
    # The ghost that is drawn is no character.
    assert "contacts on" in here.pick("detect")
    assert qt.asked == [] and qt.cursors == []


def test_faults_come_first_where_a_stage_is_inspected(seat, capsys):
    here = seat("reaching")
    here.stage.GetPrimAtPath(f"{EDIT}/LeftHeel").GetAttribute("usdmotion:joint").Set("LeftFot")
    assert here.pick("inspect").endswith("; 1 fault found")
    shown = capsys.readouterr().out
    assert shown.index("LeftFot") < shown.index("skeletons")


def test_a_miss_is_told_and_gone_to(seat, untouched):
    here = seat("reaching")
    here.stage.GetPrimAtPath(f"{EDIT}/LeftWrist/Reach").GetAttribute("xformOp:translate").Set(
        (300.0, 90.0, 425.0)
    )
    said = here.pick("solve")
    assert said.startswith("solved Reaching: ") and " of 6 constraints missed, LeftWrist by" in said
    worst = onstage.worst(here.stage, f"{EDIT}/LeftWrist")
    assert here.pick("jump", f"{EDIT}/LeftWrist").endswith(f"at {worst.time_code:g}, missed")
    assert here.api.frame == Usd.TimeCode(worst.time_code)


def test_contacts_are_detected_made_templates_and_detected_again(walker, untouched):
    said = walker.pick("detect", "/Walker/Guide")  # its mesh
    assert said == (
        "13 contacts on LeftFoot, LeftToeBase, RightFoot and 1 more; in the session layer"
    )
    assert walker.api.dataModel.viewSettings.displayGuide
    contacts = [f"{CONTACTS}/LeftFoot/Contact01", f"{CONTACTS}/RightFoot/Contact01"]
    assert walker.pick("detect", SKELETON, "/Ball") == said  # which does not move
    said = walker.pick("make_template", *contacts)
    assert said == (
        "the next detection learns from LeftFoot/Contact01, RightFoot/Contact01; in the session "
        "layer"
    )
    assert all(value(walker, path, "template") for path in contacts)
    assert "contacts on" in walker.pick("detect")
    assert all(value(walker, path, "template") for path in contacts)


def test_one_of_several_characters_is_looked_at(seat, untouched):
    here = seat("dance_company")
    assert here.pick("detect").startswith("select a Skeleton; there are </Company/Dancer/Skeleton>")
    assert "contacts on" in here.pick("detect", "/Company/Child")
    found = [prim for prim in here.stage.Traverse() if prim.GetTypeName() == "MotionDetection"]
    assert found and all(prim.GetPath().HasPrefix("/Company/Child/Skeleton") for prim in found)


def test_props_are_looked_at_where_they_are_selected_and_then_by_themselves(seat, untouched):
    here = seat("dice")
    assert here.pick("detect").startswith("dice.usda: there is no Skeleton and no MotionDetection")
    both = "contacts on First, Second; in the session layer"
    assert here.pick("detect", "/Dice/First", "/Dice/Second").endswith(both)
    assert here.pick("detect").endswith(both)


def test_a_constraint_is_made_at_the_joint_that_is_nearest_to_a_prop(walker, untouched):
    walker.api.dataModel.currentFrame = Usd.TimeCode(15)
    said = walker.pick("add_position_constraint", "/Ball", SKELETON)
    (path,) = map(str, walker.api.selectedPaths)
    assert said.startswith(f"{path.rsplit('/', 1)[-1]} holds LeftHand around 15: it follows Ball")
    assert walker.stage.GetPrimAtPath(path).GetTypeName() == "MotionPositionConstraint"
    assert value(walker, path, "joint") == HAND
    (goal,) = walker.stage.GetPrimAtPath(path).GetChildren()
    assert list(goal.GetRelationship("usdmotion:space").GetTargets()) == ["/Ball"]
    assert walker.pick("solve", path).startswith(f"solved {Sdf.Path(path).GetParentPath().name}")


def test_a_constraint_is_made_at_a_joint_that_is_chosen(walker, qt, untouched):
    qt.answer = "                            LeftHand"
    said = walker.pick("add_position_constraint", SKELETON)
    (path,) = map(str, walker.api.selectedPaths)
    assert "holds LeftHand around 1: move its goal" in said
    assert value(walker, path, "joint") == HAND
    # The joint of a constraint that is selected is offered first.
    qt.answer = ""
    walker.pick("add_position_constraint", path)
    (another,) = map(str, walker.api.selectedPaths)
    assert another != path and value(walker, another, "joint") == HAND


def test_nobody_chooses_a_joint(walker, qt, untouched):
    before = walker.stage.GetSessionLayer().ExportToString()
    qt.cancels = True
    assert walker.pick("add_position_constraint") == "nothing was done"
    assert walker.stage.GetSessionLayer().ExportToString() == before


def test_the_report_is_opened(seat, monkeypatch, tmp_path):
    here, opened = seat("reaching"), []
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(onstage, "report", lambda stage, output, *, say: say("drawing"))
    monkeypatch.setattr(webbrowser, "open", lambda uri: opened.append(uri) or len(opened) < 2)
    said = here.pick("report")
    assert opened[0].startswith("file:///") and opened[0].endswith("/reaching.html")
    assert Path(said.removeprefix("the report is ")).as_uri() == opened[0]
    assert here.pick("report").endswith("there is no browser to open it")
    assert "drawing …" in here.api.told


def test_results_go_where_somebody_wants(seat, qt, tmp_path, untouched):
    here, file = seat("skating"), tmp_path / "results.usda"
    marks = [action for _, action in here.menu.submenus["Results Go To"].items]
    assert [each.checked for each in marks] == [True, False, False]

    qt.answer = str(file)
    assert here.pick("to_layer") == f"results go to {file}, which is over the stage"
    assert [each.checked for each in marks] == [False, False, True]
    assert here.pick("detect").endswith(f"in {file}")
    assert Sdf.Layer.OpenAsAnonymous(str(file)).GetPrimAtPath(CONTACTS)
    assert here.stage.GetPrimAtPath(CONTACTS)
    assert not here.stage.GetSessionLayer().GetPrimAtPath(CONTACTS)

    own = Sdf.Layer.CreateAnonymous("own.usda")
    here.stage.GetSessionLayer().subLayerPaths.insert(0, own.identifier)
    here.stage.SetEditTarget(own)
    assert here.pick("to_target").endswith("own.usda now")
    assert here.pick("make_template", f"{CONTACTS}/LeftFoot/Contact01").endswith("own.usda")
    assert own.GetAttributeAtPath(f"{CONTACTS}/LeftFoot/Contact01.usdmotion:template")

    assert here.pick("to_session") == "results go to the session layer"
    assert [each.checked for each in marks] == [True, False, False]


def test_a_layer_of_the_stage_is_called_one(seat, qt, tmp_path):
    own, shot = Sdf.Layer.CreateNew(str(tmp_path / "own.usda")), Sdf.Layer.CreateAnonymous()
    own.Save()
    shot.subLayerPaths.append(own.identifier)
    qt.answer = own.realPath
    said = seat(shot).pick("to_layer")
    assert said == f"results go to {own.realPath}, which is a layer of the stage itself"


def test_results_of_the_session_go_along_to_a_file(seat, qt, tmp_path, untouched):
    here, file = seat("reaching"), tmp_path / "results.usda"
    reach = here.stage.GetPrimAtPath(f"{EDIT}/LeftWrist/Reach").GetAttribute("xformOp:translate")
    here.pick("solve")

    qt.answer, qt.cancels = str(file), True
    assert here.pick("to_layer") == f"results go to {file}, which is over the stage"
    reach.Set((60.0, 95.0, 420.0))
    hidden = here.pick("solve")
    assert "is authored in the session layer, which is stronger" in hidden

    qt.cancels = False
    said = here.pick("to_layer")
    assert said == f"results go to {file}, which is over the stage, with what the session layer had"
    assert here.stage.GetSessionLayer().subLayerPaths and not here.stage.GetSessionLayer().rootPrims
    assert bound(here) == f"{EDIT}_result" and tuple(reach.Get()) == (60.0, 95.0, 420.0)
    assert Sdf.Layer.OpenAsAnonymous(str(file)).GetPrimAtPath(f"{EDIT}_result")
    assert here.pick("solve").endswith(f"in {file}")


FAULTS = {
    "report": ((), "reaching.usda: there is no result of a MotionEdit; solve it first"),
    "show": ((), "reaching.usda: <"),
    "jump": ((EDIT,), f"select a constraint; <{EDIT}> is none"),
    "make_template": ((f"{EDIT}/LeftHeel",), "select a MotionContactConstraint; <"),
    "add_position_constraint": ((), "select a prim beside the Skeleton"),
    "guides": ((), "skating.usda: there is nothing to draw"),
    "to_layer": ((), "there is no Qt to ask for a file with"),
}


@pytest.mark.parametrize("verb", FAULTS)
def test_a_fault_is_one_sentence_and_changes_nothing(seat, capsys, verb, untouched):
    here = seat("skating" if verb == "guides" else "reaching")
    paths, sentence = FAULTS[verb]
    assert here.pick(verb, *paths).startswith(sentence)
    assert here.stage.GetSessionLayer().empty
    assert capsys.readouterr() == ("", "")


def test_what_has_the_same_name_is_told_apart():
    paths = ("/World/Ann/Bones/Edit", "/World/Bob/Bones/Edit", "/World/Bob/Bones/Other")
    assert told_apart(paths) == ["Ann/Bones/Edit", "Bob/Bones/Edit", "Other"]
    assert told_apart(("/Ann/Edit", "/Edit")) == ["Ann/Edit", "Edit"]
    assert told_apart(()) == []


def test_every_item_of_the_menu_is_a_command():
    from usdmotion.usdview import commands

    for item in (each for group in (*GROUPS, DESTINATIONS) for each in group):
        assert callable(getattr(commands, item.verb))

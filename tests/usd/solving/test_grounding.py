"""Edits that stand on a ground: solved, judged, reported, changed."""

import json
import sys

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import OrientationConstraint, Session, cli, pipeline
from usdmotion.demos import terrain
from usdmotion.demos.walker import SKELETON
from usdmotion.errors import FileError, SceneError
from usdmotion.reporting import report

EDIT = f"{SKELETON}/Terrain"
FRAMES = (20.0, 68.0)
"""Up the slope, two stances of each foot."""


@pytest.fixture(scope="module")
def shot(tmp_path_factory):
    path = tmp_path_factory.mktemp("shot") / "terrain.usda"
    terrain.build(path)
    return path


@pytest.fixture
def changed(shot, tmp_path):
    """Return what writes the shot with something changed on it."""

    def run(change):
        stage = Usd.Stage.Open(str(shot))
        output = tmp_path / "changed.usda"
        layer = Sdf.Layer.CreateNew(str(output))
        layer.TransferContent(stage.GetRootLayer())
        copy = Usd.Stage.Open(layer)
        change(copy)
        layer.Save()
        return output

    return run


def without_contacts(stage):
    for child in stage.GetPrimAtPath(EDIT).GetChildren():
        child.SetActive(False)


def leveled(stage):
    stage.GetPrimAtPath(EDIT).GetRelationship("usdmotion:ground").ClearTargets(True)


def rotations(layer):
    found, path = Sdf.Layer.FindOrOpen(str(layer)), f"{EDIT}_result.rotations"
    return np.array([found.QueryTimeSample(path, code) for code in range(20, 69)])


def test_the_contacts_of_feet_go_along_onto_the_ground_and_are_judged_there(shot, tmp_path):
    told = pipeline.solve(shot, tmp_path / "edit.usda", frames=FRAMES)
    (edit,) = told.edits
    assert told.met and edit.ground.footprints == 10 and not edit.ground.detected
    assert edit.ground.without_ground == 0 and 0.1 < edit.ground.highest <= terrain.TOP + 1e-3
    assert sum(f"<{EDIT}> starts from an input on the ground: " in each for each in told.notes) == 1
    assert json.loads(told.to_json())["edits"][0]["ground"]["made_on"] == 0.0


def test_contacts_of_hands_and_what_slides_stay_and_are_named(changed, tmp_path):
    def hold(stage):
        toe = next(
            prim
            for prim in stage.GetPrimAtPath(EDIT).GetChildren()
            if "Toe" in prim.GetAttribute("usdmotion:joint").Get()
        )
        hand = next(
            str(joint)
            for joint in stage.GetPrimAtPath(SKELETON).GetAttribute("joints").Get()
            if str(joint).endswith("/LeftHand")
        )
        for name, joint, kind in (
            ("Hand", hand, "point"),
            ("Slide", toe.GetAttribute("usdmotion:joint").Get(), "slide"),
        ):
            held = stage.DefinePrim(f"{EDIT}/{name}", "MotionContactConstraint")
            held.GetAttribute("usdmotion:joint").Set(joint)
            held.GetAttribute("usdmotion:kind").Set(kind)
            held.GetAttribute("usdmotion:priority").Set(9)

    told = pipeline.solve(changed(hold), tmp_path / "edit.usda", frames=FRAMES)
    (edit,) = told.edits
    assert set(edit.ground.staying) == {f"{EDIT}/Hand", f"{EDIT}/Slide"}
    assert edit.ground.footprints == 10
    assert (
        sum(f"<{EDIT}/Hand>, <{EDIT}/Slide> hold on to where" in each for each in told.notes) == 1
    )


def test_feet_are_looked_for_where_no_contact_says_when_they_stand(changed, shot, tmp_path):
    found = pipeline.solve(changed(without_contacts), tmp_path / "found.usda", frames=FRAMES)
    (edit,) = found.edits
    assert edit.ground.detected and edit.ground.footprints >= 4 and not edit.constraints
    pipeline.solve(shot, tmp_path / "said.usda", frames=FRAMES)
    layers = (tmp_path / "found.usda", tmp_path / "said.usda")
    # The detector begins and ends stances a frame or two beside those of the walk.
    assert np.abs(np.subtract(*map(rotations, layers))).max() < 0.15


def test_prims_that_are_asked_for_go_before_those_of_the_edit(changed, shot, tmp_path):
    layers = [tmp_path / f"{name}.usda" for name in ("edits", "asked", "level")]
    pipeline.solve(shot, layers[0], frames=FRAMES)
    pipeline.solve(changed(leveled), layers[1], frames=FRAMES, ground=[terrain.GROUND])
    assert np.array_equal(rotations(layers[0]), rotations(layers[1]))
    said = Sdf.Layer.FindOrOpen(str(layers[1])).customLayerData["usdmotion"]
    assert list(said["ground"]) == [terrain.GROUND]
    level = pipeline.solve(shot, layers[2], frames=FRAMES, ground=[])
    assert level.edits[0].ground is None
    assert not np.array_equal(rotations(layers[0]), rotations(layers[2]))


def hill(places, times):
    """Return a slope across the way."""
    return 0.1 * places[..., 0] + 0.02


def test_a_function_is_a_ground_too(changed, tmp_path):
    edit = tmp_path / "edit.usda"
    flat = changed(leveled)
    told = pipeline.solve(flat, edit, frames=FRAMES, ground=hill)
    assert told.met and told.edits[0].ground.highest == pytest.approx(0.02 + 0.006, abs=2e-3)
    with pytest.raises(FileError, match="a ground that a program told"):
        report(edit, tmp_path / "report.html", shot=flat)
    (found,) = report(edit, tmp_path / "report.html", shot=flat, ground=hill)
    assert not found.edits[0].record.stale
    assert all(trace.verdict.met for trace in found.edits[0].traces)


@pytest.mark.parametrize("frames", [(39.0, 39.0), (39.0, 40.0)])
def test_a_single_frame_stands_on_its_ground_too(shot, tmp_path, frames):
    told = pipeline.solve(shot, tmp_path / "edit.usda", frames=frames)
    assert told.met and told.edits[0].ground.footprints == 1


def test_where_there_is_no_ground_the_input_stays_and_a_note_says_so(changed, tmp_path):
    def ends(places, times):
        return np.where(places[..., 1] < 1.5, 0.0, np.nan)

    told = pipeline.solve(changed(leveled), tmp_path / "edit.usda", frames=FRAMES, ground=ends)
    assert told.met and 0 < told.edits[0].ground.without_ground < told.edits[0].ground.footprints
    assert any("there is no ground under" in note for note in told.notes)


def test_a_report_is_measured_beside_the_input_on_its_ground(shot, tmp_path):
    edit = tmp_path / "edit.usda"
    pipeline.solve(shot, edit, frames=FRAMES)
    (found,) = report(edit, tmp_path / "report.html", shot=shot)
    (told,) = found.edits
    assert not told.record.stale
    assert all(trace.verdict.met for trace in told.traces)


def test_a_moving_ground_takes_the_feet_along(changed, shot, tmp_path):
    def lift(stage):
        leveled(stage)
        floor = stage.GetPrimAtPath(f"{terrain.GROUND}/Floor")
        place = floor.GetAttribute("xformOp:translate")
        place = place or floor.CreateAttribute("xformOp:translate", Sdf.ValueTypeNames.Double3)
        for code in (20.0, 68.0):
            place.Set((0.0, (code - 20.0) / 4.0, 0.0), code)
        order = floor.GetAttribute("xformOpOrder").Get() or []
        floor.CreateAttribute(
            "xformOpOrder", Sdf.ValueTypeNames.TokenArray, False, Sdf.VariabilityUniform
        ).Set(["xformOp:translate", *(each for each in order if each != "xformOp:translate")])

    rising = changed(lift)
    edit, composed = tmp_path / "edit.usda", tmp_path / "composed.usda"
    floor = [f"{terrain.GROUND}/Floor"]
    told = pipeline.solve(rising, edit, frames=FRAMES, ground=floor, compose=composed)
    assert told.met and told.edits[0].ground.highest == pytest.approx(0.12, abs=5e-3)
    # The whole body rises with it.
    before, after = (Usd.Stage.Open(str(each)) for each in (shot, composed))
    hips = [
        stage.GetPrimAtPath(path).GetAttribute("translations").Get(68.0)[0][1]
        for stage, path in ((before, "/Walker/Animation"), (after, f"{EDIT}_result"))
    ]
    assert hips[1] - hips[0] == pytest.approx(12.0, abs=1.0)


def test_a_session_keeps_the_footprints_and_changes_the_rest(shot, tmp_path):
    session = Session.open(shot, frames=FRAMES)
    foot = next(each.path for each in session.constraints if "Toe" in each.path)
    with pytest.raises(SceneError, match="is a footprint by which"):
        session.change(foot, location=np.zeros(3))
    with pytest.raises(SceneError, match="is a footprint by which"):
        session.remove(foot)
    written, solved = tmp_path / "written.usda", tmp_path / "solved.usda"
    session.write(written)
    pipeline.solve(shot, solved, frames=FRAMES)
    assert written.read_bytes() == solved.read_bytes()
    head = "Hips/Spine/Spine1/Spine2/Neck/Head"
    nod = OrientationConstraint(path=f"{EDIT}/Nod", skeleton=SKELETON, joint=head, priority=5)
    session.set(nod)
    session.change(nod.path, times=(0.5, 0.7, 1.0, 1.2))
    assert session.report().met and len(session.report().edits[0].constraints) == 26


def test_who_has_no_legs_that_are_known_cannot_stand(text, save, tmp_path):
    floor = 'def Plane "Floor"\n{\nuniform token axis = "Y"\n}\n'
    man = text.man(edit=text.edit(attributes="rel usdmotion:ground = </Floor>"))
    with pytest.raises(SceneError, match="nobody knows which joints of </Man/Bones> are its legs"):
        pipeline.solve(save(man + floor), tmp_path / "edit.usda")


def test_the_command_line_puts_a_motion_on_prims(changed, tmp_path, monkeypatch, capsys):
    flat = changed(leveled)
    words = [
        "usdmotion",
        "solve",
        str(flat),
        "-o",
        str(tmp_path / "edit.usda"),
        "--frames",
        "20:68",
    ]
    monkeypatch.setattr(sys, "argv", [*words, "--ground", f"{terrain.GROUND}/Floor"])
    with pytest.raises(SystemExit, match="0"):
        cli.main()
    assert "starts from an input on the ground" in capsys.readouterr().err
    monkeypatch.setattr(sys, "argv", [*words, "--ground", "/Nowhere"])
    with pytest.raises(SystemExit, match="2"):
        cli.main()
    assert "there is no prim </Nowhere> to stand on" in capsys.readouterr().err

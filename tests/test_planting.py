"""The closed loop in one command: feet that slide are found and planted, the rest is kept."""

import json
import sys

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSkel

from usdmotion import cli, demos, pipeline
from usdmotion.errors import FileError, SceneError

SKELETON = "/Walker/Skeleton"
EDIT = f"{SKELETON}/Contacts"
BALL = f"{EDIT}/LeftToeBase"
FEET = ("LeftFoot", "LeftToeBase", "RightFoot", "RightToeBase")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a walk whose feet skate."""
    folder = tmp_path_factory.mktemp("planting")
    demos.build("skating", folder)
    return folder


@pytest.fixture(scope="module")
def cleaned(folder):
    """Return what is told of that walk, cleaned once."""
    return pipeline.clean(folder / "skating.usda", folder / "clean.usda")


@pytest.fixture
def over(tmp_path):
    """Return what writes a layer over another that says something more."""

    def write(beneath, body, name="person.usda"):
        layer = Sdf.Layer.FindOrOpen(str(beneath))
        path = tmp_path / name
        path.write_text(
            f'#usda 1.0\n(\nsubLayers = [@{beneath}@]\nmetersPerUnit = 0.01\nupAxis = "Y"\n'
            f"timeCodesPerSecond = {layer.timeCodesPerSecond}\nstartTimeCode = 1\n"
            f"endTimeCode = 73\n)\n{body}"
        )
        return path

    return write


def walked(path, names=FEET):
    """Return where joints are on a stage at its samples, as UsdSkel has it [m]."""
    stage = Usd.Stage.Open(str(path))
    skeleton = stage.GetPrimAtPath(SKELETON)
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(skeleton), Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(skeleton))
    joints = [str(each).rsplit("/", 1)[-1] for each in query.GetJointOrder()]
    found = []
    for code in np.arange(1.0, 74.0):
        place = UsdGeom.Xformable(skeleton).ComputeLocalToWorldTransform(code)
        matrices = [each * place for each in query.ComputeJointSkelTransforms(code)]
        found.append([matrices[joints.index(name)].ExtractTranslation() for name in names])
    return 0.01 * np.array(found)


def spans(path, detection):
    """Return first and last time code of each contact of a detection that is on."""
    stage = Usd.Stage.Open(str(path))
    prims = stage.GetPrimAtPath(detection).GetChildren()
    contacts = [prim for prim in prims if prim.GetTypeName() == "MotionContactConstraint"]
    return [
        tuple(float(code) for code in prim.GetAttribute("usdmotion:times").Get()[1:3])
        for prim in contacts
    ]


def slides(path, found_in):
    """Return how far each joint of the feet is from its mean place in each contact [m]."""
    places, slid = walked(path), []
    for index, name in enumerate(FEET):
        for first, last in spans(found_in, f"{EDIT}/{name}"):
            here = places[int(np.ceil(first)) - 1 : int(last), index]
            slid.append(np.linalg.norm(here - here.mean(axis=0), axis=1).max())
    return np.array(slid)


def result(path, name="rotations"):
    layer = Sdf.Layer.FindOrOpen(str(path))
    spec = Sdf.Path(f"{EDIT}_result.{name}")
    codes = layer.ListTimeSamplesForPath(spec)
    return np.array([np.asarray(layer.QueryTimeSample(spec, code)) for code in codes])


def test_feet_that_slid_stand(folder, cleaned):
    before = slides(folder / "skating.usda", folder / "clean.usda")
    after = slides(folder / "clean.usda", folder / "clean.usda")
    assert len(before) == sum(each.contacts for each in cleaned.feet) >= 12
    assert before.max() > 0.008
    assert after.max() < 1e-4
    assert cleaned.met


def test_what_is_told_is_what_is_on_the_stage(folder, cleaned):
    for path, worst in (
        ("skating.usda", max(each.worst_before for each in cleaned.feet)),
        ("clean.usda", max(each.worst_after for each in cleaned.feet)),
    ):
        measured = slides(folder / path, folder / "clean.usda")
        assert measured.max() == pytest.approx(worst, abs=1e-5)


def test_the_rest_of_the_motion_is_kept(folder, cleaned):
    names = ("Hips", "Head", "LeftHand", "RightHand")
    before, after = (walked(folder / name, names) for name in ("skating.usda", "clean.usda"))
    assert np.linalg.norm(after - before, axis=-1).max() < 0.03
    (kept,) = cleaned.kept
    assert 0.0 < kept.moved_mean < kept.moved < 0.04
    assert kept.jerk_after < 1.2 * kept.jerk_before


def test_it_is_said_where_no_frame_is_away_from_contacts(cleaned):
    """A walker always stands: nothing is told of frames that are not there."""
    (kept,) = cleaned.kept
    assert kept.elsewhere is None and "no frame is more than 0.25 s away" in kept.sentence
    assert json.loads(cleaned.to_json())["kept"][0]["elsewhere"] is None


def test_cleaning_again_gives_the_same_bytes_of_motion(folder, cleaned, tmp_path):
    for name, shot in (("again", folder / "clean.usda"), ("third", tmp_path / "again.usda")):
        told = pipeline.clean(shot, tmp_path / f"{name}.usda")
        assert told.feet == cleaned.feet
        for array in ("rotations", "translations"):
            assert np.array_equal(
                result(tmp_path / f"{name}.usda", array), result(folder / "clean.usda", array)
            )


def test_solving_what_was_cleaned_gives_the_same_motion(folder, cleaned, tmp_path):
    pipeline.solve(folder / "clean.usda", tmp_path / "edit.usda")
    assert np.array_equal(result(tmp_path / "edit.usda"), result(folder / "clean.usda"))


def test_the_layer_opens_as_a_stage_and_the_shot_is_as_it_was(folder, cleaned, tmp_path):
    fresh = demos.build("skating", tmp_path)
    assert fresh.read_bytes() == (folder / "skating.usda").read_bytes()
    layer = Sdf.Layer.FindOrOpen(str(folder / "clean.usda"))
    assert list(layer.subLayerPaths) == ["./skating.usda"]
    stage = Usd.Stage.Open(layer)
    skeleton = UsdSkel.BindingAPI(stage.GetPrimAtPath(SKELETON))
    assert skeleton.GetAnimationSource().GetPath() == f"{EDIT}_result"
    assert stage.GetPrimAtPath(BALL).GetTypeName() == "MotionDetection"
    assert stage.GetEndTimeCode() == 73


def test_a_contact_that_is_switched_off_is_not_held_any_more(folder, cleaned, over, tmp_path):
    person = over(folder / "clean.usda", "")
    stage = Usd.Stage.Open(str(person))
    for name in FEET[:2]:
        stage.GetPrimAtPath(f"{EDIT}/{name}/Contact02").SetActive(False)
    stage.Save()
    told = pipeline.clean(person, tmp_path / "clean.usda")
    left = {each.joint.rsplit("/", 1)[-1]: each.contacts for each in told.feet}
    before = {each.joint.rsplit("/", 1)[-1]: each.contacts for each in cleaned.feet}
    assert [left[name] - before[name] for name in FEET] == [-1, -1, 0, 0]
    first, last = spans(folder / "clean.usda", BALL)[1]
    free = walked(tmp_path / "clean.usda")[int(first) + 2 : int(last) - 2, 1]
    source = walked(folder / "skating.usda")[int(first) + 2 : int(last) - 2, 1]
    assert np.abs(free - source).max() < 0.002
    assert np.linalg.norm(free - free.mean(axis=0), axis=1).max() > 0.003


def test_what_a_person_says_of_the_edit_stays(folder, cleaned, over, tmp_path):
    person = over(folder / "clean.usda", "")
    stage = Usd.Stage.Open(str(person))
    stage.GetPrimAtPath(EDIT).GetAttribute("usdmotion:smoothing").Set(0.0)
    stage.GetPrimAtPath(f"{EDIT}/KeepHips").SetActive(False)
    contact = stage.GetPrimAtPath(f"{EDIT}/RightFoot/Contact01")
    contact.GetAttribute("usdmotion:priority").Set(7)
    stage.Save()
    output = tmp_path / "clean.usda"
    pipeline.clean(person, output)
    stage = Usd.Stage.Open(str(output))
    edit = stage.GetPrimAtPath(EDIT)
    assert edit.GetAttribute("usdmotion:smoothing").Get() == 0.0
    assert not edit.GetChild("KeepHips").IsActive()
    contact = edit.GetChild("RightFoot").GetChild("Contact01")
    assert contact.GetAttribute("usdmotion:priority").Get() == 7


def test_a_walker_who_is_carried_stands_in_the_world(folder, over, tmp_path):
    carried = over(
        folder / "skating.usda",
        """over "Walker" {
            double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 73: (0, 0, 6) }
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }""",
    )
    told = pipeline.clean(carried, tmp_path / "clean.usda")
    assert told.met
    assert slides(tmp_path / "clean.usda", tmp_path / "clean.usda").max() < 1e-4


def test_the_joints_can_be_named_and_must_be_where_nobody_knows_the_feet(folder, over, tmp_path):
    unknown = over(folder / "skating.usda", "")
    stage = Usd.Stage.Open(str(unknown))
    skeleton = stage.GetPrimAtPath(SKELETON)
    tokens = skeleton.GetAttribute("joints").Get()
    joints = [str(each).rsplit("/", 1)[-1] for each in tokens]
    names = [f"j{index}" for index in range(len(joints))]
    for index, parent in enumerate(UsdSkel.Topology(tokens).GetParentIndices()):
        if parent >= 0:
            names[index] = f"{names[parent]}/{names[index]}"
    skeleton.GetAttribute("joints").Set(names)
    skeleton.GetAttribute("usdmotion:parts").Set([])
    stage.GetPrimAtPath("/Walker/Animation").GetAttribute("joints").Set(names)
    stage.Save()
    with pytest.raises(SceneError, match=r"which joints of .* are feet; name .* with --joints"):
        pipeline.clean(unknown, tmp_path / "clean.usda")
    feet = [names[joints.index(name)] for name in FEET]
    told = pipeline.clean(unknown, tmp_path / "clean.usda", joints=feet)
    assert [each.joint for each in told.feet] == feet
    assert max(each.worst_after for each in told.feet) < 1e-4


def test_no_input_is_written_to(folder, cleaned):
    for output in ("skating.usda", "clean.usda"):
        with pytest.raises(FileError, match="no input is written to"):
            pipeline.clean(folder / "clean.usda", folder / output)


def test_only_some_frames_are_solved_where_that_is_asked(folder, cleaned, tmp_path):
    pipeline.clean(folder / "skating.usda", tmp_path / "clean.usda", frames=(20.0, 50.0))
    before, after = walked(folder / "skating.usda"), walked(tmp_path / "clean.usda")
    moved = np.abs(after - before).max(axis=(1, 2)) > 1e-5
    assert moved[22:48].any()
    assert not moved[:19].any() and not moved[50:].any()


def test_the_command_line_tells_it_and_writes_what_was_named(folder, tmp_path, monkeypatch, capsys):
    words = ["clean", str(folder / "skating.usda"), "-o", str(tmp_path / "out.usda"), "--strict"]
    words += ["--json", str(tmp_path / "out.json"), "--report", str(tmp_path / "out.html")]
    monkeypatch.setattr(sys, "argv", ["usdmotion", *words, "--smoothing", "6"])
    with pytest.raises(SystemExit, match="0"):
        cli.main()
    said = capsys.readouterr().out
    assert "foot slide during contacts" in said and "LeftToeBase" in said
    told = json.loads((tmp_path / "out.json").read_text())
    assert {each["joint"].rsplit("/", 1)[-1] for each in told["feet"]} == set(FEET)
    assert told["edits"][0]["path"] == EDIT and len(told["objects"]) == 4
    assert "KeepHips" in (tmp_path / "out.html").read_text()
    stage = Usd.Stage.Open(str(tmp_path / "out.usda"))
    edit = stage.GetPrimAtPath(EDIT)
    assert edit.GetAttribute("usdmotion:smoothing").Get() == 6.0


def test_where_no_foot_stands_nothing_is_moved_and_it_is_said(folder, tmp_path):
    told = pipeline.clean(folder / "skating.usda", tmp_path / "clean.usda", joints=["Head"])
    assert told.feet == () and told.met
    assert told.tables()[0] == "no foot was found to stand"
    (kept,) = told.kept
    assert kept.elsewhere == kept.moved < 1e-5
    before, after = (walked(each) for each in (folder / "skating.usda", tmp_path / "clean.usda"))
    assert np.abs(after - before).max() < 1e-5

"""From a shot to a stage of normalized motions: which motion, what travels, who is refused."""

import json

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom

from usdmotion import demos, pipeline, usd
from usdmotion.constraints import ContactConstraint, Goal, PositionConstraint
from usdmotion.demos.body import Proportions
from usdmotion.demos.people import person
from usdmotion.errors import FileError, SceneError
from usdmotion.motion import Motion

SKELETON = "/Walker/Skeleton"
HAND = "Hips/Spine/Spine1/Spine2/RightShoulder/RightArm/RightForeArm/RightHand"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a walk that nothing is asked of yet."""
    folder = tmp_path_factory.mktemp("normalizing")
    demos.build("skating", folder)
    return folder


@pytest.fixture
def over(folder, tmp_path):
    """Return what puts a layer over the walk, with a box and constraints of an edit."""

    def write(constraints, props=None, **settings):
        path = tmp_path / "shot.usda"
        layer = Sdf.Layer.CreateNew(str(path))
        layer.subLayerPaths.append(str(folder / "skating.usda"))
        stage = Usd.Stage.Open(layer)
        UsdGeom.SetStageMetersPerUnit(stage, 0.01)
        stage.SetTimeCodesPerSecond(24.0)
        stage.SetStartTimeCode(1.0)
        stage.SetEndTimeCode(73.0)
        UsdGeom.SetStageUpAxis(stage, "Y")
        box(stage)
        usd.author_edit(stage, f"{SKELETON}/Edit", **settings)
        for each in constraints:
            usd.author(stage, f"{SKELETON}/Edit/{each.path}", each)
        for name, prop in (props or {}).items():
            prim = stage.GetPrimAtPath(f"{SKELETON}/Edit/{name}")
            prim.GetRelationship("usdmotion:space").SetTargets([prop])
        layer.Save()
        return path

    return write


@pytest.fixture
def body(tmp_path):
    """Return what writes a stage with somebody smaller, and a box or none."""

    def write(with_box):
        path = tmp_path / f"body{with_box}.usda"
        somebody = person(1.3, proportions=Proportions(legs=0.9))
        stage = Usd.Stage.CreateNew(str(path))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        UsdGeom.SetStageUpAxis(stage, "Y")
        stage.SetTimeCodesPerSecond(24.0)
        shape = somebody.skeleton
        still = Motion(np.zeros(1), shape.rest_translations[None], shape.rest_rotations[None])
        codes, parts = np.array([1.0]), somebody.parts
        usd.author_character(stage, "/Body", shape, somebody.body, still, parts, time_codes=codes)
        if with_box:
            box(stage, 0.01)
        stage.GetRootLayer().Save()
        return path

    return write


def box(stage, unit=1.0):
    """Put a box somewhere that goes along and turns, and is scaled."""
    cube = UsdGeom.Cube.Define(stage, "/Box")
    cube.AddTranslateOp().Set(Gf.Vec3d(50.0, 90.0, 30.0) * unit)
    cube.AddRotateYOp().Set(30.0)
    cube.AddScaleOp().Set(Gf.Vec3f(20.0 * unit))


def wrist(path="Wrist", **said):
    return PositionConstraint(path=path, skeleton=SKELETON, joint=HAND, **said)


def test_what_an_edit_asks_travels_and_how_it_is_solved(over, tmp_path):
    goal = Goal(translation=np.array([0.2, 1.1, 0.4]), times=(0.5, 1.0))
    shot = over([wrist(goals=(goal,))], solver="ccd", smoothing=4.0, options={"rounds": 3})
    (told,) = pipeline.normalize(shot, tmp_path / "out.usda", contacts=False).motions
    (row,) = told.travellers
    assert (row.name, row.joint, row.travels) == ("Wrist", "r_radiocarpal", True)
    stage = Usd.Stage.Open(str(tmp_path / "out.usda"))
    motion = stage.GetPrimAtPath("/Walker")
    assert motion.GetAttribute("usdmotion:solver").Get() == "ccd"
    assert motion.GetAttribute("usdmotion:smoothing").Get() == 4.0
    assert motion.GetAttribute("usdmotion:option:rounds").Get() == 3
    held = UsdGeom.Xformable(stage.GetPrimAtPath("/Walker/Wrist/Goal1"))
    place = held.GetLocalTransformation().ExtractTranslation()
    np.testing.assert_allclose(np.array(place) * told.leg, goal.translation, atol=1e-6)


def test_the_motion_is_the_one_that_the_edit_starts_from(over, tmp_path):
    raised = Goal(mode="offset", translation=np.array([0.0, 0.1, 0.0]))
    shot = over([wrist(goals=(raised,))])
    pipeline.solve(shot, tmp_path / "edit.usda", compose=tmp_path / "solved.usda")
    told = pipeline.normalize(tmp_path / "solved.usda", tmp_path / "out.usda", contacts=False)
    assert told.motions[0].source == "/Walker/Animation"
    assert any(
        "what </Walker/Skeleton/Edit> asks of it travels along" in each for each in told.notes
    )


def test_contacts_are_looked_for_only_where_there_are_none_of_feet(folder, tmp_path):
    pipeline.clean(folder / "skating.usda", tmp_path / "clean.usda")
    (told,) = pipeline.normalize(tmp_path / "clean.usda", tmp_path / "out.usda").motions
    kinds = [row.type for row in told.travellers]
    assert kinds.count("MotionContactConstraint") == 12
    assert not any(row.found for row in told.travellers)
    (looked,) = pipeline.normalize(folder / "skating.usda", tmp_path / "out.usda").motions
    assert sum(row.found for row in looked.travellers) == len(looked.travellers) == 12


def test_what_is_held_in_a_prop_is_held_there_again_or_stays_behind(over, body, tmp_path):
    held = ContactConstraint(
        path="Held",
        skeleton=SKELETON,
        joint=HAND,
        kind="point",
        times=(0.2, 0.5, 1.0, 1.5),
        location=np.array([0.1, 0.2, 0.3]),
    )
    shot = over([held], {"Held": "/Box"})
    before = Usd.Stage.Open(str(shot))
    place = before.GetPrimAtPath(f"{SKELETON}/Edit/Held").GetAttribute("usdmotion:location").Get()
    options = {"contacts": False, "enforce": False}
    told = pipeline.retarget(shot, body(True), tmp_path / "out.usda", **options)
    assert [row.travels for row in told.travellers] == [True]
    stage = Usd.Stage.Open(str(tmp_path / "out.usda"))
    prim = stage.GetPrimAtPath(f"{told.edit}/Held")
    assert prim.GetRelationship("usdmotion:space").GetTargets() == [Sdf.Path("/Box")]
    np.testing.assert_allclose(prim.GetAttribute("usdmotion:location").Get(), place, atol=1e-6)
    told = pipeline.retarget(shot, body(False), tmp_path / "without.usda", **options)
    (row,) = told.travellers
    assert not row.travels and "</Box>, which is not on the stage" in row.why


def test_frames_are_those_that_were_asked_for(folder, tmp_path):
    shot, output = folder / "skating.usda", tmp_path / "out.usda"
    (told,) = pipeline.normalize(shot, output, frames=(10.0, 20.0), contacts=False).motions
    assert told.frames == 11
    stage = Usd.Stage.Open(str(output))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (10.0, 20.0)


def test_the_report_is_json_too(folder, tmp_path):
    told = pipeline.normalize(folder / "skating.usda", tmp_path / "out.usda", contacts=False)
    (motion,) = json.loads(told.to_json())["motions"]
    assert motion["path"] == "/Walker"
    assert motion["frames"] == 73


@pytest.mark.parametrize(
    ("said", "wrong"),
    [
        ({"source": "/Nobody"}, "</Nobody> is no Skeleton and no SkelAnimation"),
        ({"edits": ("/Nothing",)}, "</Nothing> is no MotionEdit; there are: none"),
        ({"frames": (200.0, 300.0)}, "has no sample of its source from 200 to 300"),
    ],
)
def test_what_is_not_there_is_refused_with_the_file(folder, tmp_path, said, wrong):
    with pytest.raises(SceneError, match=wrong) as refused:
        pipeline.normalize(folder / "skating.usda", tmp_path / "out.usda", **said)
    assert str(refused.value).startswith(f"{folder / 'skating.usda'}: ")


def test_a_stage_without_a_skeleton_is_refused(tmp_path):
    dice = demos.build("dice", tmp_path)
    with pytest.raises(SceneError, match="there is no Skeleton in motion"):
        pipeline.normalize(dice, tmp_path / "out.usda")
    with pytest.raises(FileError, match="there is no such file"):
        pipeline.normalize(tmp_path / "absent.usda", tmp_path / "out.usda")


@pytest.fixture(scope="module")
def whole(folder):
    """Return a file with the normalized motion of somebody who walks."""
    path = folder / "whole.s4d.usda"
    pipeline.normalize(folder / "skating.usda", path, contacts=False)
    return path


@pytest.mark.parametrize(
    ("name", "changed", "wrong"),
    [
        ("rootPosition", None, "has no usdmotion:rootPosition; normalize"),
        ("rootHeading", None, "has no usdmotion:rootHeading; normalize"),
        ("limbTwists", None, "has no usdmotion:limbTwists; normalize"),
        ("limbs", None, "has no usdmotion:limbs; normalize"),
        ("limbs", ["l_hip"] * 4, "has no l_shoulder, r_shoulder, r_hip among its limbs"),
        ("segments", ["vl5"], "has no .*skullbase among its segments"),
        ("spine", [(0, 0, 0)], "has 1 points in its spine for"),
    ],
)
def test_a_motion_that_is_not_whole_is_refused_with_its_own_file_and_prim(
    whole, folder, tmp_path, name, changed, wrong
):
    stage, broken = Usd.Stage.Open(str(whole)), tmp_path / "broken.s4d.usda"
    prim = stage.GetDefaultPrim()
    attribute = prim.GetAttribute(f"usdmotion:{name}")
    codes = attribute.GetTimeSamples()[:1]
    prim.RemoveProperty(attribute.GetName()) if changed is None else attribute.Set(changed, *codes)
    stage.GetRootLayer().Export(str(broken))
    with pytest.raises(SceneError, match=f"^{broken}: </Walker> {wrong}"):
        pipeline.retarget(broken, folder / "skating.usda", tmp_path / "out.usda")
    assert "/Walker" in {fault.path for fault in pipeline.inspect(broken).faults}
    assert not (tmp_path / "out.usda").exists()


def test_feet_of_which_no_contact_is_found_are_told_of_as_such(folder, tmp_path):
    found = pipeline.normalize(folder / "skating.usda", tmp_path / "found.usda")
    count = len(found.motions[0].travellers)
    assert any(f"{count} that its motion shows travel along" in note for note in found.notes)
    stage = Usd.Stage.CreateNew(str(tmp_path / "flying.usda"))
    stage.GetRootLayer().subLayerPaths.append(str(folder / "skating.usda"))
    stage.SetTimeCodesPerSecond(24.0)
    lift = UsdGeom.Xformable(stage.OverridePrim("/Walker")).AddTranslateOp(opSuffix="lift")
    for code in (1.0, 73.0):
        lift.Set(Gf.Vec3d(0.0, 40.0 * code, 0.0), code)
    stage.GetRootLayer().Save()
    flying = pipeline.normalize(tmp_path / "flying.usda", tmp_path / "none.usda")
    assert not flying.motions[0].travellers
    assert any("shows none either" in note for note in flying.notes)

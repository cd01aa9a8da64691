"""One motion on any body: another skeleton, other axes, units and places; its own gets it back."""

from dataclasses import dataclass

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdSkel

from usdmotion import demos, pipeline, usd
from usdmotion.demos.body import Proportions
from usdmotion.demos.people import person
from usdmotion.errors import FileError, SceneError
from usdmotion.motion import Motion

SKELETON = "/Walker/Skeleton"
SHORT = Proportions(legs=0.8, arms=1.1, width=1.2, feet=1.15)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a walk that skates, and its normalized motion."""
    folder = tmp_path_factory.mktemp("retargeting")
    demos.build("skating", folder)
    pipeline.normalize(folder / "skating.usda", folder / "walk.s4d.usda")
    return folder


@pytest.fixture(scope="module")
def body(folder):
    """Return what writes a stage with somebody at rest, and says how long his legs are."""

    def write(name, *, up="Y", unit=0.01, rate=24.0, animated=False, **made):
        path = folder / name
        if path.exists():
            return path
        somebody = person(**made, z_up=up == "Z")
        stage = Usd.Stage.CreateNew(str(path))
        UsdGeom.SetStageUpAxis(stage, up)
        UsdGeom.SetStageMetersPerUnit(stage, unit)
        stage.SetTimeCodesPerSecond(rate)
        shape = somebody.skeleton
        still = Motion(np.zeros(1), shape.rest_translations[None], shape.rest_rotations[None])
        codes = np.array([1.0])
        parts = somebody.parts
        usd.author_character(stage, "/Body", shape, somebody.body, still, parts, time_codes=codes)
        if not animated:
            stage.RemovePrim("/Body/Animation")
            UsdSkel.BindingAPI(
                stage.GetPrimAtPath("/Body/Skeleton")
            ).GetAnimationSourceRel().ClearTargets(True)
        stage.SetDefaultPrim(stage.GetPrimAtPath("/Body"))
        stage.GetRootLayer().Save()
        return path

    return write


@dataclass
class Shown:
    """What UsdSkel shows of a skeleton, in a world with y up, in metres and seconds."""

    times: np.ndarray
    places: np.ndarray
    turns: np.ndarray
    names: list

    def at(self, name):
        return self.places[:, self.names.index(name)]


def shown(path, skeleton="/Body/Skeleton"):
    stage = Usd.Stage.Open(str(path))
    prim = stage.GetPrimAtPath(skeleton)
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root.Find(prim), Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(prim))
    codes = query.GetAnimQuery().GetJointTransformTimeSamples()
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    matrices = np.array(
        [
            np.array(query.ComputeJointSkelTransforms(code))
            @ np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
            for code in codes
        ]
    )
    places = matrices[:, :, 3, :3] * unit
    if UsdGeom.GetStageUpAxis(stage) == "Z":
        places = places[..., [0, 2, 1]] * (1.0, 1.0, -1.0)
    names = [str(each).rsplit("/", 1)[-1] for each in query.GetJointOrder()]
    return Shown(
        np.array(codes) / stage.GetTimeCodesPerSecond(), places, matrices[:, :, :3, :3], names
    )


def contacts(path):
    """Return joint, first and last second of each contact that is on a stage."""
    stage = Usd.Stage.Open(str(path))
    rate = stage.GetTimeCodesPerSecond()
    return [
        (
            prim.GetAttribute("usdmotion:joint").Get().rsplit("/", 1)[-1],
            *(float(code) / rate for code in prim.GetAttribute("usdmotion:times").Get()[1:3]),
        )
        for prim in stage.Traverse()
        if prim.GetTypeName() == "MotionContactConstraint"
    ]


def stances(take, held):
    """Return where a joint is on each sample of a contact."""
    joint, start, end = held
    return take.at(joint)[(take.times >= start - 1e-6) & (take.times <= end + 1e-6)]


def test_a_skeleton_gets_its_own_motion_back(folder):
    shot, output = folder / "skating.usda", folder / "same.usda"
    told = pipeline.retarget(shot, shot, output)
    before, after = shown(shot, SKELETON), shown(output, SKELETON)
    assert np.linalg.norm(after.places - before.places, axis=-1).max() < 1e-4
    cosines = np.einsum("fjab,fjab->fj", after.turns, before.turns)
    assert np.degrees(np.arccos(np.clip((cosines - 1.0) / 2.0, -1.0, 1.0))).max() < 0.1
    assert any("gets it back as it was" in note for note in told.notes)


BODIES = {
    "other lengths": {"proportions": SHORT},
    "z up in metres": {"up": "Z", "unit": 1.0, "rest": "A", "axes": 3, "height": 1.3},
    "other joints": {"naming": "unreal", "vertebrae": 5, "finger_joints": 2, "twists": True},
    "another rate": {"rate": 30.0, "height": 2.0, "rest": "I", "animated": True},
}


@pytest.mark.parametrize("name", BODIES)
def test_feet_stand_on_any_body_as_they_stood(folder, body, name):
    target = body(f"{name.replace(' ', '_')}.usda", **BODIES[name])
    output = target.with_suffix(".walk.usda")
    told = pipeline.retarget(folder / "walk.s4d.usda", target, output)
    take = shown(output)
    held = contacts(output)
    assert len(held) == 12
    for each in held:
        places = stances(take, each)
        assert np.linalg.norm(places - places.mean(axis=0), axis=-1).max() < 2e-3
    source = shown(folder / "skating.usda", SKELETON)
    was = [each for each in contacts(folder / "walk.s4d.usda") if each[0].endswith("phalangeal")]
    balls = [each for each in held if each[0] in names_of(target, "metatarsophalangeal")]
    assert len(balls) == len(was) == 6
    before = steps_of([stances(source, (BALLS[part], *span)) for part, *span in was])
    after = steps_of([stances(take, each) for each in balls])
    np.testing.assert_allclose(after / told.leg, before / LEG, rtol=0.01)


LEG = 0.8349
BALLS = {"l_metatarsophalangeal": "LeftToeBase", "r_metatarsophalangeal": "RightToeBase"}


def names_of(target, word):
    """Return the names of the joints of a body that are a part."""
    stage = Usd.Stage.Open(str(target))
    prim = stage.GetPrimAtPath("/Body/Skeleton")
    joints = prim.GetAttribute("joints").Get()
    parts = prim.GetAttribute("usdmotion:parts").Get()
    return [
        str(joint).rsplit("/", 1)[-1]
        for joint, part in zip(joints, parts, strict=True)
        if part.endswith(word)
    ]


def steps_of(stood):
    """Return how far it is along the ground from each stance to the next."""
    flat = np.array([places.mean(axis=0) for places in stood])[:, [0, 2]]
    return np.linalg.norm(flat[1:] - flat[:-1], axis=-1)


def test_a_wrist_reaches_as_many_legs_away_as_it_did(folder, body):
    demos.build("reaching", folder)
    target = body("reacher.usda", proportions=SHORT)
    told = pipeline.retarget(folder / "reaching.usda", target, folder / "reached.usda")
    (edit,) = told.edits
    feet = {"LeftHeel", "LeftBall", "RightHeel", "RightBall"}
    names = {each.path.rsplit("/", 1)[-1] for each in edit.constraints}
    assert names == {*feet, "LeftWrist", "Balance"}
    assert all(each.met for each in edit.constraints)
    goals = [
        goal_of(folder / "reaching.usda", f"{SKELETON}/Reaching/LeftWrist"),
        goal_of(folder / "reached.usda", "/Body/Skeleton/Retargeted/LeftWrist"),
    ]
    np.testing.assert_allclose(goals[1] / told.leg, goals[0] / told.leg_before, atol=1e-6)


def goal_of(path, constraint):
    """Return where the goal of a constraint is in the world [m]."""
    stage = Usd.Stage.Open(str(path))
    (goal,) = stage.GetPrimAtPath(constraint).GetChildren()
    world = UsdGeom.Xformable(goal).ComputeLocalToWorldTransform(Usd.TimeCode(1.0))
    return np.array(world.ExtractTranslation()) * UsdGeom.GetStageMetersPerUnit(stage)


def test_the_same_inputs_give_the_same_bytes_and_neither_is_written_to(folder, body):
    source, target = folder / "walk.s4d.usda", body("plain.usda")
    before = source.read_bytes(), target.read_bytes()
    written = []
    for name in ("once.usda", "twice.usda"):
        pipeline.retarget(source, target, folder / name)
        written.append((folder / name).read_text())
    assert written[0] == written[1]
    assert (source.read_bytes(), target.read_bytes()) == before


def test_without_solving_the_edit_is_there_and_the_motion_stands_on_its_footprints(folder, body):
    target, output = body("unsolved.usda", proportions=SHORT), folder / "unsolved.walk.usda"
    told = pipeline.retarget(folder / "walk.s4d.usda", target, output, enforce=False)
    assert told.edit and not told.edits
    take = shown(output)
    for each in contacts(output):
        places = stances(take, each)
        assert np.linalg.norm(places - places.mean(axis=0), axis=-1).max() < 2e-3


def test_contacts_without_key_times_hold_all_along(folder, body):
    source, target = folder / "still.s4d.usda", body("standing.usda", proportions=SHORT)
    pipeline.normalize(folder / "skating.usda", source, frames=(6.0, 12.0))
    stage = Usd.Stage.Open(str(source))
    held = [each for each in stage.Traverse() if each.GetTypeName() == "MotionContactConstraint"]
    assert held
    for each in held:
        each.GetAttribute("usdmotion:times").Clear()
    stage.GetRootLayer().Save()
    told = pipeline.retarget(source, target, folder / "still.walk.usda")
    (edit,) = told.edits
    assert len(edit.constraints) == len(held) and all(each.met for each in edit.constraints)


def test_without_contacts_nothing_is_asked(folder, body):
    told = pipeline.retarget(
        folder / "skating.usda", body("free.usda"), folder / "free.walk.usda", contacts=False
    )
    assert not told.edit and not told.travellers


@pytest.mark.parametrize("instanced", [False, True])
def test_a_body_may_be_carried_about_and_be_an_instance(folder, body, instanced):
    target = body("carried.usda", proportions=SHORT)
    path = folder / f"carrying{instanced}.usda"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, "Y")
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    stage.SetTimeCodesPerSecond(24.0)
    cart = UsdGeom.Xform.Define(stage, "/Cart")
    move = cart.AddTranslateOp()
    for code in (1.0, 73.0):
        move.Set(Gf.Vec3d(code, 0.0, 5.0), code)
    prim = stage.DefinePrim("/Cart/Body")
    prim.GetReferences().AddReference(str(target))
    prim.SetInstanceable(instanced)
    stage.GetRootLayer().Save()
    output = path.with_suffix(".walk.usda")
    pipeline.retarget(folder / "walk.s4d.usda", path, output)
    take = shown(output, "/Cart/Body/Skeleton")
    held = contacts(output)
    assert len(held) == 12
    for each in held:
        places = stances(take, each)
        assert np.linalg.norm(places - places.mean(axis=0), axis=-1).max() < 2e-3


def test_a_stage_with_several_bodies_wants_one_named(folder, body):
    path = folder / "two.usda"
    stage = Usd.Stage.CreateNew(str(path))
    for name in ("A", "B"):
        stage.DefinePrim(f"/{name}").GetReferences().AddReference(str(body("plain.usda")))
    stage.GetRootLayer().Save()
    source, output = folder / "walk.s4d.usda", folder / "two.walk.usda"
    with pytest.raises(SceneError, match="/A/Skeleton, /B/Skeleton; name one with --skeleton"):
        pipeline.retarget(source, path, output)
    with pytest.raises(SceneError, match="</C> is no Skeleton"):
        pipeline.retarget(source, path, output, skeleton="/C")
    assert pipeline.retarget(source, path, output, skeleton="/B/Skeleton").skeleton == "/B/Skeleton"


def test_neither_input_is_taken_for_the_output(folder, body):
    source, target = folder / "walk.s4d.usda", body("plain.usda")
    for output in (source, target):
        with pytest.raises(FileError, match="no input is written to"):
            pipeline.retarget(source, target, output)


def test_a_stage_shows_the_motion_it_was_given_and_no_more(folder):
    shot, output = folder / "skating.usda", folder / "short.usda"
    pipeline.retarget(shot, shot, output, frames=(10.0, 20.0), contacts=False)
    stage = Usd.Stage.Open(str(output))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (10.0, 20.0)

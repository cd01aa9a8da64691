"""Dance company, on captured clips: what one body does, bodies of other makers do (2005).

Nothing of the answers is asked how well they did: feet are looked at on the composed stages, during
the contacts of the source.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import pipeline
from usdmotion.usd import normalized
from usdmotion.usd.stages import open_stage, read_facts

CLIPS = {
    "mb": "cmu/mb/12_01.bvh",
    "daz": "cmu/daz/08_01_trimmed.bvh",
    "iclone": "cmu/iclone/003_01.bvh",
    "rokoko": "other/rokoko_jesse_dance.bvh",
    "cesium": "usd/CesiumMan.usdz",
}
"""A body each: 31, 43, 100, 60 and 19 joints, five ways to name them, three units, two up axes."""
PAIRS = (
    ("mb", "cesium"),
    ("mb", "daz"),
    ("daz", "rokoko"),
    ("daz", "iclone"),
    ("iclone", "mb"),
    ("cesium", "mb"),
    ("rokoko", "cesium"),
)
FRAMES = {"rokoko": (1.0, 240.0), "mb": (24.0, 360.0)}
"""Of long clips, and without a T-pose that somebody put before one."""
BALL, ANKLE = "metatarsophalangeal", "talocrural"


@dataclass(frozen=True)
class Dancer:
    """A body on a stage: the place of each of its joints, in a world with y up [m]."""

    times: np.ndarray
    places: np.ndarray
    turns: np.ndarray
    tokens: list

    @classmethod
    def of(cls, path, skeleton):
        stage = Usd.Stage.Open(str(path))
        prim = stage.GetPrimAtPath(skeleton)
        cache = UsdSkel.Cache()
        cache.Populate(UsdSkel.Root.Find(prim), Usd.TraverseInstanceProxies())
        query = cache.GetSkelQuery(UsdSkel.Skeleton(prim))
        codes = query.GetAnimQuery().GetJointTransformTimeSamples()
        world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform
        matrices = np.array(
            [
                [np.array(each * world(code)) for each in query.ComputeJointSkelTransforms(code)]
                for code in codes
            ]
        )
        places = matrices[:, :, 3, :3] * UsdGeom.GetStageMetersPerUnit(stage)
        if UsdGeom.GetStageUpAxis(stage) == "Z":
            places = places[..., [0, 2, 1]] * (1.0, 1.0, -1.0)
        tokens = [str(token) for token in query.GetJointOrder()]
        seconds = np.array(codes) / stage.GetTimeCodesPerSecond()
        axes = matrices[:, :, :3, :3]
        turns = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
        return cls(seconds, places, turns, tokens)

    @property
    def fastest(self):
        """Return the largest turn of a joint in the world from a frame to the next [degrees]."""
        cosines = (np.einsum("fjab,fjab->fj", self.turns[1:], self.turns[:-1]) - 1.0) / 2.0
        return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))).max()


@dataclass(frozen=True)
class Stance:
    """A contact of a foot as the source has it, over leg length."""

    part: str
    start: float
    end: float
    place: np.ndarray


@pytest.fixture(scope="module")
def company(mocap, tmp_path_factory):
    """Return the folder of the clips as stages and as normalized motions, with their contacts."""
    folder, stances = tmp_path_factory.mktemp("company"), {}
    for name, clip in CLIPS.items():
        shot = mocap / clip
        if shot.suffix == ".bvh":
            shot = folder / f"{name}.usda"
            pipeline.import_motion(mocap / clip, shot)
        s4d = folder / f"{name}.s4d.usda"
        pipeline.normalize(shot, s4d, frames=FRAMES.get(name))
        stances[name] = (shot, s4d, _stances(s4d))
    return folder, stances


def _stances(s4d):
    stage = Usd.Stage.Open(str(s4d))
    rate, found = stage.GetTimeCodesPerSecond(), []
    for prim in stage.Traverse():
        if prim.GetTypeName() == "MotionContactConstraint":
            said = {
                name: prim.GetAttribute(f"usdmotion:{name}").Get()
                for name in ("joint", "times", "location")
            }
            start, end = (float(code) / rate for code in said["times"][1:3])
            found.append(Stance(said["joint"], start, end, np.array(said["location"])))
    return found


@pytest.fixture(scope="module", params=PAIRS, ids="{0[0]} on {0[1]}".format)
def danced(request, company):
    """Return a motion on another body: stances, that body, what is shown, what was shown."""
    folder, stances = company
    one, other = request.param
    shot, s4d, held = stances[one]
    target, output = stances[other][0], folder / f"{one}_on_{other}.usda"
    told = pipeline.retarget(s4d, target, output)
    stage = open_stage(target)
    prim = stage.GetPrimAtPath(told.skeleton)
    body = normalized.read_target(prim, np.array([1.0]), read_facts(stage)).morphology
    (source,) = pipeline.inspect(shot).skeletons
    return held, body, Dancer.of(output, told.skeleton), Dancer.of(shot, source.path)


def stood(stances, body, dancer, part):
    """Yield a stance of a part that the body has, and where the body's joint is meanwhile."""
    joint = body.parts.joint(part)
    if joint is None:
        return
    column = dancer.tokens.index(body.skeleton.joints[joint])
    for each in sorted(stances, key=lambda stance: stance.start):
        if each.part == part:
            on = (dancer.times >= each.start - 1e-6) & (dancer.times <= each.end + 1e-6)
            if on.sum() > 1:
                yield each, dancer.places[on, column]


def references(stances, body, side):
    """Return the part of a foot that steps are measured at: its ball, where both have one."""
    ball = f"{side}_{BALL}"
    known = body.parts.joint(ball) is not None and any(each.part == ball for each in stances)
    return ball if known else f"{side}_{ANKLE}"


def test_planted_feet_do_not_slide(danced):
    stances, body, dancer, _ = danced
    for part in (f"{side}_{joint}" for side in "lr" for joint in (ANKLE, BALL)):
        for _, places in stood(stances, body, dancer, part):
            assert np.linalg.norm(places - places.mean(axis=0), axis=-1).max() < 2e-3


def test_a_step_is_as_many_legs_long_as_it_was(danced):
    stances, body, dancer, _ = danced
    for side in "lr":
        pairs = list(stood(stances, body, dancer, references(stances, body, side)))
        was = np.array([each.place for each, _ in pairs]).reshape(-1, 3)
        now = np.array([places.mean(axis=0) for _, places in pairs]).reshape(-1, 3)
        before, after = (
            np.linalg.norm(np.diff(each[:, [0, 2]], axis=0), axis=-1) for each in (was, now)
        )
        long = before > 0.1
        np.testing.assert_allclose(after[long] / body.leg_length, before[long], rtol=0.01)


def test_standing_feet_neither_float_nor_sink(danced):
    stances, body, dancer, _ = danced
    lengths = body.measures
    for side in "lr":
        part = references(stances, body, side)
        stands = lengths.ball_height if part.endswith(BALL) else lengths.ankle_height
        for each, places in stood(stances, body, dancer, part):
            asked = body.leg_length * each.place[1] + stands[0]
            assert np.abs(places[:, 1] - asked).max() < 5e-3


def test_no_joint_jumps(danced):
    _, _, dancer, source = danced
    assert dancer.fastest < source.fastest + 5.0


@pytest.mark.parametrize("name", CLIPS)
def test_its_own_body_gets_it_back(company, name):
    folder, stances = company
    shot, s4d, _ = stances[name]
    output = folder / f"{name}_again.usda"
    told = pipeline.retarget(s4d, shot, output)
    before, after = Dancer.of(shot, told.skeleton), Dancer.of(output, told.skeleton)
    same = [int(np.abs(before.times - time).argmin()) for time in after.times]
    assert np.abs(before.times[same] - after.times).max() < 1e-6
    assert np.linalg.norm(after.places - before.places[same], axis=-1).max() < 1e-4
    apart = np.linalg.norm(after.turns - before.turns[same], axis=(-1, -2))
    assert np.degrees(2.0 * np.arcsin(apart / np.sqrt(8.0))).max() < 0.1

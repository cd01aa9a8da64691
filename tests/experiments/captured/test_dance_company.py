"""Dance company, on captured clips: what one body does, bodies of other makers do (2005).

Nothing of the answers is asked how well they did: feet are looked at on the composed stages and on
those of the sources, during the contacts of the source.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import pipeline
from usdmotion.s4d import Morphology
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
STANCES, STEPS = {"cesium": 0, "rokoko": 1}, {"cesium": 0, "rokoko": 0}
"""So many there are at least, else 4 and 2: one walks on the spot, one hardly ever stands still."""
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
                np.array(query.ComputeJointSkelTransforms(code)) @ np.array(world(code))
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
    """When the source has a contact of a foot [s]."""

    part: str
    start: float
    end: float


@dataclass(frozen=True)
class Danced:
    """A motion on another body, and on its own."""

    name: str
    stances: list
    source: Dancer
    own: Morphology
    after: Dancer
    body: Morphology

    def standing(self, part):
        """Return where a part that both have is during each stance of it: before, and after."""
        pairs = []
        for each in sorted(self.stances, key=lambda stance: stance.start):
            if each.part == part and self.body.parts.joint(part) is not None:
                pair = tuple(
                    dancer.places[on(dancer.times, each), dancer.tokens.index(token(body, part))]
                    for dancer, body in ((self.source, self.own), (self.after, self.body))
                )
                if min(map(len, pair)) > 1:
                    pairs.append(pair)
        return pairs

    def reference(self, side):
        """Return the part of a foot that steps are measured at: its ball, where both have one."""
        ball = f"{side}_{BALL}"
        return ball if self.standing(ball) else f"{side}_{ANKLE}"


def on(times, stance):
    return (times >= stance.start - 1e-6) & (times <= stance.end + 1e-6)


def token(body, part):
    return body.skeleton.joints[body.parts.joint(part)]


def leg(dancer, body):
    """Return the length of a leg on a stage, from hip to knee to ankle [m]."""
    lengths = []
    for side in "lr":
        chain = [
            dancer.places[:, dancer.tokens.index(token(body, f"{side}_{part}"))]
            for part in ("hip", "knee", ANKLE)
        ]
        lengths.append(np.linalg.norm(np.diff(chain, axis=0), axis=-1).sum(axis=0).mean())
    return np.mean(lengths)


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
                name: prim.GetAttribute(f"usdmotion:{name}").Get() for name in ("joint", "times")
            }
            start, end = (float(code) / rate for code in said["times"][1:3])
            found.append(Stance(said["joint"], start, end))
    return found


@pytest.fixture(scope="module", params=PAIRS, ids="{0[0]} on {0[1]}".format)
def danced(request, company):
    """Return a motion on another body, beside its own."""
    folder, stances = company
    one, other = request.param
    shot, s4d, held = stances[one]
    target, output = stances[other][0], folder / f"{one}_on_{other}.usda"
    told = pipeline.retarget(s4d, target, output)
    (source,) = pipeline.inspect(shot).skeletons
    return Danced(
        one,
        held,
        Dancer.of(shot, source.path),
        body_of(shot, source.path),
        Dancer.of(output, told.skeleton),
        body_of(target, told.skeleton),
    )


def body_of(shot, skeleton):
    stage = open_stage(shot)
    prim = stage.GetPrimAtPath(skeleton)
    return normalized.read_target(prim, np.array([1.0]), read_facts(stage)).morphology


def test_planted_feet_do_not_slide(danced):
    parts = [f"{side}_{joint}" for side in "lr" for joint in (ANKLE, BALL)]
    stood = [after for part in parts for _, after in danced.standing(part)]
    assert len(stood) >= STANCES.get(danced.name, 4)
    for places in stood:
        assert np.linalg.norm(places - places.mean(axis=0), axis=-1).max() < 2e-3


def test_a_step_is_as_many_legs_long_as_it_was(danced):
    legs = leg(danced.source, danced.own), leg(danced.after, danced.body)
    long = 0
    for side in "lr":
        stood = danced.standing(danced.reference(side))
        for (before, after), (then, later) in pairwise(stood):
            was, is_ = (
                np.linalg.norm((b.mean(axis=0) - a.mean(axis=0))[[0, 2]]) / own
                for a, b, own in ((before, then, legs[0]), (after, later, legs[1]))
            )
            if was > 0.1:
                long += 1
                assert is_ == pytest.approx(was, rel=0.01)
    assert long >= STEPS.get(danced.name, 2)


def test_standing_feet_neither_float_nor_sink(danced):
    legs, seen = (leg(danced.source, danced.own), leg(danced.after, danced.body)), 0
    for side in "lr":
        part = danced.reference(side)
        was, is_ = (
            (body.measures.ball_height if part.endswith(BALL) else body.measures.ankle_height)[0]
            for body in (danced.own, danced.body)
        )
        for before, after in danced.standing(part):
            seen += 1
            asked = is_ + (before[:, 1].mean() - was) / legs[0] * legs[1]
            assert np.abs(after[:, 1] - asked).max() < 5e-3
    assert seen >= STANCES.get(danced.name, 4)


def test_no_joint_jumps(danced):
    assert danced.after.fastest < danced.source.fastest + 5.0

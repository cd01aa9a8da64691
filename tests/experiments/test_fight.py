"""2005, figures 1 and 14: eight bodies fight in pairs, each looking at the other as he is now."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd

from usdmotion import Problem, Scene, cue, demos, pipeline, usd
from usdmotion.demos import fight
from usdmotion.demos.fighters import fighters
from usdmotion.kernels import forward
from usdmotion.plugins import host

FASTEST = 1000.0
"""Whoever kicks and punches turns no knee, elbow or shoulder faster than this [degrees/s]."""
_ALONG = np.linspace(0.0, 1.0, 21)[:, None]


@pytest.fixture(scope="module")
def everybody():
    return {own.name: own for own in fighters()}


@pytest.fixture(scope="module")
def fought(tmp_path_factory):
    """Return the stage before, the stage with the answer, and the report."""
    folder = tmp_path_factory.mktemp("fight")
    shot = demos.build("fight", folder)
    report = pipeline.solve(shot, folder / "edit.usda", compose=folder / "shot.usda")
    return Usd.Stage.Open(str(shot)), Usd.Stage.Open(str(folder / "shot.usda")), report


@pytest.fixture(scope="module")
def takes(everybody, fought, taken):
    return {name: taken(fought[1], own.path, times(own)) for name, own in everybody.items()}


@pytest.fixture(scope="module")
def before(everybody, fought, taken):
    return {name: taken(fought[0], own.path, times(own)) for name, own in everybody.items()}


def times(own):
    return fight.FIRST + np.arange(own.motion.frame_count)


def during(own, keys):
    """Return on which frames something is fully asked for."""
    _, first, last, _ = own.bout.moments(*keys)
    return (own.motion.times >= first) & (own.motion.times <= last)


def bouts(everybody):
    """Yield each attacker with who defends himself."""
    for number in range(1, 5):
        yield everybody[f"White{number}"], everybody[f"Red{number}"]


def middle_of_forearm(take):
    return 0.5 * (take.point("LeftForeArm") + take.point("LeftHand"))


def gap(one, its_take, its_joint, other, other_take, other_joint):
    """Return how far two segments are apart on each frame, thickness and all [m]."""
    ends = []
    for own, take, name in ((one, its_take, its_joint), (other, other_take, other_joint)):
        solid = own.solids[own.skeleton.index[own.token(name)]]
        start, end = take.point(name), take.point(name, solid.end)
        ends.append((start[:, None] + _ALONG * (end - start)[:, None], solid.radius))
    (a, thick), (b, wide) = ends
    apart = np.linalg.norm(a[:, :, None] - b[:, None], axis=-1).min(axis=(1, 2))
    return apart - thick - wide


def test_the_bodies_are_of_all_sizes(everybody):
    heights = np.array([own.build.height for own in everybody.values()]) / 1.7
    assert heights.min() <= 0.81
    assert heights.max() >= 1.14
    legs = [
        own.skeleton.rest_translations[own.skeleton.index[own.token("LeftLeg")]]
        for own in everybody.values()
    ]
    shares = np.linalg.norm(legs, axis=1) / heights
    assert np.ptp(shares) / shares.mean() > 0.05


def test_the_kick_is_warded_off_by_the_middle_of_the_forearm(everybody, takes):
    for attacker, defender in bouts(everybody):
        ankle = takes[attacker.name].point("RightFoot")
        apart = np.linalg.norm(middle_of_forearm(takes[defender.name]) - ankle, axis=1)
        assert apart[during(defender, fight.WARDED)].max() <= 1e-4


def test_the_kick_goes_to_the_chest_as_it_is_now(everybody, takes):
    for attacker, defender in bouts(everybody):
        place = defender.build.height * np.array(fight.CHEST)
        chest = takes[defender.name].point("Spine1", place)
        apart = np.linalg.norm(takes[attacker.name].point("RightFoot") - chest, axis=1)
        assert apart[during(attacker, fight.STRUCK)].max() <= 1e-3


def test_the_punch_is_aimed_at_the_head_and_misses_it(everybody, takes):
    for attacker, defender in bouts(everybody):
        hit, ducked = takes[defender.name], takes[attacker.name]
        missed = gap(defender, hit, "RightHand", attacker, ducked, "Head")
        assert missed.min() >= 0.05
        on = during(defender, fight.PUNCHED)
        assert missed[on].max() <= 0.25
        shoulder = hit.point("RightArm")
        arm, way = hit.point("RightHand") - shoulder, ducked.point("Head") - shoulder
        cosine = (
            np.sum(arm * way, axis=1) / np.linalg.norm(arm, axis=1) / np.linalg.norm(way, axis=1)
        )
        assert np.degrees(np.arccos(cosine[on])).max() <= 15.0


def test_without_the_duck_it_would_hit(everybody, takes, before):
    for attacker, defender in bouts(everybody):
        still = before[attacker.name].part(slice(0, 1))
        on = during(defender, fight.PUNCHED)
        hit = takes[defender.name].part(on)
        assert gap(defender, hit, "RightHand", attacker, still, "Head").min() <= 0.0


def test_feet_stand_where_they_are_planted(everybody, takes):
    for name, own in everybody.items():
        take, seconds = takes[name], own.motion.times
        stands = {
            "Left": np.ones(len(seconds), dtype=bool),
            "Right": np.ones(len(seconds), dtype=bool),
        }
        if own.attacks:
            up, down = own.bout.moments(fight.LIFTED[0], fight.LANDED[1])
            stands["Right"] = (seconds <= up) | (seconds >= down)
        for side, on in stands.items():
            for joint in (f"{side}Foot", f"{side}ToeBase"):
                places = take.point(joint)[on]
                assert np.linalg.norm(places - places[0], axis=1).max() <= 1e-4


def test_no_knee_no_elbow_and_no_shoulder_pops(everybody, takes):
    for name, own in everybody.items():
        for joint in (
            "LeftLeg",
            "RightLeg",
            *(f"{side}{arm}" for side in ("Left", "Right") for arm in ("Arm", "ForeArm")),
        ):
            turned = takes[name].speed(joint) / np.diff(own.motion.times)
            assert turned.max() <= FASTEST


def test_the_input_comes_back_when_the_fight_is_over(everybody, takes, before):
    for name, own in everybody.items():
        after = own.motion.times > own.bout.moments(fight.DUCKED[3])[0] + 0.05
        apart = takes[name].world[after, :, 3, :3] - before[name].world[after, :, 3, :3]
        assert after.sum() > 5
        assert np.abs(apart).max() <= 0.03


def test_nothing_gives_way_but_the_punch(fought):
    missed = {
        each.path.rsplit("/", 1)[-1]
        for edit in fought[2].edits
        for each in edit.constraints
        if not each.met
    }
    assert missed == {"Punch"}


def test_stepped_live_and_all_at_once_it_is_the_same_fight(everybody, fought, takes, tmp_path):
    shot = usd.read(demos.build("fight", tmp_path), kinds=host().constraints)
    first = shot.scenes[0]
    scene = Scene(
        tuple(each for scene in shot.scenes for each in scene.characters),
        tuple(each for scene in shot.scenes for each in scene.edits),
        first.time_codes,
        first.up,
    )
    problem = Problem.of(scene)
    performance = host().solver("ccd")().start(problem)
    for frame in range(problem.cast.frame_count):
        cue(performance, problem, frame)
        performance.step()
        places, _ = forward(problem.cast.parents, *(each[None] for each in performance.output))
        for own in everybody.values():
            found = places[0, scene.nodes(own.path)]
            told = takes[own.name].world[frame, :, 3, :3]
            assert np.abs(found - told).max() <= 2e-6


def test_who_wards_off_looks_at_the_ankle_as_it_is_now(tmp_path):
    """A kick that is given up changes what both do from that frame on, and nothing before."""
    shot = usd.read(demos.build("fight", tmp_path), kinds=host().constraints)
    scene = shot.scenes[0]
    problem, late = Problem.of(scene), 29
    names = [each.path.rsplit("/", 1)[-1] for each in scene.constraints]
    activity = np.array(problem.table.activity)
    activity[late:, problem.table.constraint == names.index("Kick")] = 0.0
    given_up = replace(problem, table=problem.table._replace(activity=activity))
    solver = host().solver("ccd")()
    kicked, let_go = (solver.solve(each).rotations for each in (problem, given_up))
    assert np.array_equal(kicked[:late], let_go[:late])
    apart = np.abs(kicked[late] - let_go[late])
    for path in ("/Fight/White1/Skeleton", "/Fight/Red1/Skeleton"):
        assert apart[scene.nodes(path)].max() > 0.01


def test_what_is_drawn_of_it_is_where_they_are(everybody, fought, takes, drawn, tmp_path):
    guides = drawn(Path(fought[1].GetRootLayer().realPath), tmp_path / "guides.usda")
    for attacker, _ in bouts(everybody):
        edit, take = f"{attacker.path}/Fight", takes[attacker.name]
        way = take.point("RightFoot")
        assert guides.off(f"{edit}/RightStands/Guides/After", way).max() < 3e-3
        for frame in np.flatnonzero(during(attacker, fight.STRUCK)):
            marker = guides.points(f"{edit}/Kick/Guides/Opponent/Marker", take.times[frame])
            assert np.linalg.norm(marker.mean(axis=0) - way[frame]) < 3e-3
    assert guides.size < 600_000

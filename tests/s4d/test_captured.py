"""Captured motion across the skeletons of other people."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdSkel
from usdmotion_bvh import BvhReader

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.humanoid import guess
from usdmotion.kernels import conjugate, forward, multiply, rotate, to_vector
from usdmotion.motion import Motion, Placement
from usdmotion.s4d import Morphology, NormalizedMotion, normalize, restore
from usdmotion.s4d.bodies.anatomy import rest_pose
from usdmotion.usd.characters import read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.relations import bound_animation
from usdmotion.usd.stages import read_facts

from .conftest import apart, steps

UP = {"Y": np.array((0.0, 1.0, 0.0)), "Z": np.array((0.0, 0.0, 1.0))}
BODIES = {
    "mb": "cmu/mb/12_01.bvh",
    "daz": "cmu/daz/60_10.bvh",
    "iclone": "cmu/iclone/006_10.bvh",
    "rokoko": "other/rokoko_jesse_dance.bvh",
    "mixamo": "other/mixamorig_turns.bvh",
    "fair": "other/fair_dab.bvh",
}
CLIPS = ("mb", "daz", "rokoko")
FOOT = ("talocrural", "metatarsophalangeal")
KEPT = (
    *("skullbase", "l_radiocarpal", "r_radiocarpal"),
    *("l_talocrural", "r_talocrural", "humanoid_root"),
)


class Captured:
    """A body, its motion and which way is up."""

    def __init__(self, path: Path) -> None:
        clip = BvhReader().read(path)
        self.motion, self.up = clip.motion, UP[clip.up]
        parts = guess(clip.skeleton, names=clip.original_names)
        self.body = Morphology.of(clip.skeleton, parts, poses=clip.motion)

    @property
    def normalized(self) -> NormalizedMotion:
        space = Placement.identity(self.motion.frame_count)
        return normalize(self.motion, space, self.body, up=self.up)


@pytest.fixture(scope="module")
def captured(mocap: Path) -> Mapping[str, Captured]:
    return {name: Captured(mocap / path) for name, path in BODIES.items()}


@pytest.fixture(scope="module")
def bodies(mocap: Path, captured: Mapping[str, Captured]) -> Mapping[str, Morphology]:
    known = {name: each.body for name, each in captured.items()}
    return {**known, "CesiumMan": of_usd(mocap / "usd/CesiumMan.usdz")}


def of_usd(path: Path) -> Morphology:
    character, _ = read_usd(path)
    return Morphology.of(character.skeleton, guess(character.skeleton))


def read_usd(path: Path) -> tuple[Character, Floats]:
    """Return the only character of a stage, and which way is up."""
    stage = Usd.Stage.Open(str(path))
    (prim,) = (prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Skeleton))
    animation, facts = bound_animation(prim), read_facts(stage)
    return read_character(prim, animation, own_times(animation), facts).character, facts.up


def turned(body: Morphology, motion: Motion, up: Floats, part: str) -> Floats:
    """Return how a part is turned in the world, away from a T-pose, (F, 4)."""
    _, orientations = forward(body.skeleton.parents, motion.translations, motion.rotations)
    canonical = multiply(orientations[:, body.joint(part)], body.canonical(part))
    to_y_up = (np.sin(-np.pi / 4.0), 0.0, 0.0, np.cos(np.pi / 4.0))
    return multiply(np.array(to_y_up), canonical) if up[2] else canonical


@pytest.mark.parametrize("clip", CLIPS)
def test_every_body_does_what_was_captured(
    captured: Mapping[str, Captured], bodies: Mapping[str, Morphology], clip: str
) -> None:
    """Head, hands and feet are turned as they were; no joint is much faster than any was."""
    source = captured[clip]
    normalized = source.normalized
    space = Placement.identity(len(normalized.times))
    fastest = steps(source.motion.rotations).max()
    for name, body in bodies.items():
        up = captured[name].up if name in captured else UP["Z"]
        motion = restore(normalized, body, space, up=up)
        for part in KEPT:
            own, other = (
                turned(*each, part)
                for each in ((source.body, source.motion, source.up), (body, motion, up))
            )
            assert np.linalg.norm(to_vector(multiply(conjugate(own), other)), axis=-1).max() < 1e-5
        assert steps(motion.rotations).max() < 1.3 * fastest, name


@pytest.mark.parametrize("name", ["CesiumMan.usdz", "RiggedFigure.usdz", "skeleton_66.usda"])
def test_characters_of_other_people_come_back(mocap: Path, name: str) -> None:
    """Under turned Xforms, with translations that are not those of the rest pose."""
    character, up = read_usd(mocap / "usd" / name)
    body = Morphology.of(character.skeleton, guess(character.skeleton))
    normalized = normalize(character.motion, character.placement, body, up=up)
    back = restore(normalized, body, character.placement, up=up)
    metres, degrees = apart(character.skeleton, character.motion, back)
    assert metres <= 1e-4
    assert degrees <= 0.1


def test_knees_bend_to_the_front_and_elbows_to_the_back(
    captured: Mapping[str, Captured],
) -> None:
    seen = 0
    for name, each in captured.items():
        normalized = each.normalized
        bent = normalized.limb_lengths < np.cos(np.radians(20.0))
        for limb, part in enumerate(normalized.limbs):
            twists = np.degrees(np.abs(normalized.limb_twists[bent[:, limb], limb]))
            most = 20.0 if part.endswith("hip") else 60.0
            assert not len(twists) or (twists < most).mean() > 0.95, (name, part)
            seen += len(twists) > 0
    # Somebody may keep an arm straight all along, but not most of them.
    assert seen >= 3 * len(captured)


def test_soles_are_level_where_feet_are_planted(captured: Mapping[str, Captured]) -> None:
    """While an ankle is as low as ankles get and hardly moves, the sole of its foot is level."""
    for name, each in captured.items():
        body, motion = each.body, each.motion
        places, _ = forward(body.skeleton.parents, motion.translations, motion.rotations)
        ankles = [body.joint(f"{side}_talocrural") for side in "lr"]
        lowest = (places[:, ankles] @ each.up).min() + 0.05 * body.leg_length
        tilts = {}
        for side, ankle in zip("lr", ankles, strict=True):
            speed = np.linalg.norm(np.gradient(places[:, ankle], motion.times, axis=0), axis=-1)
            planted = (speed < 0.2) & (places[:, ankle] @ each.up < lowest)
            foot = turned(body, motion, each.up, f"{side}_talocrural")[planted]
            upwards = 1.0 - 2.0 * (foot[:, 0] ** 2 + foot[:, 2] ** 2)
            if planted.any():
                tilts[side] = np.degrees(np.arccos(np.median(upwards)))
        # The dancer of Rokoko has his right heel in the air from the first frame to the last.
        assert set(tilts) == (set("l") if name == "rokoko" else set("lr")), name
        assert max(tilts.values()) < 12.0, (name, tilts)


def test_feet_are_built_alike_on_both_sides(bodies: Mapping[str, Morphology]) -> None:
    for name, body in bodies.items():
        slants = []
        for side in "lr":
            ankle, ball = (body.parts.joint(f"{side}_{part}") for part in FOOT)
            if ankle is not None and ball is not None:
                _, orientations = rest_pose(body.skeleton)
                way = body.rest_positions[ball] - body.rest_positions[ankle]
                way = rotate(conjugate(orientations[ankle]), way)
                seen = rotate(conjugate(body.part_frames[ankle]), way)
                slants.append(np.degrees(np.arcsin(seen[1] / np.linalg.norm(seen))))
        assert np.ptp(slants or [0.0]) < 5.0, name

"""Captured clips: what is known to be wrong in them is found, and what is sound stays."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from usdmotion.cast import Character
from usdmotion.cleaning import cleaned
from usdmotion.cleaning.outliers import find_outliers
from usdmotion.humanoid import recognize
from usdmotion.motion import Body, Motion, Placement
from usdmotion.options import configured
from usdmotion.plugins import host
from usdmotion.scene import Edit, Scene

CUTOFF = 10.0
"""What the documentation proposes [Hz]."""


@pytest.fixture
def scene_of(mocap: Path) -> Callable[[str], Scene]:
    """Return what puts a clip into a scene whose edit cleans its input."""

    def read(name: str) -> Scene:
        recording = configured(host().reader_of(mocap / name), {}).read(mocap / name)
        skeleton, motion = recording.skeleton, recording.motion
        frames = motion.frame_count
        character = Character(
            "/S",
            skeleton,
            Body.unknown(len(skeleton.joints)),
            motion,
            Placement.identity(frames),
            root=int(np.argmax(np.ptp(motion.translations, axis=0).max(axis=1))),
            parts=recognize(skeleton),
        )
        edit = Edit("/S/Edit", "/S", (), cleaning=CUTOFF)
        return Scene((character,), (edit,), np.arange(1.0, frames + 1.0), np.array([0, 1.0, 0]))

    return read


def joint(scene: Scene, name: str) -> int:
    joints = scene.characters[0].skeleton.joints
    return [token.rsplit("/", 1)[-1] for token in joints].index(name)


def peak(motion: Motion, joint: int, first: int) -> float:
    """Return how fast a joint ever turns from some frame on [degrees per second]."""
    turns = motion.rotations[first:, joint]
    dots = np.abs(np.sum(turns[1:] * turns[:-1], axis=1))
    steps = np.degrees(2.0 * np.arccos(np.minimum(dots, 1.0)))
    return float((steps / np.diff(motion.times[first:])).max())


@pytest.mark.parametrize(
    "name",
    [
        "cmu/daz/08_01_trimmed.bvh",
        "cmu/iclone/002_01.bvh",
        "cmu/mb/jumping_jacks_14_14_30fps.bvh",
        "other/fair_dab.bvh",
        "other/fair_jumping.bvh",
        "other/mixamorig_turns.bvh",
        "other/mocapbank_crouch.bvh",
        "other/rokoko_jesse_dance.bvh",
    ],
)
def test_sound_clips_have_no_outliers(name, scene_of) -> None:
    assert not find_outliers(scene_of(name).characters[0].motion).either.any()


@pytest.mark.parametrize(
    ("name", "where", "frames"),
    [
        ("cmu/daz/135_03.bvh", "hip", [0]),
        ("cmu/daz/135_04.bvh", "hip", [0]),
        ("cmu/daz/60_10.bvh", "hip", [0, *range(357, 362)]),
        ("cmu/iclone/007_12.bvh", "CC_Base_L_Upperarm", [0]),
        ("cmu/iclone/005_06.bvh", "CC_Base_R_Thigh", [*range(60, 64), *range(78, 82)]),
        ("cmu/iclone/006_15.bvh", "CC_Base_L_Hand", [60, 227]),
        ("cmu/mb/01_03.bvh", "RightFoot", [0, 2668, 4014]),
        ("other/fair_zombie.bvh", "Spine2", [682, 683]),
    ],
)
def test_added_t_poses_flips_and_spikes_are_found(name, where, frames, scene_of) -> None:
    scene = scene_of(name)
    found = find_outliers(scene.characters[0].motion).rotations[:, joint(scene, where)]
    assert set(frames) <= set(np.flatnonzero(found).tolist())
    assert np.count_nonzero(found) <= len(frames) + 4


@pytest.mark.parametrize(
    ("name", "knees", "kept"),
    [
        ("cmu/daz/135_04.bvh", ("lShin", "rShin"), 0.85),
        ("cmu/daz/135_03.bvh", ("lShin", "rShin"), 0.95),
        ("other/rokoko_jesse_dance.bvh", ("LeftLeg", "RightLeg"), 0.94),
    ],
)
def test_kicks_keep_their_speed(name, knees, kept, scene_of) -> None:
    scene = scene_of(name)
    after, _ = cleaned(scene, host().solver("prioritized_ik")().solve)
    for knee in (joint(scene, name) for name in knees):
        # The T-pose before the first frame rings on for some frames.
        before, now = (peak(each.characters[0].motion, knee, 25) for each in (scene, after))
        assert kept * before < now <= before


@pytest.mark.parametrize(
    "name",
    [
        "cmu/daz/135_04.bvh",
        "cmu/daz/60_10.bvh",
        "cmu/iclone/007_12.bvh",
        "cmu/iclone/005_06.bvh",
        "cmu/mb/01_03.bvh",
        "other/mocapbank_crouch.bvh",
        "other/rokoko_jesse_dance.bvh",
    ],
)
def test_feet_slide_less_than_in_the_input(name, scene_of) -> None:
    _, told = cleaned(scene_of(name), host().solver("prioritized_ik")().solve)
    held = told["/S/Edit"].held
    assert len(held) >= 2
    for each in held:
        assert each.slide_after < each.slide_before

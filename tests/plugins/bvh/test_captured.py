"""Clips that people captured, and files that somebody stumbled over."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from usdmotion_bvh import BvhReader

from usdmotion.errors import FileError
from usdmotion.kernels import forward

REFUSED = {
    "102_01cc_scale_clash": (188, "root_scale="),
    "frontkick_world_space_6dof": (46, "places in the world"),
    "head_219_values_213_channels": (7, "second OFFSET"),
}


def read_one(path: Path) -> list[str]:
    return list(BvhReader().read(path).notes)


def test_poses_are_those_of_the_text(family, farthest_off: Callable[..., float]) -> None:
    assert family.paths
    for path in family.paths:
        recording = BvhReader().read(path)
        assert recording.up == family.up, path
        frames = np.linspace(0, recording.motion.frame_count - 1, 6).astype(int)
        off = farthest_off(recording, path, family.metres, relative=family.relative, frames=frames)
        assert off < 1e-9, path


def test_every_file_is_read_or_refused_as_the_tables_say(mocap: Path, families) -> None:
    listed = {path for family in families for path in family.paths}
    listed |= {mocap / f"odd/bvh/{name}.bvh" for name in REFUSED}
    reproductions = mocap / "odd/bvh/reproductions"
    listed |= {*reproductions.glob("mova*.bvh"), *reproductions.glob("slimevr*.bvh")}
    assert listed == set(mocap.rglob("*.bvh"))


@pytest.mark.parametrize("name", REFUSED)
def test_what_would_have_to_be_guessed_is_refused_with_file_and_line(
    mocap: Path, name: str
) -> None:
    line, words = REFUSED[name]
    path = mocap / f"odd/bvh/{name}.bvh"
    with pytest.raises(FileError) as refusal:
        BvhReader().read(path)
    assert str(refusal.value).startswith(f"{path}, line {line}: ")
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_fused_numbers_are_taken_apart(mocap: Path) -> None:
    path = next(mocap.glob("odd/bvh/reproductions/slimevr*.bvh"))
    recording = BvhReader(unit=1.0).read(path)
    assert recording.motion.frame_count == 2
    turned = 2.0 * np.degrees(np.arccos(recording.motion.rotations[0, 1, 3]))
    assert turned == pytest.approx(4.0020632e-7, abs=1e-5)
    assert any("taken apart" in note for note in recording.notes)


def test_a_joint_may_have_end_in_its_name(mocap: Path) -> None:
    path = next(mocap.glob("odd/bvh/reproductions/mova*.bvh"))
    recording = BvhReader(unit=1.0).read(path)
    assert recording.skeleton.joints == ("Hips", "Hips/RightShould_End")
    assert recording.tip_points.tolist() == [[0.0, 10.0, 0.0]]


def test_the_clash_of_units_is_mended_by_the_factor_that_the_refusal_names(mocap: Path) -> None:
    path = mocap / "odd/bvh/102_01cc_scale_clash.bvh"
    with pytest.raises(FileError) as refusal:
        BvhReader().read(path)
    BvhReader(root_scale=1.0).read(path)
    factor = float(str(refusal.value).rpartition("=")[2])
    recording = BvhReader(root_scale=factor, unit=0.006).read(path)
    places, _ = forward(
        recording.skeleton.parents, recording.motion.translations, recording.motion.rotations
    )
    lowest = places[1:, :, 1].min(axis=1)
    assert np.median(np.abs(lowest)) < 0.1


def test_added_t_poses_are_noticed_and_no_others(mocap: Path) -> None:
    noticed = {
        path.stem
        for path in mocap.glob("cmu/*/*.bvh")
        if any("T-pose" in note for note in read_one(path))
    }
    daz = {"135_03", "135_04", "60_10", "61_10", "94_07", "05_01"}
    assert noticed == {"01_01", "01_03", "12_01", "007_04", "007_12"} | daz


def test_ringing_after_an_added_t_pose_is_said(mocap: Path) -> None:
    said = next(note for note in read_one(mocap / "cmu/daz/135_03.bvh") if "T-pose" in note)
    assert "rings until frame" in said
    assert "skip=8 " in said
    said = next(note for note in read_one(mocap / "cmu/mb/12_01.bvh") if "T-pose" in note)
    assert "rings" not in said
    assert "skip=1 " in said


def test_flips_of_single_frames_are_said(mocap: Path) -> None:
    assert any("318, 357" in note for note in read_one(mocap / "cmu/daz/60_10.bvh"))


@pytest.mark.parametrize("folder", ["cmu/mb", "cmu/daz", "other"])
def test_bodies_stand_upright_in_metres_near_the_floor(mocap: Path, folder: str) -> None:
    for path in sorted((mocap / folder).glob("*.bvh")):
        recording = BvhReader().read(path)
        motion, axis = recording.motion, 1 if recording.up == "Y" else 2
        places, _ = forward(recording.skeleton.parents, motion.translations, motion.rotations)
        tall = np.percentile(np.ptp(places[..., axis], axis=1), 95)
        assert 1.0 < tall < 1.9, path
        assert -0.1 < np.percentile(places[..., axis].min(axis=1), 10) < 0.15, path


def test_a_wrong_frame_time_is_overruled(mocap: Path) -> None:
    path = mocap / "cmu/daz_hands/05_01.bvh"
    assert BvhReader().read(path).frame_rate == 25.0
    recording = BvhReader(rate=120.0).read(path)
    assert recording.motion.times[-1] == pytest.approx(598 / 120)
    assert any("overruled by 120 samples per second" in note for note in recording.notes)

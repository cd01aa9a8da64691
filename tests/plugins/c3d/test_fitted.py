"""Skeletons that are fitted to captured markers, beside those that the laboratories computed."""

import re
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel
from usdmotion_c3d import C3dReader
from usdmotion_c3d.trials import read_trial

from usdmotion import import_motion
from usdmotion.fitting import fit
from usdmotion.humanoid import guess
from usdmotion.kernels import forward, rotate, world_points

pytest.importorskip("ezc3d", reason="C3D needs the extra 'c3d'")

FULL = {"PiG_Motion-FlatFoot-Full": 19, "PiG_Motion-FlatFoot-One": 19, "Gait": 17}
SUIT = {"mocap36": 19}
LOWER = {"FunctionalWalk": 7, "OMCS_exampleOverground": 7, "PiG_Motion3_FF": 7, "PlugInC3D": 7}
MODELLED = {"FEP": ("UpLeg", 0.04), "FEO": ("Leg", 0.03), "TIO": ("Foot", 0.02)}
"""Points in which Vicon's model writes hips, knees and ankles, and how far regressions differ."""


@pytest.fixture(scope="module", params=[*FULL, *SUIT, *LOWER])
def fitted(mocap: Path, request):
    folder = "odd/c3d" if request.param in SUIT else "c3d"
    path = mocap / folder / f"{request.param}.c3d"
    capture = C3dReader().read(path)
    recording, (note, *_) = fit(capture)
    return path, capture, recording, note


def test_markers_are_met_to_a_centimetre(fitted) -> None:
    path, _, recording, note = fitted
    assert len(recording.skeleton.joints) == (FULL | SUIT | LOWER)[path.stem]
    # Straps on a suit give way more than what is glued on skin.
    most = 15.0 if path.stem in SUIT else 10.0
    assert float(re.search(r"they are ([\d.]+) mm", note)[1]) < most


def test_joints_are_near_those_of_the_laboratory(fitted) -> None:
    path, _, recording, _ = fitted
    trial = read_trial(path)
    labels = trial.texts("POINT", "LABELS")
    motion = recording.motion
    positions, _ = forward(recording.skeleton.parents, motion.translations, motion.rotations)
    names = recording.original_names
    for mark, (joint, most) in MODELLED.items():
        for letter, side in (("L", "Left"), ("R", "Right")):
            if letter + mark in labels:
                theirs = 0.001 * trial.points[:, labels.index(letter + mark)]
                away = np.linalg.norm(theirs - positions[:, names.index(side + joint)], axis=1)
                assert np.nanmedian(away) < most, (side, joint)


def test_knees_bend_backwards_and_feet_are_on_the_floor(fitted) -> None:
    _, capture, recording, _ = fitted
    motion, names = recording.motion, recording.original_names
    positions, turns = forward(recording.skeleton.parents, motion.translations, motion.rotations)
    seen = capture.markers.seen.mean(axis=1) > 0.6
    up = "XYZ".index(capture.up)
    for side in ("Left", "Right"):
        hip, knee, ankle = (names.index(side + each) for each in ("UpLeg", "Leg", "Foot"))
        ahead = rotate(turns[:, hip], np.tile((0.0, 0.0, 1.0), (len(turns), 1)))
        shank = positions[:, ankle] - positions[:, knee]
        bend = -(shank * ahead).sum(axis=1) / np.linalg.norm(shank, axis=1)
        # The most in swing is 60 degrees; through the straight leg it goes by a few at most.
        assert bend[seen].max() > 0.6
        assert bend[seen].min() > -0.35
        tip = recording.tip_points[recording.tip_joints.tolist().index(ankle)]
        toe = world_points(positions[:, ankle], turns[:, ankle], tip)[seen, up]
        assert -0.02 < toe.min() < 0.08


def test_the_stage_has_a_character_that_other_verbs_know(mocap: Path, tmp_path: Path) -> None:
    source = mocap / "c3d/PiG_Motion-FlatFoot-One.c3d"
    capture = import_motion(source, tmp_path / "walk.usda", name="Walker")
    assert capture.fitted is not None
    stage = Usd.Stage.Open(str(tmp_path / "walk.usda"))
    assert stage.GetPrimAtPath("/Walker/Body").IsA(UsdSkel.Root)
    skeleton = stage.GetPrimAtPath("/Walker/Body/Skeleton")
    tokens = tuple(UsdSkel.Skeleton(skeleton).GetJointsAttr().Get())
    assert tokens == capture.fitted.skeleton.joints
    assert UsdGeom.Points.Get(stage, "/Walker/Markers")
    parts = guess(capture.fitted.skeleton).parts
    assert {"humanoid_root", "l_knee", "r_talocrural", "l_elbow", "skullbase"} <= set(parts)

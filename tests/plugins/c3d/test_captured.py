"""Files of many laboratories and makers."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from usdmotion_c3d import C3dReader

from usdmotion.errors import FileError
from usdmotion.testing import check_reader

pytest.importorskip("ezc3d", reason="C3D needs the extra 'c3d'")

ENCODINGS = [f"Eb015{letters}" for letters in ("pi", "pr", "si", "sr", "vi", "vr")]
GAIT = [
    *("ADemo1_rewrite_c3d_pc_float", "BTS", "FunctionalWalk", "Gait", "OMCS_exampleOverground"),
    *("PiG_Calibration-FlatFoot-Full", "PiG_Motion-FlatFoot-Full", "PiG_Motion-FlatFoot-One"),
    *("PiG_Motion3_FF", "PlugInC3D", "sub_labels"),
]
ODD = {
    "561xxa01_anonym.C3D": "no unit is said",
    "Dance.c3d": r"\+X is up",
    "FP_Type1.c3d": "",
    "MACsample.c3d": "more than once",
    "MotionMonitorC3D.c3d": r"\+Y is up",
    "Optotrak.c3d": "has 1149 frames, but holds 29",
    "badParameterOffset.c3d": "never seen",
    "bad_parameter_section.c3d": "the rest is missing",
    "mocap36.c3d": r"\+Z is up",
    "phasespace_sample.c3d": "its parameters are missing",
}
REFUSED = {
    "C3DRotationExample.c3d": "no points",
    "Empty.c3d": "empty",
    "parameterOverflow.c3d": "none of its 142 points is a marker that was seen",
}
UP_IS_Y = {"BTS", "FP_Type1", "MotionMonitorC3D", "561xxa01_anonym", "Dance", "Optotrak"}


@pytest.mark.parametrize("name", [*GAIT, *ENCODINGS])
def test_a_clip_keeps_the_contract(mocap: Path, name: str) -> None:
    path = mocap / f"c3d/{name}.c3d"
    check_reader(C3dReader(), path)
    capture = C3dReader().read(path)
    assert capture.up == ("Y" if name in UP_IS_Y else "Z")
    # People stand on the floor and are of human size, on every clip.
    # Those with a star are reflections that nobody put there.
    named = np.array([not label.startswith("*") for label in capture.markers.labels])
    seen = capture.markers.positions[capture.markers.seen & named]
    low, high = np.percentile(seen[:, "XYZ".index(capture.up)], (0.5, 99.5))
    assert -0.05 < low < 0.15
    assert 0.55 < high < 1.9


def test_every_clip_of_the_folders_is_listed(mocap: Path) -> None:
    assert {path.stem for path in mocap.glob("c3d/*.c3d")} == {*GAIT, *ENCODINGS}
    assert {path.name for path in mocap.glob("odd/c3d/*")} == {*ODD, *REFUSED}


def test_one_trial_in_six_encodings_is_one_trial(mocap: Path) -> None:
    first, *others = (C3dReader().read(mocap / f"c3d/{name}.c3d") for name in ENCODINGS)
    for other in others:
        assert other.markers.labels == first.markers.labels
        np.testing.assert_array_equal(other.markers.seen, first.markers.seen)
        apart = np.abs(other.markers.positions - first.markers.positions).max()
        # Real numbers of four bytes hold millimetres to this, whole numbers their exact scale.
        assert apart <= 0.001 * np.spacing(np.float32(2484.0)) / 2


@pytest.mark.parametrize("name", ODD)
def test_an_odd_file_is_read_and_says_what_is_odd(mocap: Path, name: str) -> None:
    path = mocap / f"odd/c3d/{name}"
    check_reader(C3dReader(), path)
    capture = C3dReader().read(path)
    assert capture.up == ("Y" if path.stem in UP_IS_Y else "Z")
    assert re.search(ODD[name], " ".join(capture.notes))


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_markers_is_refused_in_a_sentence(mocap: Path, name: str) -> None:
    with pytest.raises(FileError, match=REFUSED[name]) as refusal:
        C3dReader().read(mocap / f"odd/c3d/{name}")
    assert name in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_events_are_where_others_read_them(mocap: Path) -> None:
    listed = json.loads((mocap / "contacts/c3d_contacts.json").read_text())
    checked = 0
    for trial in listed:
        wanted = [(each["foot"], each["label"], each["t"]) for each in trial["events"]]
        found = [
            (each.context[:1], each.label, each.time)
            for each in C3dReader().read(mocap / "c3d" / trial["file"]).events
        ]
        assert [each[:2] for each in found] == [each[:2] for each in wanted], trial["file"]
        times = [each[2] for each in found]
        np.testing.assert_allclose(times, [each[2] for each in wanted], atol=1e-3)
        checked += len(found)
    assert checked > 50

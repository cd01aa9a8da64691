"""Rigid clusters of markers are something that detection can use."""

import json
from pathlib import Path

import pytest

from usdmotion import import_motion
from usdmotion.pipeline import detect

pytest.importorskip("ezc3d", reason="C3D needs the extra 'c3d'")

CLIP = "PiG_Motion-FlatFoot-One.c3d"


@pytest.mark.slow
def test_feet_are_found_at_rest_while_the_plates_feel_them(mocap: Path, tmp_path: Path) -> None:
    listed = json.loads((mocap / "contacts/c3d_contacts.json").read_text())
    (trial,) = (each for each in listed if each["file"] == CLIP)
    capture = import_motion(mocap / "c3d" / CLIP, tmp_path / "walk.usda", name="Walk", first=0.0)
    feet = {"L": "/Walk/Clusters/LeftFoot", "R": "/Walk/Clusters/RightFoot"}
    detect(tmp_path / "walk.usda", tmp_path / "walk.contacts.usda", prims=tuple(feet.values()))
    from pxr import Usd

    stage = Usd.Stage.Open(str(tmp_path / "walk.contacts.usda"))
    found = [
        [
            prim.GetAttribute("usdmotion:times").Get()
            for prim in stage.GetPrimAtPath(path).GetChildren()
        ]
        for path in ("/Walk/Detections/LeftFoot", "/Walk/Detections/RightFoot")
    ]
    spans = {
        foot: [(times[1], times[2]) for times in each if times]
        for foot, each in zip(feet, found, strict=True)
    }
    for stance in trial["plate_contacts"]:
        middle = 0.5 * (stance["start"] + stance["end"]) * capture.frame_rate
        # Before the heel leaves the ground, a little after the middle.
        assert any(first <= middle - 2.0 <= last for first, last in spans[stance["foot"]])
    for foot, each in spans.items():
        strikes = [s for s in trial["plate_contacts"] if s["foot"] == foot]
        for first, last in each:
            for stance in strikes:
                start, end = (stance[key] * capture.frame_rate for key in ("start", "end"))
                if first < end and last > start:
                    assert start - 5.0 < first and last < end + 5.0

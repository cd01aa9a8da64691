"""Contacts of a shot, from file to file, with detectors that do not do as they should."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import Contact, Detected, PluginError, Search, detect, searching
from usdmotion.asking import Asked
from usdmotion.plugins import Host, Plugin
from usdmotion.searching import search_over

Shot = Callable[..., Path]


def contact(kind: str, start: float, end: float) -> Contact:
    nothing = np.zeros(3)
    turn = np.array([0.0, 0.0, 0.0, 1.0])
    return Contact(
        kind=kind, start=start, end=end, point=nothing, location=nothing, orientation=turn
    )


@dataclass(frozen=True)
class Fake:
    name: ClassVar[str] = "contacts"
    answer: ClassVar[object] = None

    def detect(self, search: Search) -> Detected:
        return self.answer  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("answer", "sentence"),
    [
        (None, "'contacts' returns NoneType, not Detected"),
        (Detected((contact("knot", 0.0, 0.1),)), "a contact of the kind 'knot'"),
        (Detected((contact("space", 0.0, 99.0),)), "from 0 to 99 s on base"),
        (Detected((contact("space", 0.2, 0.1),)), "from 0.2 to 0.1 s on base"),
    ],
)
def test_a_detector_that_breaks_its_contract_is_named_and_nothing_is_written(
    arm_shot: Shot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: object, sentence: str
) -> None:
    monkeypatch.setattr(Fake, "answer", answer)
    plugin = Plugin("fake", "", "fake", detectors=(Fake,))
    monkeypatch.setattr(searching, "host", lambda: Host((plugin,)))
    with pytest.raises(PluginError, match=sentence):
        detect(arm_shot(), tmp_path / "out.usda", joints=["base"])
    assert not (tmp_path / "out.usda").exists()


def test_it_tells_what_it_is_doing(arm_shot: Shot, tmp_path: Path) -> None:
    told: list[str] = []
    shot = arm_shot()
    detect(shot, tmp_path / "out.usda", joints=["base"], say=told.append)
    assert told == [f"reading {shot}", "looking at base", f"writing {tmp_path / 'out.usda'}"]


def test_contacts_are_on_a_layer_in_memory_before_anything_is_written(
    arm_shot: Shot, tmp_path: Path
) -> None:
    from usdmotion.usd import Overlay

    overlay = Overlay.open(arm_shot(), tmp_path / "out.usda")
    report = search_over(overlay, Asked(joints=("base",)))
    assert report.count == 1
    assert overlay.stage.GetPrimAtPath(report.objects[0].contacts[0].path)
    assert not (tmp_path / "out.usda").exists()
    overlay.write()
    written = (tmp_path / "out.usda").read_text()
    assert str(tmp_path) not in written
    assert "@./arm.usda@" in written

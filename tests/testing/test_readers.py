"""The contract of readers finds what is wrong with one, and nothing where nothing is."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import Capture, Event, FileError, Markers, Motion, Reader, Recording, Skeleton
from usdmotion.testing import check_reader


@dataclass(frozen=True)
class Tape:
    """A reader of files that hold one number: how many frames of a still joint to make."""

    name: ClassVar[str] = "tape"
    suffixes: ClassVar[tuple[str, ...]] = (".tape",)

    def read(self, path: Path) -> Recording:
        try:
            count = int(path.read_text())
        except (OSError, ValueError) as error:
            raise FileError(f"{path}: line 1: no number") from error
        return still(count)


def still(frame_count: int) -> Recording:
    identity = np.tile((0.0, 0.0, 0.0, 1.0), (frame_count, 1, 1))
    motion = Motion(np.arange(frame_count) / 10.0, np.zeros((frame_count, 1, 3)), identity)
    skeleton = Skeleton(("hip",), np.array([-1]), np.zeros((1, 3)), identity[0])
    nothing = (np.zeros(0, dtype=np.int64), np.zeros((0, 3)))
    return Recording("tape", skeleton, motion, 10.0, ("Hip",), "Y", *nothing)


@dataclass(frozen=True)
class Worn(Tape):
    """A reader whose recordings are spoiled."""

    spoil: Callable[[Recording], Recording] = lambda recording: recording

    def read(self, path: Path) -> Recording:
        return self.spoil(super().read(path))


@dataclass(frozen=True)
class Credulous(Tape):
    """A reader that refuses nothing."""

    def read(self, path: Path) -> Recording:
        try:
            return super().read(path)
        except FileError:
            return still(1)


@pytest.fixture
def tape(tmp_path: Path) -> Path:
    path = tmp_path / "good.tape"
    path.write_text("3")
    return path


def test_a_good_reader_passes(tape: Path) -> None:
    assert isinstance(Tape(), Reader)
    check_reader(Tape(), tape)


def renamed(token: str) -> Callable[[Recording], Recording]:
    return lambda recording: replace(
        recording, skeleton=replace(recording.skeleton, joints=(token,))
    )


WORN = [
    (lambda r: replace(r, name="no name"), "must be a valid prim name"),
    (renamed("a hip"), "must end in a valid name"),
    (renamed("world/hip"), "must stand below its parent"),
    (lambda r: replace(r, original_names=()), "every joint must have its original name"),
    (lambda r: replace(r, frame_rate=20.0), "follow each other at the frame rate"),
    (lambda r: replace(r, up="X"), "up must be 'Y' or 'Z'"),
    (
        lambda r: replace(r, motion=replace(r.motion, rotations=np.zeros((3, 1, 4)))),
        "rotations must be unit quaternions",
    ),
    (
        lambda r: replace(r, motion=replace(r.motion, translations=np.full((3, 1, 3), np.nan))),
        "a motion must be finite",
    ),
    (
        lambda r: replace(r, tip_joints=np.array([7]), tip_points=np.zeros((1, 3))),
        "a tip must stand at a joint",
    ),
]


@pytest.mark.parametrize(("spoil", "sentence"), WORN)
def test_a_spoiled_recording_is_named(
    tape: Path, spoil: Callable[[Recording], Recording], sentence: str
) -> None:
    with pytest.raises(AssertionError, match=sentence):
        check_reader(Worn(spoil=spoil), tape)


def test_a_reader_that_refuses_nothing_is_found_out(tape: Path) -> None:
    with pytest.raises(AssertionError, match="a file that is not there must be refused"):
        check_reader(Credulous(), tape)


def captured(**changes: object) -> Capture:
    frames = 4
    seen = np.array([[True, True]] * frames)
    markers = Markers(("A", "B"), np.zeros((frames, 2, 3)), seen)
    facts = {"name": "c", "up": "Y", "frame_rate": 10.0, "times": np.arange(frames) / 10.0}
    return Capture(**({"markers": markers} | facts | changes))


@dataclass(frozen=True)
class Spool(Tape):
    """A reader of captured markers."""

    capture: Capture | None = None

    def read(self, path: Path) -> Capture:
        super().read(path)
        return self.capture or captured()


def unseen(*, moving: bool) -> Markers:
    seen = np.array([[True, True], [True, False], [True, False], [True, True]])
    positions = np.zeros((4, 2, 3))
    positions[2, 1] = float(moving)
    return Markers(("A", "B"), positions, seen)


def test_a_good_reader_of_markers_passes(tape: Path) -> None:
    check_reader(Spool(), tape)
    check_reader(Spool(capture=captured(markers=unseen(moving=False))), tape)


def some(label: str = "x", time: float = 0.0) -> Event:
    return Event(label, time)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"name": "no name"}, "must be a valid prim name"),
        ({"up": "X"}, "up must be"),
        ({"frame_rate": 30.0}, "follow each other at the frame rate"),
        ({"markers": unseen(moving=True)}, "must stay where it was seen last"),
        ({"markers": replace(unseen(moving=False), labels=("A", "A"))}, "labels must be unique"),
        ({"events": (some(time=1.0), some())}, "in the order of their times"),
        ({"events": (some(label=""),)}, "must have a label"),
    ],
)
def test_a_spoiled_capture_is_named(tape: Path, changes: dict[str, object], sentence: str) -> None:
    with pytest.raises(AssertionError, match=sentence):
        check_reader(Spool(capture=captured(**changes)), tape)

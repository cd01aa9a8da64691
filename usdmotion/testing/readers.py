"""The contract of a reader."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from usdmotion.capture import Capture
from usdmotion.contract import check_reader_kind
from usdmotion.errors import FileError, PluginError
from usdmotion.recording import Reader, Recording
from usdmotion.testing.captures import check_capture


def check_reader(reader: Reader, path: Path) -> None:
    """Check what a reader makes of a good file, and that it refuses what is none.

    Args:
        reader: The reader.
        path: A file that it reads.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    try:
        check_reader_kind(type(reader))
    except PluginError as error:
        raise AssertionError(str(error)) from error
    assert path.name.lower().endswith(reader.suffixes), f"{path.name} is no file of this reader"
    read, again = reader.read(path), reader.read(path)
    if isinstance(read, Capture):
        check_capture(read)
        same = isinstance(again, Capture) and np.array_equal(
            read.markers.positions, again.markers.positions
        )
    else:
        _check_names(read)
        _check_motion(read)
        same = (
            isinstance(again, Recording)
            and np.array_equal(read.motion.rotations, again.motion.rotations)
            and np.array_equal(read.motion.translations, again.motion.translations)
        )
    assert same, "the same file must give the same motion"
    _check_refusal(reader)


def _check_names(recording: Recording) -> None:
    assert recording.name.isidentifier(), f"'{recording.name}' must be a valid prim name"
    skeleton = recording.skeleton
    for token, parent in zip(skeleton.joints, skeleton.parents, strict=True):
        above, _, name = token.rpartition("/")
        assert name.isidentifier(), f"the joint token '{token}' must end in a valid name"
        owner = skeleton.joints[parent] if parent >= 0 else ""
        assert above == owner, f"the joint token '{token}' must stand below its parent '{owner}'"
    assert len(recording.original_names) == len(skeleton.joints), (
        "every joint must have its original name"
    )
    tips = recording.tip_joints
    known = (tips >= 0) & (tips < len(skeleton.joints))
    assert known.all(), "a tip must stand at a joint of the skeleton"


def _check_motion(recording: Recording) -> None:
    motion = recording.motion
    assert motion.frame_count > 0, "a recording must have a frame"
    assert motion.rotations.shape[1] == len(recording.skeleton.joints), (
        "the motion must have a transform for every joint"
    )
    assert recording.frame_rate > 0.0, "the frame rate must be above 0"
    wanted = np.arange(motion.frame_count) / recording.frame_rate
    assert np.allclose(motion.times, wanted, rtol=0.0, atol=1e-6), (
        "samples must start at 0 s and follow each other at the frame rate"
    )
    finite = np.isfinite(motion.translations).all() and np.isfinite(motion.rotations).all()
    assert finite, "a motion must be finite"
    lengths = np.linalg.norm(motion.rotations, axis=-1)
    assert np.abs(lengths - 1.0).max() < 1e-6, "rotations must be unit quaternions"
    assert recording.up in ("Y", "Z"), "up must be 'Y' or 'Z'"


def _check_refusal(reader: Reader) -> None:
    with TemporaryDirectory() as folder:
        absent = Path(folder) / f"absent{reader.suffixes[0]}"
        rubbish = Path(folder) / f"rubbish{reader.suffixes[0]}"
        rubbish.write_bytes(b"\x00\xff no motion at all\n")
        for path, what in ((absent, "a file that is not there"), (rubbish, "a file of rubbish")):
            try:
                reader.read(path)
            except FileError as error:
                assert path.name in str(error), f"the refusal of {what} must name the file"
                continue
            raise AssertionError(f"{what} must be refused by a FileError")

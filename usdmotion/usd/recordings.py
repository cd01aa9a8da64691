"""A recording becomes a stage of its own."""

from pathlib import Path

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.motion import Body
from usdmotion.recording import Recording
from usdmotion.usd.character_authoring import author_character
from usdmotion.usd.clips import SLACK
from usdmotion.usd.new_stages import new_stage


def write_recording(
    recording: Recording, output: Path, *, frame_rate: float | None = None, first: float = 1.0
) -> None:
    """Write a stage with one character that moves as it was recorded.

    Args:
        recording: What was captured.
        output: The layer to write.
        frame_rate: Time codes per second; None is the recording's samples per second.
        first: Time code of the first sample.

    Raises:
        FileError: It cannot be written there.
    """
    rate = frame_rate or recording.frame_rate
    codes = codes_of(recording.motion.times, rate, first)
    root = recording.name
    with new_stage(
        output,
        frame_rate=rate,
        first=float(codes[0]),
        last=float(codes[-1]),
        up=recording.up,
        root=root,
    ) as stage:
        author_recording(stage, f"/{root}", recording, codes)


def author_recording(stage: Usd.Stage, path: str, recording: Recording, codes: Floats) -> None:
    """Author the character of a recording.

    Args:
        stage: Where.
        path: Path of its SkelRoot.
        recording: What was captured.
        codes: Time code of each sample.
    """
    author_character(
        stage,
        path,
        recording.skeleton,
        Body.unknown(len(recording.skeleton.joints)),
        recording.motion,
        time_codes=codes,
        names=recording.original_names,
        tip_joints=recording.tip_joints,
        tip_points=recording.tip_points,
    )


def codes_of(times: Floats, rate: float, first: float) -> Floats:
    """Return the time codes of times [s].

    Samples that were meant to be on whole frames are, whatever dividing by the rate has done.
    """
    codes = first + times * rate
    whole = np.round(codes)
    return np.where(np.abs(codes - whole) < SLACK, whole, codes)

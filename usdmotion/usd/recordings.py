"""A recording becomes a stage of its own."""

from pathlib import Path

import numpy as np
from pxr import Usd

from usdmotion.motion import Body
from usdmotion.recording import Recording
from usdmotion.usd.character_authoring import author_character
from usdmotion.usd.clips import SLACK
from usdmotion.usd.layers import new_layer, require_writable, save
from usdmotion.usd.shot import Facts

_CENTIMETRE = 0.01


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
    require_writable(output, frozenset())
    rate = frame_rate or recording.frame_rate
    codes = first + recording.motion.times * rate
    # Samples that were meant to be on whole frames are, whatever dividing by the rate has done.
    whole = np.round(codes)
    codes = np.where(np.abs(codes - whole) < SLACK, whole, codes)
    facts = Facts(
        meters_per_unit=_CENTIMETRE,
        up_axis=recording.up,
        time_codes_per_second=rate,
        frames_per_second=rate,
        start=float(codes[0]),
        end=float(codes[-1]),
        default_prim=recording.name,
    )
    stage = Usd.Stage.Open(new_layer(facts))
    count = len(recording.skeleton.joints)
    author_character(
        stage,
        f"/{recording.name}",
        recording.skeleton,
        Body.unknown(count),
        recording.motion,
        time_codes=codes,
        names=recording.original_names,
        tip_joints=recording.tip_joints,
        tip_points=recording.tip_points,
    )
    root = stage.GetPrimAtPath(f"/{recording.name}")
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind("component")
    save(stage.GetRootLayer(), output)

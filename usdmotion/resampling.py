"""A motion at other times than its own."""

from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.capture import Capture
from usdmotion.kernels import slerp
from usdmotion.motion import Motion, between_samples

_SAMPLE_SLACK = 1e-6
"""Parts of a sample by which a clip may end early and keep its last one: times are rounded."""


def resample(motion: Motion, times: Floats) -> Motion:
    """Return a motion at other times: exact at its own samples, held before the first and after
    the last, between them turning evenly the shorter way and moving along straight lines.

    Args:
        motion: What to resample.
        times: Seconds, ascending, shape (time_count,).
    """
    before, after, shares = between_samples(motion.times, times)
    share = shares[:, None]
    start, end = motion.translations[before], motion.translations[after]
    # Both products, not start + share * (end - start), which would miss the end by a rounding.
    translations = (1.0 - share)[..., None] * start + share[..., None] * end
    start, end = motion.rotations[before], motion.rotations[after]
    rotations = slerp(start, end, np.broadcast_to(share, start.shape[:2]))
    rotations = np.where((share == 0.0)[..., None], start, rotations)
    rotations = np.where((share == 1.0)[..., None], end, rotations)
    return Motion(times, translations, rotations)


def evenly(motion: Motion, rate: float) -> Motion:
    """Return a motion with evenly spaced samples from its first time to its last.

    Args:
        motion: What to resample.
        rate: Samples per second.
    """
    return resample(motion, _even(motion.times, rate))


def capture_evenly(capture: Capture, rate: float) -> Capture:
    """Return a capture whose markers have evenly spaced samples; plates and events keep theirs.

    A marker is seen where it is seen on both samples around, and moves along straight lines.

    Args:
        capture: What to resample; it has no clusters and no skeleton yet.
        rate: Samples per second.
    """
    own, markers = capture.times, capture.markers
    times = _even(own, rate)
    place = np.clip((times - own[0]) * capture.frame_rate, 0.0, len(own) - 1.0)
    whole = np.round(place)
    place = np.where(np.abs(place - whole) < _SAMPLE_SLACK, whole, place)
    before = np.floor(place).astype(np.int64)
    after = np.ceil(place).astype(np.int64)
    share = (place - before)[:, None, None]
    positions = (1.0 - share) * markers.positions[before] + share * markers.positions[after]
    seen = markers.seen[before] & markers.seen[after]
    moved = replace(markers, positions=positions, seen=seen)
    return replace(capture, frame_rate=rate, times=times, markers=moved)


def _even(times: Floats, rate: float) -> Floats:
    """Return evenly spaced times from the first to the last of some [s], (sample_count,)."""
    count = int((times[-1] - times[0]) * rate + _SAMPLE_SLACK) + 1
    return np.asarray(times[0] + np.arange(count) / rate)

"""Frames that the body could not have reached from the frame before."""

import numpy as np

from usdmotion import Floats

_FAR = 0.05
"""Parts of the height that joints move in one frame on average, which only a jump does."""
_FAST = 8.0
"""A jump is this much faster than the motion usually is."""
_RINGING = 10
"""Frames after an added pose that smoothing may have spoilt."""
_MOST_NAMED = 5


def find_jumps(points: Floats, height: float) -> list[str]:
    """Return what there is to say about jumps: an added first pose, and later faults."""
    if len(points) < 4 or height <= 0.0:
        return []
    steps = np.linalg.norm(np.diff(points, axis=0), axis=2).mean(axis=1) / height
    usual = max(_FAR, _FAST * float(np.median(steps)))
    notes = []
    settled = 0
    if steps[0] > usual:
        settled = _settled(steps)
        rings = f", and rings until frame {settled - 1}" if settled > 1 else ""
        farthest = np.linalg.norm(points[1] - points[0], axis=1).max() / height
        away = f"frame 0 jumps by {farthest:.2f} of the height to frame 1, as an added T-pose does"
        notes.append(f"{away}{rings}: the option skip={settled} leaves it out")
    later = np.flatnonzero(steps[settled:] > usual) + settled + 1
    if len(later):
        frames = "frame " if len(later) == 1 else "frames "
        frames += ", ".join(str(frame) for frame in later[:_MOST_NAMED])
        more = f" and {len(later) - _MOST_NAMED} more" if len(later) > _MOST_NAMED else ""
        notes.append(f"the body jumps into {frames}{more}, as a fault of the capture does")
    return notes


def _settled(steps: Floats) -> int:
    """Return the first frame that an added pose at frame 0 does not disturb."""
    calm = steps[_RINGING : 3 * _RINGING]
    if not len(calm):
        return 1
    disturbed = np.flatnonzero(steps[:_RINGING] > 2.0 * calm.max())
    return int(disturbed[-1]) + 1 if len(disturbed) else 1

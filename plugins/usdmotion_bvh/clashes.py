"""Whether the path of the root and the lengths of the segments are in the same unit."""

import numpy as np

from usdmotion import Floats

_FACTORS = np.geomspace(1.0 / 128.0, 128.0, 281)
_MOST_FRAMES = 2000
_FITS, _DOES_NOT = 0.35, 0.6
_FEWEST_STEPS = 20


def path_factor(points: Floats, axis: int) -> float:
    """Return by what the root's path should be multiplied to let the lower foot stand still.

    It is 1 where the path fits as it is, or where the motion cannot tell: only a plain case of
    two units in one file is meant.

    Args:
        points: World positions, the root first, shape (frame_count, point_count, 3).
        axis: The axis that points up.
    """
    root = points[:_MOST_FRAMES, 0]
    body = points[:_MOST_FRAMES] - root[:, None]
    lowest = np.argmin(body[:-1, :, axis], axis=1)
    frames = np.arange(len(lowest))
    steps, swings = np.diff(root, axis=0), body[frames + 1, lowest] - body[frames, lowest]
    walked = np.linalg.norm(steps, axis=1)
    moving = (walked > 0.0) & (walked >= np.median(walked)) if len(walked) else frames > 0
    if np.count_nonzero(moving) < _FEWEST_STEPS:
        return 1.0
    errors = [_slide(factor * steps[moving], swings[moving]) for factor in _FACTORS]
    best = int(np.argmin(errors))
    factor = float(_FACTORS[best])
    clash = errors[best] < _FITS and _slide(steps[moving], swings[moving]) > _DOES_NOT
    return factor if clash and not 0.5 <= factor <= 2.0 else 1.0


def _slide(steps: Floats, swings: Floats) -> float:
    """Return how much of a typical step is slid over the floor, from 0 to 1.

    Where a foot stands, the body swings over it by just as much as the root moves.
    """
    slid = np.linalg.norm(steps + swings, axis=1)
    whole = np.linalg.norm(steps, axis=1) + np.linalg.norm(swings, axis=1)
    return float(np.median(slid / whole))

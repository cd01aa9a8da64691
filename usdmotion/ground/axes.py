"""The two directions along the ground, and what changes over time between its samples."""

import numpy as np

from usdmotion.arrays import Floats


def across(up: Floats) -> Floats:
    """Return the two directions at a right angle to the up axis, shape (2, 3).

    They are x and z where y is up, x and y where z is, and seen from above never mirrored.
    """
    first = np.eye(3)[int(np.argmin(np.abs(up)))]
    first = first - (first @ up) * up
    first /= np.linalg.norm(first)
    second = np.cross(up, first)
    # Of y up that is −z: people write heights as a function of x and z.
    return np.stack([first, -second if second.sum() < 0.0 else second])


def at_times(values: Floats, own: Floats, times: Floats) -> Floats:
    """Return values over their own times at other times, evenly between, held at the ends.

    Args:
        values: Shape (sample_count, …).
        own: Ascending [s], shape (sample_count,).
        times: Shape (frame_count,).
    """
    if len(own) == 1:
        return np.broadcast_to(values, (len(times), *values.shape[1:]))
    after = np.clip(np.searchsorted(own, times), 1, len(own) - 1)
    share = np.clip((times - own[after - 1]) / (own[after] - own[after - 1]), 0.0, 1.0)
    share = share.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[after - 1] * (1.0 - share) + values[after] * share)

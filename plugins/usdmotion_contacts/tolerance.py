"""How many frames two contacts may be apart and still be one (2006, section 7.1)."""

import math

from usdmotion.kernels import shared


@shared
def frame_tolerance(distance: float, frames: int, farthest: float) -> int:
    """ftol: F_max of two contacts at one place, less the farther they are apart, 0 beyond d_max.

    ⌊F_max exp(−d ln F_max / d_max) + 1e-9⌋, which is 1 at d_max; the 1e-9 is for rounding there.
    With an F_max of one or none it is that up to d_max (2006, appendix B).

    Args:
        distance: d, from one contact to the other [m].
        frames: F_max.
        farthest: d_max [m].
    """
    if distance > farthest:
        return 0
    if frames <= 1 or farthest <= 0.0:
        return frames
    return math.floor(frames * math.exp(-distance * math.log(frames) / farthest) + 1e-9)

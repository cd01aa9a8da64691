"""S4D: motion without the body that it was recorded on (2005).

`NormalizedMotion` is what a motion is when every length is a fraction of the body's own.
"""

from usdmotion.s4d.normalized import NormalizedMotion

__all__ = ["NormalizedMotion"]

"""A walk whose feet skate, as after a retarget: for `clean`."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.demos.figures import Figure, Plot
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.plots import noise, origin
from usdmotion.demos.walker import write_walk
from usdmotion.motion import Motion

NEXT = "usdmotion clean {stage}"
_FARTHER = 1.03
"""How much farther the body goes than its steps carry it."""
_SWAY = (0.004, 0.9)
"""How far it drifts to the side and back [m], and how often [Hz]."""


def skate(walking: Walk) -> Walk:
    """Return a walk that goes a little farther than its steps, and drifts to the side."""
    motion = walking.motion
    translations = np.array(motion.translations)
    far, often = _SWAY
    translations[:, 0, 0] += far * np.sin(2.0 * np.pi * often * motion.times)
    translations[:, 0, 2] *= _FARTHER
    return replace(walking, motion=Motion(motion.times, translations, motion.rotations))


def build(output: Path) -> None:
    """Write the stage."""
    write_walk(output, skate(walk(seconds=3.0)), "", ())


PICTURE = Figure(
    "2006, figure 7: feet that skate, and stand where they are found to",
    frames=(4.0, 10.0, 16.0, 29.0, 36.0, 42.0),
    views=("side",),
)
MORE_PICTURES = {
    "skating_noise": Plot(
        "2006, figures 3 and 6: steps of a foot, and the noise that examples teach", noise.pattern
    ),
    "skating_outliers": Plot(
        "2006, figures 4 and 5: an example that begins too early, naively and robustly",
        noise.outliers,
    ),
    "skating_far": Plot(
        "2006, figures 8 and 9: the same walk at and far from the origin", origin.far
    ),
    "skating_tolerance": Plot(
        "2006, figure 10: how long a gap between contacts is bridged", origin.tolerance
    ),
}

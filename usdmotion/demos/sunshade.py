"""2003, figure 8: a hand shades the eyes while the head turns."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion

ABOVE_EYES = np.array((-0.05, 0.13, 0.14))
"""Where the right wrist is to be in the frame of the head [m]."""
FRAMES = (25.0, 49.0, 109.0, 133.0)
TURN = 0.7
"""How far the head turns to each side [rad]."""
ARM = ("RightShoulder", "RightArm", "RightForeArm", "RightHand")


def build(output: Path) -> None:
    """Write the stage."""
    walking = looking_around(walk())
    head = token(walking, "Head")
    hand = PositionConstraint(
        path="RightWrist",
        skeleton=SKELETON,
        joint=token(walking, "RightHand"),
        recruits=tuple(token(walking, name) for name in ARM),
        goals=(
            Goal(
                path="AboveEyes",
                translation=ABOVE_EYES,
                joint=(SKELETON, head),
                times=tuple(map(seconds, FRAMES)),
            ),
        ),
    )
    write_walk(output, walking, "Sunshade", [hand])


def looking_around(walking: Walk) -> Walk:
    """Return a walk whose head turns left and right, once in its length."""
    motion = walking.motion
    phase = 2.0 * np.pi * motion.times / motion.times[-1]
    turns = np.zeros((len(phase), 3))
    turns[:, 1] = TURN * np.sin(phase)
    rotations = np.array(motion.rotations)
    head = walking.joint("Head")
    rotations[:, head] = multiply(rotations[:, head], from_vector(turns))
    return replace(walking, motion=Motion(motion.times, motion.translations, rotations))

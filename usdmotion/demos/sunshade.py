"""2003, figure 8: a hand shades the eyes while the head turns."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk
from usdmotion.kernels import from_vector, multiply
from usdmotion.motion import Motion

ABOVE_EYES = np.array((-0.15, 0.10, 0.12))
"""Where the right wrist is to be in the frame of the head [m]."""
IN_FRONT = np.array((-0.30, -0.25, 0.36))
"""Where it passes on its way up and down, around the shoulder [m]."""
FRAMES = (33.0, 51.0, 97.0, 115.0)
UP = (19.0, 35.0, 37.0, 51.0)
DOWN = (97.0, 111.0, 113.0, 129.0)
TURN = 0.7
"""How far the head turns to each side [rad]."""
ARM = ("RightShoulder", "RightArm", "RightForeArm", "RightHand")


def build(output: Path) -> None:
    """Write the stage."""
    walking = looking_around(walk())
    head = (SKELETON, token(walking, "Head"))

    def goal(name: str, point: Floats, frames: tuple[float, ...]) -> Goal:
        times = tuple(map(seconds, frames))
        return Goal(path=name, translation=point, joint=head, times=times)

    hand = PositionConstraint(
        path="RightWrist",
        skeleton=SKELETON,
        joint=token(walking, "RightHand"),
        recruits=tuple(token(walking, name) for name in ARM),
        goals=(
            goal("Up", IN_FRONT, UP),
            goal("AboveEyes", ABOVE_EYES, FRAMES),
            goal("Down", IN_FRONT, DOWN),
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


PICTURE = Figure(
    "2003, figure 8: a hand shades the eyes",
    frames=(33.0, 42.0, 55.0, 74.0, 97.0, 106.0),
)

"""A dance that is made of the walk: arms go up and round, and the chest sways against the steps."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.acting import turn
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.gait.walking import cycle_rate
from usdmotion.kernels import multiply
from usdmotion.motion import Motion

LENGTH = 2.625
"""How long it is [s]."""
_SWAY, _TWIST = 9.0, 14.0
"""How far each vertebra sways to the side and turns [degrees]."""
_LIFT = (35.0, 40.0)
"""How high the arms are above level, and how much that changes [degrees]."""


def dance() -> Walk:
    """Return a walk that is danced."""
    walking = walk(seconds=LENGTH)
    motion = walking.motion
    beat = 2.0 * np.pi * cycle_rate(1.7) * motion.times
    rotations = np.array(motion.rotations)

    def turned(name: str, turns: Floats) -> None:
        joint = walking.joint(name)
        rotations[:, joint] = multiply(rotations[:, joint], turns)

    for name in ("Spine", "Spine1", "Spine2"):
        turned(name, turn((2, _SWAY * np.sin(beat)), (1, _TWIST * np.cos(beat))))
    turned("Neck", turn((2, -1.5 * _SWAY * np.sin(beat))))
    turned("Head", turn((1, -2.0 * _TWIST * np.cos(beat))))
    for name, side in (("Left", 1), ("Right", -1)):
        high, wave = _LIFT
        lifted = high + wave * np.sin(0.5 * beat + side)
        ahead = -20.0 + 25.0 * np.cos(beat + side)
        joint = walking.joint(f"{name}Arm")
        rotations[:, joint] = turn((1, side * ahead), (2, side * lifted))
        bend = 40.0 + 30.0 * np.sin(beat + 0.5 * side)
        rotations[:, walking.joint(f"{name}ForeArm")] = turn((1, -side * bend))
        turned(f"{name}Hand", turn((2, -side * 25.0 * np.cos(beat))))
    return replace(walking, motion=Motion(motion.times, motion.translations, rotations))


def stands(dancing: Walk) -> Iterator[tuple[str, float, float]]:
    """Yield the times at which balls of the feet, and whole feet, stand still [s]."""
    heels = [each for each in dancing.stances if each.effector == "heel"]
    for ball in dancing.stances:
        if ball.effector != "toe":
            continue
        yield f"{ball.side}ToeBase", ball.start, ball.end
        for heel in heels:
            if heel.side == ball.side and heel.start <= ball.start < heel.end <= ball.end:
                yield f"{ball.side}Foot", ball.start, heel.end

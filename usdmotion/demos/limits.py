"""Limits of joints, above every priority: a heel that a knee keeps from the hip, an elbow likewise.

Whoever kicks here has stiff knees and elbows; already the input bends the kicking knee too far.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.constraints import Constraint, Goal, PositionConstraint
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.karate import planted
from usdmotion.demos.kick import kick
from usdmotion.demos.walker import SKELETON, seconds, token, write_walk

KNEE = 110.0
"""How far a knee bends [degrees]; the kick asks for 134."""
ELBOW = 115.0
"""How far an elbow bends [degrees]."""
AT_HIP = np.array((-0.085, -0.30, -0.15))
"""Where the right ankle is to be from the hips [m]: nearer than the knee allows."""
AT_SHOULDER = np.array((0.20, 0.06, 0.14))
"""Where the left wrist is to be from the thorax [m]: nearer to its shoulder than allowed."""
ASIDE = np.array((-0.15, 0.10, 0.05))
"""How far the right wrist is to be from where it was [m]: the shoulder has to help the elbow."""
FRAMES = (10.0, 25.0, 49.0, 64.0)
"""They leave their trajectories, are there, leave, are back."""


def build(output: Path) -> None:
    """Write the stage."""
    kicking = limited()
    write_walk(output, kicking, "Limits", asked(kicking))


def limited() -> Walk:
    """Return the kick of somebody whose knees and elbows are hinges, and bend less than others'."""
    kicking = kick()
    low, high = np.array(kicking.body.limits_min), np.array(kicking.body.limits_max)
    for side, bent in (("Left", (-ELBOW, 0.0)), ("Right", (0.0, ELBOW))):
        knee, elbow = kicking.joint(f"{side}Leg"), kicking.joint(f"{side}ForeArm")
        low[knee], high[knee] = 0.0, (KNEE, 0.0, 0.0)
        (low[elbow, 1], high[elbow, 1]), low[elbow, 2], high[elbow, 2] = bent, 0.0, 0.0
    return replace(kicking, body=replace(kicking.body, limits_min=low, limits_max=high))


def asked(kicking: Walk) -> Sequence[Constraint]:
    """Return the planted foot (1), the right wrist (2), the left one (3) and the ankle (4)."""
    limbs = {
        "RightWrist": ("RightShoulder", "RightArm", "RightForeArm", "RightHand"),
        "LeftWrist": ("LeftArm", "LeftForeArm", "LeftHand"),
        "RightAnkle": ("RightUpLeg", "RightLeg", "RightFoot"),
    }
    times = tuple(map(seconds, FRAMES))
    thorax, hips = ((SKELETON, token(kicking, name)) for name in ("Spine2", "Hips"))
    goals = (
        Goal(path="Aside", mode="offset", translation=ASIDE, times=times),
        Goal(path="AtShoulder", translation=AT_SHOULDER, joint=thorax, times=times),
        Goal(path="AtHip", translation=AT_HIP, joint=hips, times=times),
    )
    return [
        *planted(kicking),
        *(
            PositionConstraint(
                path=name,
                skeleton=SKELETON,
                joint=token(kicking, limb[-1]),
                priority=priority,
                recruits=tuple(token(kicking, joint) for joint in limb[:-1]),
                goals=(goal,),
            )
            for priority, ((name, limb), goal) in enumerate(
                zip(limbs.items(), goals, strict=True), start=2
            )
        ),
    ]


PICTURE = Figure(
    "Limits of joints stand above every priority",
    frames=(10.0, 21.0, 31.0, 41.0, 49.0, 61.0),
)

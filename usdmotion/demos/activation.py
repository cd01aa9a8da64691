"""2004, section 5.2: every kind of constraint is switched on and off by its activity.

The edit has a variant for each kind alone, and one in which all of them are a stack of ranks.
"""

from dataclasses import replace
from pathlib import Path
from typing import TypedDict

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import (
    AimConstraint,
    CenterOfMassConstraint,
    Constraint,
    ContactConstraint,
    DistanceConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    Region,
    RegionConstraint,
    TrajectoryConstraint,
)
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.walker import SKELETON, feet, seconds, token, write_walk
from usdmotion.kernels import forward, from_vector

EDIT = "Activation"
FRAMES = (25.0, 49.0, 85.0, 109.0)
"""Activities ease in over a second, stay, and ease out over a second."""
STACK = "stack"
"""Name of the variant with all of them."""
BALL = 0.3
"""Radius of the ball that goes along at the walker's right [m]."""
GRIP = (49.0, 61.0, 65.0, 77.0)
"""The hand cannot hold on for longer, as the walker goes on."""


class _Shared(TypedDict):
    path: str
    skeleton: str
    joint: str
    times: tuple[float, ...]


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    alone = kinds(walking)
    stack = [replace(each, priority=rank) for rank, each in enumerate(alone.values(), start=2)]
    variants = {STACK: [*feet(walking, priority=1), *stack]}
    write_walk(
        output, walking, EDIT, [], {**variants, **{name: [each] for name, each in alone.items()}}
    )


def kinds(walking: Walk) -> dict[str, Constraint]:
    """Return one constraint of each kind that the walk does not meet, by a short name."""
    return {**_with_goals(walking), **_without_goals(walking)}


def _with_goals(walking: Walk) -> dict[str, Constraint]:
    lift = Goal(path="Lift", mode="offset", translation=np.array((0.1, 0.2, 0.1)))
    turn = from_vector(np.array((0.5, 0.0, 0.0)))
    nod = Goal(path="Turn", mode="offset", rotation=turn)
    lamp = Goal(path="Lamp", translation=np.array((2.5, 1.9, 9.0)))
    return {
        "position": PositionConstraint(**_held(walking, "Wrist", "LeftHand"), goals=(lift,)),
        "orientation": OrientationConstraint(**_held(walking, "Nod", "Neck"), goals=(nod,)),
        "aim": AimConstraint(**_held(walking, "Look", "Head"), goals=(lamp,)),
    }


def _without_goals(walking: Walk) -> dict[str, Constraint]:
    hips, head = (_trajectory(walking, name) for name in ("Hips", "Head"))
    ball = Region(
        path=f"{SKELETON}/{EDIT}/Ball",
        margin=BALL,
        translation=hips + np.array((-0.45, -0.1, 0.05)),
    )
    grip = hips[62] + np.array((-0.15, 0.25, 0.25))
    below = head[66] + np.array((0.05, -0.1, 0.05))
    return {
        "distance": DistanceConstraint(
            **_held(walking, "Hands", "LeftHand"),
            other_joint=token(walking, "RightForeArm"),
            distance=0.35,
        ),
        "region": RegionConstraint(**_held(walking, "Aside", "RightHand"), region=ball),
        "center_of_mass": CenterOfMassConstraint(
            **_held(walking, "Lean", ""), axes="xz", displacement=np.array((0.04, 0.0, 0.05))
        ),
        "trajectory": TrajectoryConstraint(
            **_held(walking, "Duck", "Head"), keys=(seconds(67),), points=below[None]
        ),
        "contact": ContactConstraint(
            **_held(walking, "Rail", "RightHand", GRIP), kind="point", location=grip
        ),
    }


def _held(walking: Walk, path: str, joint: str, frames: tuple[float, ...] = FRAMES) -> _Shared:
    """Return what every kind is given, the key times of its activity among it."""
    return {
        "path": path,
        "skeleton": SKELETON,
        "joint": token(walking, joint) if joint else "",
        "times": tuple(map(seconds, frames)),
    }


def _trajectory(walking: Walk, joint: str) -> Floats:
    """Return where a joint of the walk is [m], shape (frame_count, 3)."""
    motion = walking.motion
    positions, _ = forward(walking.skeleton.parents, motion.translations, motion.rotations)
    return np.asarray(positions[:, walking.joint(joint)])


PICTURE = Figure(
    "2004, section 5.2: constraints are switched on and off",
    frames=(25.0, 37.0, 49.0, 67.0, 85.0, 97.0),
    answers=tuple(Answer(name, variant=name) for name in ("position", "trajectory", "contact")),
    before=False,
)

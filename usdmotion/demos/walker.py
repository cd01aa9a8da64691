"""The character of the demos: a walk on a stage, and the constraints that hold its feet."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from usdmotion import usd
from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, PositionConstraint
from usdmotion.demos.body import solids
from usdmotion.demos.gait import Walk

RATE = 24.0
"""Frames per second."""
FIRST = 1.0
"""Time code of the first frame."""
SKELETON = "/Walker/Skeleton"


def write_walk(output: Path, walk: Walk, edit: str, constraints: Sequence[Constraint]) -> None:
    """Write a stage with the walker and one edit of it.

    Args:
        output: The layer to write.
        walk: Who walks, and how.
        edit: Name of the MotionEdit, under the Skeleton.
        constraints: What is asked; the last part of each path is the prim's name.
    """
    codes = FIRST + np.round(walk.motion.times * RATE)
    ends = solids()
    with usd.new_stage(
        output, frame_rate=RATE, first=float(codes[0]), last=float(codes[-1]), root="Walker"
    ) as stage:
        usd.author_character(
            stage,
            "/Walker",
            walk.skeleton,
            walk.body,
            walk.motion,
            walk.parts,
            time_codes=codes,
            tip_joints=np.array([each.joint for each in ends]),
            tip_points=np.array([each.end for each in ends]),
        )
        usd.author_edit(stage, f"{SKELETON}/{edit}")
        for each in constraints:
            name = each.path.rsplit("/", 1)[-1]
            usd.author(stage, f"{SKELETON}/{edit}/{name}", each, time_codes=codes)


def token(walk: Walk, name: str) -> str:
    """Return the token of a joint by its last part."""
    return walk.skeleton.joints[walk.joint(name)]


def feet(walk: Walk, *, priority: int) -> list[PositionConstraint]:
    """Return the constraints that keep heels and balls of the feet on their trajectories."""

    def keep(name: str, joint: str, point: Floats) -> PositionConstraint:
        return PositionConstraint(
            path=name,
            skeleton=SKELETON,
            joint=token(walk, joint),
            point=point,
            priority=priority,
        )

    return [
        keep(f"{side}{part}", f"{side}{joint}", point)
        for side in ("Left", "Right")
        for part, joint, point in (
            ("Heel", "Foot", walk.heel_point),
            ("Ball", "ToeBase", walk.toe_point),
        )
    ]


def seconds(frame: float) -> float:
    """Return the time of a frame of the stage [s]."""
    return (frame - FIRST) / RATE

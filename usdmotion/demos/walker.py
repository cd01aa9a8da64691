"""The character of the demos: a walk on a stage, and the constraints that hold its feet."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from usdmotion import usd
from usdmotion.arrays import Floats
from usdmotion.constraints import (
    CenterOfMassConstraint,
    Constraint,
    PositionConstraint,
    Region,
    RegionConstraint,
)
from usdmotion.demos.body import solids
from usdmotion.demos.gait import Walk
from usdmotion.motion import Body

RATE = 24.0
"""Frames per second."""
FIRST = 1.0
"""Time code of the first frame."""
SKELETON = "/Walker/Skeleton"
VARIANTS = "asked"
"""Name of the variant set of an edit that asks for one thing or another."""
BODIES = "body"
"""Name of the variant set of a Skeleton that moves in one way or another."""


def write_walk(
    output: Path,
    walk: Walk,
    edit: str,
    constraints: Sequence[Constraint],
    variants: Mapping[str, Sequence[Constraint]] = MappingProxyType({}),
    *,
    bodies: Mapping[str, Body] = MappingProxyType({}),
    props: Sequence[Region] = (),
    scenery: Callable[[Any], None] = lambda _: None,
    **of_edit: Any,
) -> None:
    """Write a stage with the walker and one edit of it.

    Args:
        output: The layer to write.
        walk: Who walks, and how.
        edit: Name of the MotionEdit, under the Skeleton; "" makes none.
        constraints: What is asked; the last part of each path is the prim's name.
        variants: What is asked besides in each variant of the edit; the first is selected.
        bodies: What is said of the body in each variant of the Skeleton; the first is selected.
        props: What stands about.
        scenery: Authors what else is on the stage.
        of_edit: What `usd.author_edit` is told besides: solver, options, ground, passes, …
    """
    path = f"{SKELETON}/{edit}"
    codes = FIRST + np.round(walk.motion.times * RATE)
    with usd.new_stage(
        output, frame_rate=RATE, first=float(codes[0]), last=float(codes[-1]), root="Walker"
    ) as stage:
        _author_walker(stage, walk, codes)
        if edit:
            usd.author_edit(stage, path, **of_edit)
        scenery(stage)
        for prop in props:
            usd.author_region(stage, prop, time_codes=codes)
        _author(stage, path, constraints, codes)
        # The one that is made last stays selected.
        for name in reversed(list(variants)):
            with usd.variant(stage, path, VARIANTS, name):
                _author(stage, path, variants[name], codes)
        for name in reversed(list(bodies)):
            with usd.variant(stage, SKELETON, BODIES, name):
                usd.author_body(stage, SKELETON, bodies[name])


def _author_walker(stage: Any, walk: Walk, codes: Floats) -> None:
    """Author who walks, and how."""
    ends = solids()
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


def _author(stage: Any, path: str, constraints: Sequence[Constraint], codes: Floats) -> None:
    """Author constraints under an edit, and the regions that they are about."""
    for each in constraints:
        if isinstance(each, RegionConstraint) and each.region is not None:
            usd.author_region(stage, each.region, time_codes=codes)
        usd.author(stage, f"{path}/{each.path.rsplit('/', 1)[-1]}", each, time_codes=codes)


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


def balance(planted: Sequence[PositionConstraint], *, priority: int) -> CenterOfMassConstraint:
    """Return the constraint that keeps the centre of mass over held points, along the ground."""
    return CenterOfMassConstraint(
        path="Balance",
        skeleton=SKELETON,
        priority=priority,
        supports=tuple(each.joint for each in planted),
        support_points=np.array([each.point for each in planted]),
        axes="xz",
    )


def seconds(frame: float) -> float:
    """Return the time of a frame of the stage [s]."""
    return (frame - FIRST) / RATE

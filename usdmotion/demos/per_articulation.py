"""2005, section 11: who of a chain moves first, and how readily; and an arm that keeps a balance.

The Skeleton has a variant for each body: as ever from the hand on, with a stiff arm, or the trunk
before the arm. The edit has a variant for each thing asked.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.constraints import (
    CenterOfMassConstraint,
    Constraint,
    Goal,
    PositionConstraint,
)
from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.performances import reach
from usdmotion.demos.walker import SKELETON, balance, feet, seconds, token, write_walk
from usdmotion.motion import Body

AHEAD = np.array((-0.20, 1.12, 0.50))
"""Where the right wrist is to be [m]: an arm can do it, and so can a back that bends."""
ASIDE = np.array((-0.52, 1.30, 0.34))
"""Where it is to be, so that the balance suffers [m]."""
FRAMES = (22.0, 40.0, 51.0, 69.0)
"""It leaves its trajectory, is there, leaves, is back."""
TRUNK = ("Spine", "Spine1", "Spine2")
ARM = ("RightShoulder", "RightArm", "RightForeArm", "RightHand")
OTHER_ARM = ("LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand")
STIFF = 0.9
"""How stiff the joints of a stiff arm are."""


def build(output: Path) -> None:
    """Write the stage."""
    reaching = reach()
    asked = {
        name: constraints(reaching, name) for name in ("ahead", "aside", "pelvis", "other_arm")
    }
    write_walk(
        output,
        reaching,
        "PerArticulation",
        [],
        asked,
        bodies=bodies(reaching),
        solver="ccd",
        options={"damping": 1.0},
    )


def bodies(reaching: Walk) -> dict[str, Body]:
    """Return what each variant of the Skeleton says."""
    count = len(reaching.skeleton.joints)
    arm = np.isin(np.arange(count), [reaching.joint(name) for name in ARM])
    unknown = Body.unknown(count)
    return {
        "usual": unknown,
        "stiff_arm": replace(unknown, stiffness=np.where(arm, STIFF, 0.0)),
        "locked_arm": replace(unknown, stiffness=np.where(arm, 1.0, 0.0)),
        "trunk_first": replace(unknown, priorities=np.where(arm, 1, 0)),
        "trunk_from_below": replace(unknown, priorities=_from_below(reaching)),
    }


def _from_below(reaching: Walk) -> np.ndarray:
    """Return priorities by which the back bends at the pelvis first, and the arm comes last."""
    priorities = np.full(len(reaching.skeleton.joints), len(TRUNK))
    for number, name in enumerate(TRUNK):
        priorities[reaching.joint(name)] = number
    return priorities


def constraints(reaching: Walk, name: str) -> Sequence[Constraint]:
    """Return what a variant of the edit asks for."""
    if name == "ahead":
        return [wrist(reaching, AHEAD, (*TRUNK, *ARM))]
    reached = wrist(reaching, ASIDE, ARM)
    if name == "aside":
        return [reached]
    standing = feet(reaching, priority=1)
    over_them = balance(standing, priority=2)
    if name == "pelvis":
        return [*standing, over_them, replace(reached, priority=3)]
    return [reached, _by_other_arm(reaching, over_them)]


def wrist(reaching: Walk, place: Floats, recruits: Sequence[str]) -> PositionConstraint:
    """Return the right wrist at a place for a while (1), by some joints alone."""
    return PositionConstraint(
        path="RightWrist",
        skeleton=SKELETON,
        joint=token(reaching, "RightHand"),
        recruits=tuple(token(reaching, name) for name in recruits),
        goals=(Goal(path="Place", translation=place, times=tuple(map(seconds, FRAMES))),),
    )


def _by_other_arm(reaching: Walk, over_feet: CenterOfMassConstraint) -> CenterOfMassConstraint:
    """Return the balance (2) that only the left arm may keep."""
    return replace(over_feet, recruits=tuple(token(reaching, name) for name in OTHER_ARM))


PICTURE = Figure(
    "2005, section 11: who of a chain moves first, and how readily",
    frames=(22.0, 31.0, 45.0, 60.0),
    views=("side",),
    answers=tuple(
        Answer(name.replace("_", " "), variant=name)
        for name in ("usual", "stiff_arm", "locked_arm", "trunk_first")
    ),
)

"""2005, figures 1 and 14: eight of different build fight in pairs, two teams, all at once.

The ones kick at the others' chests. The others ward it off with a forearm, and punch at the ones'
heads, who duck. All targets are on the opponent's joints, as they are now.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from usdmotion import usd
from usdmotion.constraints import (
    CenterOfMassConstraint,
    Constraint,
    ContactConstraint,
    DistanceConstraint,
    Goal,
    PositionConstraint,
)
from usdmotion.demos.fighters import Fighter, fighters
from usdmotion.demos.fighting import RATE
from usdmotion.demos.figures import Figure

FIRST = 1.0
"""Time code of the first frame."""
EDIT = "Fight"
"""Name of everybody's edit."""
CHEST = (0.115, -0.01, 0.135)
"""Where a kick is to go to in the frame of the upper trunk, as a share of that body's height."""
FACE = (0.0, -0.01, 0.185)
"""The same of a punch's wrist in the frame of the head: a fist before the chin."""
SKULL = (0.0, 0.025, 0.005)
"""The middle of a head in its frame, likewise."""
FIST, HEAD, MISS = 0.108, 0.05, 0.07
"""From a wrist to the end of the hand, and of the head's surface from its middle, as shares of the
heights; and what is to be between them at least [m]."""
STRUCK, WARDED, PUNCHED, DUCKED = (
    (0.50, 0.75, 1.08, 1.30),
    (0.66, 0.84, 0.97, 1.16),
    (1.46, 1.92, 1.96, 2.38),
    (1.46, 1.84, 2.06, 2.50),
)
"""When each is asked for, after the kick began, at pace 1 [s]: not before the gesture has begun."""
LIFTED, LANDED = (0.17, 0.30), (1.62, 1.76)
"""When the kicking foot leaves the ground, and when it is back, likewise."""
_WARDING = ("LeftForeArm", "LeftArm", "LeftShoulder")
_PUNCHING = ("RightForeArm", "RightArm", "RightShoulder")
_DUCKING = ("Head", "Neck", "Spine2", "Spine1", "Spine")
_COLORS = {True: (0.85, 0.85, 0.82), False: (0.72, 0.12, 0.10)}


def build(output: Path) -> None:
    """Write the stage.

    Args:
        output: The layer to write.
    """
    everybody = fighters()
    codes = FIRST + np.round(everybody[0].motion.times * RATE)
    last = float(codes[-1])
    with usd.new_stage(output, frame_rate=RATE, first=FIRST, last=last, root="Fight") as stage:
        for own in everybody:
            usd.author_character(
                stage,
                own.path.rpartition("/")[0],
                own.skeleton,
                own.body,
                own.motion,
                own.parts,
                time_codes=codes,
                tip_joints=np.array([each.joint for each in own.solids]),
                tip_points=np.array([each.end for each in own.solids]),
                color=_COLORS[own.attacks],
            )
        for own, other in _opponents(everybody):
            usd.author_edit(stage, f"{own.path}/{EDIT}", solver="ccd")
            for each in asked(own, other):
                usd.author(stage, f"{own.path}/{EDIT}/{each.path}", each, time_codes=codes)


def asked(own: Fighter, other: Fighter) -> list[Constraint]:
    """Return what is asked of somebody: feet that stand (1), balance (2), and the fight (3)."""
    balance = CenterOfMassConstraint(path="Balance", skeleton=own.path, priority=2, axes="xz")
    fight = (
        (kick(own, other), duck(own, other))
        if own.attacks
        else (
            ward(own, other),
            punch(own, other),
        )
    )
    return [*feet(own), balance, *fight]


def feet(own: Fighter) -> list[ContactConstraint]:
    """Return the contacts of the feet; one leaves the ground for the kick."""

    def stands(name: str, joint: str, times: tuple[float, ...] = ()) -> ContactConstraint:
        location, orientation = own.standing(joint)
        return ContactConstraint(
            path=name,
            skeleton=own.path,
            joint=own.token(joint),
            times=times,
            location=location,
            orientation=orientation,
            priority=1,
        )

    left = stands("LeftStands", "LeftFoot")
    if not own.attacks:
        return [left, stands("RightStands", "RightFoot")]
    last = float(own.motion.times[-1])
    before = (-0.2, -0.1, *own.bout.moments(*LIFTED))
    after = (*own.bout.moments(*LANDED), last + 0.1, last + 0.2)
    return [
        left,
        stands("RightStands", "RightFoot", before),
        stands("RightStandsAgain", "RightFoot", after),
    ]


def kick(own: Fighter, other: Fighter) -> PositionConstraint:
    """Return what brings the ankle to the other's chest."""
    return PositionConstraint(
        path="Kick",
        skeleton=own.path,
        joint=own.token("RightFoot"),
        priority=3,
        goals=(_at(other, "Spine1", CHEST, own.bout.moments(*STRUCK)),),
    )


def ward(own: Fighter, other: Fighter) -> PositionConstraint:
    """Return what brings the middle of the forearm to the other's ankle."""
    wrist = own.skeleton.rest_translations[own.skeleton.index[own.token("LeftHand")]]
    return PositionConstraint(
        path="Ward",
        skeleton=own.path,
        joint=own.token("LeftForeArm"),
        point=0.5 * wrist,
        recruits=tuple(map(own.token, _WARDING)),
        priority=3,
        goals=(_at(other, "RightFoot", (0.0, 0.0, 0.0), own.bout.moments(*WARDED)),),
    )


def punch(own: Fighter, other: Fighter) -> PositionConstraint:
    """Return what brings the fist to the other's head, as far as the arm goes."""
    return PositionConstraint(
        path="Punch",
        skeleton=own.path,
        joint=own.token("RightHand"),
        recruits=tuple(map(own.token, _PUNCHING)),
        priority=4,
        goals=(_at(other, "Head", FACE, own.bout.moments(*PUNCHED)),),
    )


def duck(own: Fighter, other: Fighter) -> DistanceConstraint:
    """Return what keeps the head away from the other's fist."""
    reach = FIST * other.build.height * other.build.proportions.arms
    return DistanceConstraint(
        path="Duck",
        skeleton=own.path,
        joint=own.token("Head"),
        recruits=tuple(map(own.token, _DUCKING)),
        point=own.build.height * np.array(SKULL),
        priority=4,
        other_skeleton=other.path,
        other_joint=other.token("RightHand"),
        distance=MISS + HEAD * own.build.height * own.build.proportions.head + reach,
        bound="atLeast",
        times=own.bout.moments(*DUCKED),
    )


def _at(other: Fighter, name: str, place: Sequence[float], times: tuple[float, ...]) -> Goal:
    """Return a goal in the frame of another's joint, given as a share of that body's height."""
    return Goal(
        path="Opponent",
        joint=(other.path, other.token(name)),
        translation=other.build.height * np.array(place),
        times=times,
    )


def _opponents(everybody: Sequence[Fighter]) -> list[tuple[Fighter, Fighter]]:
    return [(own, everybody[index ^ 1]) for index, own in enumerate(everybody)]


PICTURE = Figure(
    "2005, figures 1 and 14: kicks are warded off, punches are ducked",
    frames=(30.0, 56.0),
)

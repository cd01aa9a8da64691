"""The problems that the benchmarks measure: a walker reaches out, his feet and balance hold."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from usdmotion import Body, Character, Edit, Motion, Placement, Problem, Scene, Skeleton
from usdmotion.arrays import Floats
from usdmotion.constraints import CenterOfMassConstraint, Constraint, Goal, PositionConstraint
from usdmotion.demos.gait import Walk
from usdmotion.demos.walker import SKELETON, feet, token

WITHIN_REACH = np.array((0.15, 0.1, 0.1))
"""How far from its trajectory the wrist is to go [m]: outwards, up, ahead."""
OUT_OF_REACH = np.array((2.0, 0.1, 0.1))
"""The same where no posture on those feet gets there: legs and arm are stretched."""
SHARES = (0.4, 0.5, 0.55, 0.65)
"""When it leaves, is there, leaves, is back, as shares of the clip."""
LEAN = np.array((0.05, 0.0, 0.03))
"""What the whole body is moved by over its feet, where many points are held at once [m]."""


def character(walking: Walk) -> Character:
    """Return the walker, standing in the world itself."""
    space = Placement.identity(walking.motion.frame_count)
    return Character(SKELETON, walking.skeleton, walking.body, walking.motion, space, 0)


def scene(walking: Walk, constraints: Sequence[Constraint]) -> Scene:
    """Return the scene of one edit of a walker."""
    codes = np.arange(walking.motion.frame_count)
    edit = Edit(f"{SKELETON}/Edit", SKELETON, tuple(constraints))
    return Scene((character(walking),), (edit,), codes, np.array([0.0, 1.0, 0.0]))


def problem(walking: Walk, constraints: Sequence[Constraint]) -> Problem:
    """Return the problem of one edit of a walker."""
    return Problem.of(scene(walking, constraints))


def dragged(solved: Scene, offset: Floats) -> Scene:
    """Return the scene of `reaching_for` with the goal elsewhere; all else is the same object."""
    (edit,) = solved.edits
    *planted, wrist, center = edit.constraints
    (goal,) = wrist.goals
    there = replace(wrist, goals=(replace(goal, translation=offset),))
    return replace(solved, edits=(replace(edit, constraints=(*planted, there, center)),))


def reaching_for(walking: Walk, offset: Floats, frames: int) -> Scene:
    """Return the scene of `reaching` with a goal that has a part on so many frames."""
    middle, step = walking.motion.frame_count // 2, walking.motion.times[1]
    goal = Goal(
        mode="offset",
        translation=offset,
        times=tuple(step * (middle + frames * share) for share in (-0.5, -0.1, 0.1, 0.5)),
    )
    wrist = moved(walking, "LeftHand", offset, priority=2)
    wrist = replace(wrist, goals=(goal,))
    return scene(walking, [*feet(walking, priority=1), wrist, balance(priority=3)])


def reaching(walking: Walk, offset: Floats = WITHIN_REACH) -> Problem:
    """Return feet (12 rows), then a wrist (3), then the centre of mass (3), over all joints.

    The centre of mass keeps its own trajectory, so that every target is a point in the world.
    """
    wrist = moved(walking, "LeftHand", offset, priority=2)
    return problem(walking, [*feet(walking, priority=1), wrist, balance(priority=3)])


def four_levels(walking: Walk) -> Problem:
    """Return a foot, the other, the end of a stick in the hand, the centre of mass: 72 × 18."""
    holding = with_stick(walking)
    left, right = feet(holding, priority=1)[:2], feet(holding, priority=2)[2:]
    stick = moved(holding, "Stick", WITHIN_REACH, priority=3)
    return problem(holding, [*left, *right, stick, balance(priority=4)])


def twelve_points(walking: Walk) -> Problem:
    """Return feet, hands, elbows, trunk and centre of mass of a body that leans over: 72 × 36."""
    holding = with_stick(walking)
    arms = ("Stick", "LeftHand", "RightHand", "LeftForeArm", "RightForeArm")
    return problem(
        holding,
        [
            *feet(holding, priority=1),
            *(moved(holding, name, LEAN, priority=2) for name in arms),
            *(moved(holding, name, LEAN, priority=3) for name in ("Head", "Spine2")),
            balance(_away(walking, LEAN), priority=4),
        ],
    )


def moved(walking: Walk, name: str, offset: Floats, *, priority: int) -> PositionConstraint:
    """Return what brings a joint away from its trajectory for a while."""
    return PositionConstraint(
        path=name,
        skeleton=SKELETON,
        joint=token(walking, name),
        priority=priority,
        goals=(_away(walking, offset),),
    )


def balance(*goals: Goal, priority: int) -> CenterOfMassConstraint:
    """Return what keeps the centre of mass on its own trajectory, or beside it."""
    return CenterOfMassConstraint(path="Balance", skeleton=SKELETON, priority=priority, goals=goals)


def _away(walking: Walk, offset: Floats) -> Goal:
    last = float(walking.motion.times[-1])
    return Goal(mode="offset", translation=offset, times=tuple(last * share for share in SHARES))


def unlimited(walking: Walk) -> Walk:
    """Return the walker with joints that turn as far as they like."""
    free = np.full((len(walking.skeleton.joints), 3), np.inf)
    return replace(walking, body=replace(walking.body, limits_min=-free, limits_max=free))


def with_stick(walking: Walk) -> Walk:
    """Return the walker with one joint more, without a mass, at the end of the left hand."""
    skeleton, body, motion = walking.skeleton, walking.body, walking.motion
    hand, upright = walking.joint("LeftHand"), np.array((0.0, 0.0, 0.0, 1.0))
    place = np.array((0.1, 0.0, 0.0))
    frames = motion.frame_count
    free, nothing = np.full((1, 3), np.inf), np.zeros((1, 3))
    return replace(
        walking,
        skeleton=Skeleton(
            (*skeleton.joints, f"{skeleton.joints[hand]}/Stick"),
            np.append(skeleton.parents, hand),
            np.vstack((skeleton.rest_translations, place)),
            np.vstack((skeleton.rest_rotations, upright)),
        ),
        body=Body(
            np.append(body.masses, 0.0),
            np.vstack((body.mass_centers, nothing)),
            np.vstack((body.limits_min, -free)),
            np.vstack((body.limits_max, free)),
            np.append(body.stiffness, 0.0),
        ),
        motion=Motion(
            motion.times,
            np.concatenate((motion.translations, np.tile(place, (frames, 1, 1))), axis=1),
            np.concatenate((motion.rotations, np.tile(upright, (frames, 1, 1))), axis=1),
        ),
        parts=(*walking.parts, ""),
    )

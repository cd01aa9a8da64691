"""Contacts of feet as footprints, and as they are when these are on the ground."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeGuard

import numpy as np

from usdmotion import travelling
from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint, ContactConstraint
from usdmotion.constraints.space import Space
from usdmotion.humanoid import ANKLE
from usdmotion.kernels import chordal_mean, conjugate, multiply, rotate
from usdmotion.s4d import Footprint, Standing
from usdmotion.s4d.standing import Pose

_STILL = 1e-3
"""A ground that moves less than this under a foot is at rest [m]."""


def is_footprint(constraint: Constraint, character: Character) -> TypeGuard[ContactConstraint]:
    """Tell whether a constraint is a contact of a foot, held in place in the world."""
    return travelling.is_footprint(constraint, _part(constraint, character))


def staying(constraints: Sequence[Constraint], character: Character) -> tuple[str, ...]:
    """Return the paths of contacts in the world that hold on some frame, and are no footprints."""
    return tuple(
        each.path
        for each in constraints
        if isinstance(each, ContactConstraint)
        and each.space.joint is None
        and np.any(np.asarray(each.activity) > 0.0)
        and not is_footprint(each, character)
        and travelling.frames_of(each, character.motion.times).any()
    )


def footprint_of(contact: ContactConstraint, character: Character, pose: Pose) -> Footprint:
    """Return the footprint that a contact of a foot is.

    Args:
        contact: The contact.
        character: Whose foot it is.
        pose: Where its joints are in the world.
    """
    times, part = character.motion.times, _part(contact, character)
    held = travelling.frames_of(contact, times)
    facing = _mean(pose.rotations[held, character.skeleton.index[contact.joint]])
    return travelling.footprint_of(contact, part, times, facing)


def on_ground(
    contact: ContactConstraint, character: Character, before: Pose, after: Pose, standing: Standing
) -> ContactConstraint:
    """Return a contact of a foot with the ground as its space.

    What it holds is said in that space as it was in the world, or in the space that it had.

    Args:
        contact: As it is asked for.
        character: Whose foot it is.
        before: Where its joints were in the world.
        after: Where they are on the ground.
        standing: How they came there.
    """
    footprint = footprint_of(contact, character, before)
    times, space = character.motion.times, contact.space
    frames = np.flatnonzero(footprint.during(times))
    joint = character.skeleton.index[contact.joint]
    tread = standing.treads[footprint.part[0]]
    places, turns = after.positions[frames, joint], tread.sloped[frames]
    if footprint.part[2:] == ANKLE and footprint.rotation is not None:
        # It lies on the ground as far as the ankle can be bent.
        turns = multiply(after.rotations[frames, joint], conjugate(footprint.rotation))
    if np.ptp(tread.rises[frames]) < _STILL:
        places, turns = places.mean(axis=0), _mean(turns)
    else:
        nearest = np.clip(np.arange(len(times)), frames[0], frames[-1]) - frames[0]
        places, turns = places[nearest], turns[nearest]
    moved = places + rotate(turns, space.translation - footprint.place)
    return replace(contact, space=Space(moved, multiply(turns, space.rotation)))


def _part(constraint: Constraint, character: Character) -> str:
    index = character.skeleton.index.get(constraint.joint)
    return "" if index is None or character.parts is None else character.parts.parts[index]


def _mean(turns: Floats) -> Floats:
    return chordal_mean(turns, np.ones(len(turns)))

"""Contacts of feet as footprints, and as they are when these are on the ground."""

from dataclasses import replace
from typing import TypeGuard

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint, ContactConstraint
from usdmotion.constraints.space import Space
from usdmotion.kernels import chordal_mean, conjugate, multiply, rotate
from usdmotion.s4d import Footprint, Standing
from usdmotion.s4d.footprints import ANKLE, BALL
from usdmotion.s4d.legs import Pose

_HOLDING = ("space", "line", "point")
"""The kinds that hold a foot in place."""
_STILL = 1e-3
"""A ground that moves less than this under a foot is at rest [m]."""


def is_footprint(constraint: Constraint, character: Character) -> TypeGuard[ContactConstraint]:
    """Tell whether a constraint is a contact of a foot, held in place in the world."""
    return (
        isinstance(constraint, ContactConstraint)
        and constraint.kind in _HOLDING
        and _part(constraint, character)[2:] in (ANKLE, BALL)
        and _stays(constraint.space)
        and bool(np.any(np.asarray(constraint.activity) > 0.0))
    )


def holds(contact: ContactConstraint, character: Character) -> bool:
    """Tell whether a contact holds on any frame of a motion."""
    times = character.motion.times
    return bool(Footprint("", *_span(contact, times), np.zeros(3)).during(times).any())


def footprint_of(contact: ContactConstraint, character: Character, pose: Pose) -> Footprint:
    """Return the footprint that a contact of a foot is.

    Args:
        contact: The contact.
        character: Whose foot it is.
        pose: Where its joints are in the world.
    """
    times = character.motion.times
    start, end = _span(contact, times)
    part, joint = _part(contact, character), character.skeleton.index[contact.joint]
    space = contact.space
    location = space.translation + rotate(space.rotation, contact.location)
    rotation = None
    if contact.kind == "space":
        rotation = multiply(space.rotation, contact.orientation)
    held = Footprint(part, start, end, location).during(times)
    facing = _mean(pose.rotations[held, joint]) if rotation is None else rotation
    point = np.reshape(contact.point, (-1, 3)).mean(axis=0)
    return Footprint(part, start, end, location - rotate(facing, point), rotation)


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


def _stays(space: Space) -> bool:
    return space.joint is None and space.translation.ndim == 1 and space.rotation.ndim == 1


def _span(contact: ContactConstraint, times: Floats) -> tuple[float, float]:
    """Return the first and the last time at which a contact is fully on [s]."""
    keys = contact.times or (float(times[0]), float(times[-1]))
    return (keys[1], keys[2]) if len(keys) == 4 else (keys[0], keys[1])


def _mean(turns: Floats) -> Floats:
    return chordal_mean(turns, np.ones(len(turns)))

"""Where what is held is held: a robust place, and how far from it it gets."""

import math
from typing import NamedTuple

import numpy as np

from usdmotion import Contact, Floats, Ints, Search
from usdmotion.kernels import kernel, shared
from usdmotion.kernels.quaternions import quaternion_at, turned, vector_at
from usdmotion_contacts.displacements import SLACK
from usdmotion_contacts.merging import Groups

ROUNDS = 30
"""Most rounds in which a place settles."""
SETTLED = 1e-7
"""A place that moves by less in a round has settled [m]."""
NEAREST = 1e-9
"""What is nearer to a place weighs as if it were so far from it [m]."""


class _Held(NamedTuple):
    """What is held, in the object's frame, and what becomes of it, shapes (contact_count, …)."""

    points: Floats
    axes: Floats
    arm: float
    """How far along a line from its point it is looked at as well [m]."""
    locations: Floats
    orientations: Floats
    directions: Floats
    residuals: Floats


def settle(
    search: Search,
    kind: str,
    groups: Groups,
    left: Ints,
    owners: Ints,
    points: Floats,
    axes: Floats,
) -> list[Contact]:
    """Return some groups as contacts, but for those that are too short.

    The location has the least mean distance from where the point is on the frames that the group
    owns: some frames elsewhere, as at its ends, hardly move it. The orientation is the mean of a
    space, that at the start of others.

    Args:
        search: The motion.
        kind: What they are contacts of.
        groups: Their frames.
        left: Indices of the groups.
        owners: Which group each frame belongs to, shape (frame_count,).
        points: What each holds, in the object's frame [m], shape (group_count, 3).
        axes: The axis of each in it, shape (group_count, 3).
    """
    long = search.times[groups.end[left]] - search.times[groups.start[left]]
    left = left[long >= search.minimum - SLACK]
    size = np.ptp(search.points, axis=0).max() if kind == "line" else 0.0
    held = _Held(
        points[left], axes[left], 0.5 * float(size),
        np.zeros((len(left), 3)), np.zeros((len(left), 4)), np.zeros((len(left), 3)),
        np.zeros(len(left)),
    )  # fmt: skip
    start, end = groups.start[left], groups.end[left]
    _settle(search.translations, search.rotations, left, start, end, owners, held)
    turns = held.orientations if kind == "space" else search.rotations[start]
    return [
        Contact(
            kind=kind,
            start=float(search.times[start[i]]),
            end=float(search.times[end[i]]),
            point=held.points[i],
            location=held.locations[i] + search.translations[0],
            orientation=turns[i],
            **({"axis": held.directions[i]} if kind == "line" else {}),
            residual=float(held.residuals[i]),
        )
        for i in range(len(left))
    ]


@kernel
def _settle(
    translations: Floats,
    rotations: Floats,
    names: Ints,
    start: Ints,
    end: Ints,
    owners: Ints,
    held: _Held,
) -> None:
    """(F, 3), (F, 4), (C,), (C,), (C,), (F,) into `held`, whose places are from the first frame."""
    for contact in range(names.shape[0]):
        frames = (start[contact], end[contact], names[contact])
        _mean(translations, rotations, frames, owners, held, contact)
        for _ in range(ROUNDS):
            if not _nearer(translations, rotations, frames, owners, held, contact):
                break
        worst = 0.0
        for frame in range(start[contact], end[contact] + 1):
            worst = max(worst, _off(translations, rotations, held, contact, frame, held.arm))
            worst = max(worst, _off(translations, rotations, held, contact, frame, -held.arm))
        held.residuals[contact] = worst


@shared
def _mean(
    translations: Floats,
    rotations: Floats,
    frames: tuple[int, int, int],
    owners: Ints,
    held: _Held,
    contact: int,
) -> None:
    """Set place, orientation and direction to the means over the frames of a contact."""
    count = 0.0
    location, direction = held.locations[contact], held.directions[contact]
    orientation = held.orientations[contact]
    for frame in range(frames[0], frames[1] + 1):
        if owners[frame] != frames[2]:
            continue
        count += 1.0
        q = quaternion_at(rotations, frame)
        place = turned(q, vector_at(held.points, contact))
        axis = turned(q, vector_at(held.axes, contact))
        dot = 0.0
        for i in range(4):
            dot += orientation[i] * q[i]
        for i in range(3):
            location[i] += place[i] + translations[frame, i] - translations[0, i]
            direction[i] += axis[i]
        for i in range(4):
            orientation[i] += -q[i] if dot < 0.0 else q[i]
    for i in range(3):
        location[i] /= count
    _normalize(direction)
    _normalize(orientation)


@shared
def _normalize(vector: Floats) -> None:
    """Give a vector the length one, unless it is zero."""
    square = 0.0
    for i in range(vector.shape[0]):
        square += vector[i] ** 2
    if square > 0.0:
        for i in range(vector.shape[0]):
            vector[i] /= math.sqrt(square)


@shared
def _nearer(
    translations: Floats,
    rotations: Floats,
    frames: tuple[int, int, int],
    owners: Ints,
    held: _Held,
    contact: int,
) -> bool:
    """Move a place to the mean weighted by one over the distance (Weiszfeld); say if it moved."""
    weights = x = y = z = 0.0
    location = held.locations[contact]
    for frame in range(frames[0], frames[1] + 1):
        if owners[frame] != frames[2]:
            continue
        place = turned(quaternion_at(rotations, frame), vector_at(held.points, contact))
        far = _off(translations, rotations, held, contact, frame, 0.0)
        weight = 1.0 / max(far, NEAREST)
        weights += weight
        x += weight * (place[0] + translations[frame, 0] - translations[0, 0])
        y += weight * (place[1] + translations[frame, 1] - translations[0, 1])
        z += weight * (place[2] + translations[frame, 2] - translations[0, 2])
    x, y, z = x / weights, y / weights, z / weights
    moved = abs(x - location[0]) + abs(y - location[1]) + abs(z - location[2])
    location[0], location[1], location[2] = x, y, z
    return bool(moved > SETTLED)


@shared
def _off(
    translations: Floats, rotations: Floats, held: _Held, contact: int, frame: int, arm: float
) -> float:
    """Return how far what is held, or a place so far along its axis, is from where it is held."""
    axis, point = vector_at(held.axes, contact), vector_at(held.points, contact)
    there = (point[0] + arm * axis[0], point[1] + arm * axis[1], point[2] + arm * axis[2])
    place = turned(quaternion_at(rotations, frame), there)
    square = 0.0
    for i in range(3):
        target = held.locations[contact, i] + arm * held.directions[contact, i]
        square += (place[i] + translations[frame, i] - translations[0, i] - target) ** 2
    return math.sqrt(square)

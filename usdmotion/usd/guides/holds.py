"""Contacts as their prims say them now, whoever wrote them, in the world and in metres."""

from collections.abc import Mapping

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.curves import plateau
from usdmotion.errors import SceneError
from usdmotion.guides import ContactMark, Held
from usdmotion.kernels import multiply, rotate
from usdmotion.usd.detections.contact_prims import says_where
from usdmotion.usd.detections.entries import SAMPLE
from usdmotion.usd.detections.trajectories import Trajectory
from usdmotion.usd.relations import floats, target, value
from usdmotion.usd.shot import Facts
from usdmotion.usd.transforms import rigid, world_matrices

PALE = 0.35
"""Opacity of a contact that is not on; all are seen at all times, as the moments of a motion."""


def read_held(
    prim: Usd.Prim, trajectory: Trajectory, facts: Facts, *, is_foot: bool = False
) -> Held:
    """Return a contact and how its object moves meanwhile.

    Args:
        prim: The contact.
        trajectory: How the object moves.
        facts: Units and rates of the stage.
        is_foot: Whether the object is the ankle or the ball of a foot.
    """
    first, start, end, last = key_times(prim, trajectory)
    middle = trajectory.frame(0.5 * (start + end))
    codes = trajectory.time_codes
    during = (codes >= start - SAMPLE) & (codes <= end + SAMPLE)
    during[middle] = True
    eased = during | ((codes >= first - SAMPLE) & (codes <= last + SAMPLE))
    point = np.array(value(prim, "usdmotion:point", (0.0, 0.0, 0.0)))
    point = point * trajectory.units_at(codes[middle])
    location, orientation, axis = _place(prim, trajectory, middle, point, facts)
    return Held(
        kind=str(value(prim, "usdmotion:kind", "space")),
        point=point,
        location=location,
        orientation=orientation,
        axis=axis,
        translations=trajectory.translations[during],
        rotations=trajectory.rotations[during],
        way=trajectory.translations[eased],
        is_foot=is_foot,
        ground=trajectory.ground,
    )


def opacity_of(mark: ContactMark, facts: Facts) -> Mapping[float, float] | float:
    """Return how opaque a contact is: wholly while it is on, pale otherwise.

    Args:
        mark: The contact.
        facts: Rates of the stage.
    """
    if mark.always:
        return 1.0
    frame = facts.time_codes_per_second / facts.frames_per_second
    before = mark.first if mark.first < mark.start else mark.start - frame
    after = mark.last if mark.last > mark.end else mark.end + frame
    return {before: PALE, mark.start: 1.0, mark.end: 1.0, after: PALE}


def key_times(prim: Usd.Prim, trajectory: Trajectory) -> tuple[float, float, float, float]:
    """Return when a contact begins to ease in, is fully on, begins to ease out, and is off."""
    times = floats(value(prim, "usdmotion:times", ()))
    span = float(trajectory.time_codes[0]), float(trajectory.time_codes[-1])
    start, end = plateau(times, span)
    return (times[0], start, end, times[-1]) if times else (start, start, end, end)


def _place(
    prim: Usd.Prim, trajectory: Trajectory, frame: int, point: Floats, facts: Facts
) -> tuple[Floats, Floats, Floats]:
    """Return location, orientation and axis of a contact in the world."""
    own = np.array(value(prim, "usdmotion:axis", (0.0, 0.0, 1.0)), dtype=np.float64)
    try:
        origin, turn, scale = _space(prim, trajectory.time_codes[frame])
    except SceneError:
        origin, turn, scale = np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), np.ones(3)
        there = False
    else:
        there = says_where(prim)
    axis = rotate(turn, own)
    if not there:
        rotation = trajectory.rotations[frame]
        return trajectory.translations[frame] + rotate(rotation, point), rotation, axis
    location = np.array(value(prim, "usdmotion:location", (0.0, 0.0, 0.0)))
    held = value(prim, "usdmotion:orientation")
    orientation = np.array([*held.GetImaginary(), held.GetReal()])
    place = (origin + rotate(turn, scale * location)) * facts.meters_per_unit
    return place, multiply(turn, orientation), axis


def _space(prim: Usd.Prim, code: float) -> tuple[Floats, Floats, Floats]:
    """Return translation, rotation and scales of the frame that a contact is given in.

    Raises:
        SceneError: It is sheared or mirrored.
    """
    space = target(prim, "usdmotion:space") or prim.GetParent()
    matrices = world_matrices(space, np.array([code]))
    translations, rotations, scales = rigid(matrices, f"<{space.GetPath()}>")
    return translations[0], rotations[0], scales[0]

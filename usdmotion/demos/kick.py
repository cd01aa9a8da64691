"""A front kick out of a standing guard, made of poses, on a foot that really stands still.

Where the pelvis, the kicking ankle, the trunk and the arms are at some moments is chosen by eye;
curves that never overshoot (PCHIP) go through them, and each leg is bent to reach its foot.
"""

import numpy as np
from scipy.interpolate import PchipInterpolator

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid, sole
from usdmotion.demos.gait import Stance, Walk
from usdmotion.demos.gait.pelvis import about, hip_offset
from usdmotion.demos.gait.posture import local_rotations, two_segments
from usdmotion.kernels import from_vector, multiply, rotate, to_vector
from usdmotion.motion import Motion

HEIGHT = 1.7
"""Of the body [m]."""
RATE = 24.0
"""Frames per second."""
LENGTH = 3.0
"""How long it is [s]."""
_ANKLE_HEIGHT = 0.0663
_STANDING = np.array((0.08, _ANKLE_HEIGHT, 0.12))
_TOES_OUT = {"Left": 15.0, "Right": -20.0}

# Columns: moment [s]; then what the name says, metres or degrees. The world's axes: +X is left,
# +Z ahead.
_PELVIS = (
    (0.0, -0.010, 0.885, -0.02),
    (0.2, -0.010, 0.885, -0.02),
    (0.8, 0.050, 0.880, 0.08),
    (1.3, 0.055, 0.890, 0.13),
    (1.5, 0.055, 0.890, 0.13),
    (2.0, 0.050, 0.875, 0.09),
    (2.8, -0.010, 0.885, -0.02),
    (3.0, -0.010, 0.885, -0.02),
)
_KICKING = (
    (0.0, -0.09, _ANKLE_HEIGHT, -0.16),
    (0.6, -0.09, _ANKLE_HEIGHT, -0.16),
    (0.8, -0.085, 0.20, -0.14),
    (1.08, -0.07, 0.56, 0.28),
    (1.36, -0.03, 0.92, 0.87),
    (1.44, -0.03, 0.92, 0.87),
    (1.76, -0.07, 0.50, 0.32),
    (2.08, -0.085, 0.19, -0.08),
    (2.36, -0.09, _ANKLE_HEIGHT, -0.16),
    (3.0, -0.09, _ANKLE_HEIGHT, -0.16),
)
_ANGLES = (
    # moment, pelvis: forward, left; chest: forward, left; kicking foot: toes down; elbows
    (0.0, 4.0, -25.0, 6.0, -30.0, 0.0, 110.0),
    (0.6, 5.0, -20.0, 6.0, -26.0, 0.0, 110.0),
    (0.8, 2.0, -12.0, 5.0, -22.0, 25.0, 110.0),
    (1.08, -8.0, 4.0, 0.0, -12.0, 15.0, 105.0),
    (1.36, -16.0, 18.0, -9.0, -8.0, -45.0, 90.0),
    (1.44, -16.0, 18.0, -9.0, -8.0, -45.0, 90.0),
    (1.76, -7.0, 2.0, 2.0, -14.0, 10.0, 105.0),
    (2.08, 2.0, -14.0, 7.0, -24.0, 22.0, 110.0),
    (2.36, 5.0, -20.0, 7.0, -27.0, 0.0, 110.0),
    (3.0, 4.0, -25.0, 6.0, -30.0, 0.0, 110.0),
)


def kick() -> Walk:
    """Return a front kick with the right foot; the left one stands."""
    times = np.arange(round(LENGTH * RATE) + 1) / RATE
    angles = _through(_ANGLES, times)
    return _performed(times, _through(_PELVIS, times), _through(_KICKING, times), angles)


def guard(ankle: Floats, pitch: Floats) -> Walk:
    """Return the guard out of which it kicks, while the right foot does something else.

    Args:
        ankle: Where the ankle goes from the place where it stands [m], shape (frame_count, 3).
        pitch: How far the toes are turned down [degrees], shape (frame_count,).
    """
    times = np.arange(len(ankle)) / RATE
    still = np.zeros_like(times)
    angles = _through(_ANGLES, still)
    angles[:, 4] = pitch
    return _performed(times, _through(_PELVIS, still), _through(_KICKING, still) + ankle, angles)


def turned_foot(pitch: Floats) -> Floats:
    """(F,) to (F, 4): the right foot with its toes turned down by some degrees."""
    heading = about(1, np.full_like(pitch, _TOES_OUT["Right"]))
    return multiply(heading, about(0, pitch))


def _performed(times: Floats, pelvis: Floats, ankle: Floats, angles: Floats) -> Walk:
    """(F,), (F, 3), (F, 3), (F, 6) to somebody on the left foot."""
    skeleton, body, parts = humanoid(HEIGHT)
    translations = np.tile(skeleton.rest_translations, (len(times), 1, 1))
    translations[:, 0] = pelvis
    rotations = local_rotations(_world_rotations(pelvis, ankle, angles.T))
    soles = sole(HEIGHT)
    stances = tuple(
        Stance("Left", effector, token, 0.0, float(times[-1]))
        for effector, name in (("heel", "LeftFoot"), ("toe", "LeftToeBase"))
        for token in skeleton.joints
        if token.endswith(f"/{name}")
    )
    motion = Motion(times, translations, rotations)
    return Walk(motion, skeleton, body, parts, soles.heel, soles.ball, stances)


def _through(table: tuple[tuple[float, ...], ...], times: Floats) -> Floats:
    """(F,) to (F, C): the curves through the rows of a table, whose first column is the moment."""
    rows = np.array(table)
    return np.asarray(PchipInterpolator(rows[:, 0], rows[:, 1:])(times))


def _world_rotations(pelvis: Floats, ankle: Floats, angles: Floats) -> dict[str, Floats]:
    """Return the world orientation of every joint by its name, each of shape (F, 4)."""
    hips = multiply(about(1, angles[1]), about(0, angles[0]))
    chest = multiply(about(1, angles[3]), about(0, angles[2]))
    low, high = to_vector(hips), to_vector(chest)
    rotations = {
        "Hips": hips,
        "Spine": from_vector(low + (high - low) / 3.0),
        "Spine1": from_vector(low + (high - low) * (2.0 / 3.0)),
        "Spine2": chest,
        "Neck": from_vector(0.5 * high),
        "Head": from_vector(0.0 * high),
    }
    standing = np.broadcast_to(_STANDING, ankle.shape)
    for name, side, foot, pitch in (
        ("Left", 1, standing, np.zeros(len(ankle))),
        ("Right", -1, ankle, angles[4]),
    ):
        rotations |= _arm(chest, angles[5], name, side)
        hip = pelvis + rotate(hips, HEIGHT * hip_offset(side))
        rotations |= leg((foot - hip) / HEIGHT, pitch, name)
    return rotations


def _arm(chest: Floats, bend: Floats, name: str, side: int) -> dict[str, Floats]:
    """Return an arm in guard, its elbow bent by some degrees."""
    hang = multiply(about(0, np.full_like(bend, -25.0)), about(2, np.full_like(bend, -side * 75.0)))
    upper = multiply(chest, hang)
    fore = multiply(upper, about(1, -side * bend))
    return {
        f"{name}Shoulder": chest,
        f"{name}Arm": upper,
        f"{name}ForeArm": fore,
        f"{name}Hand": fore,
    }


def leg(way: Floats, pitch: Floats, name: str) -> dict[str, Floats]:
    """Return a leg that spans a way, lengths as fractions of the height, and its foot."""
    heading = about(1, np.full_like(pitch, _TOES_OUT[name]))
    # Ahead and up: a leg may be level here, and its knee still knows where to point.
    thigh, shank = two_segments(way, rotate(heading, np.array((0.0, 0.7, 0.7))))
    foot = multiply(heading, about(0, pitch))
    return {
        f"{name}UpLeg": thigh,
        f"{name}Leg": shank,
        f"{name}Foot": foot,
        f"{name}ToeBase": foot,
    }

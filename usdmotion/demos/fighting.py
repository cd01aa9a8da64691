"""The four motions that fighters know: a guard, a kick, a ward with a punch after it, a duck.

Made of poses on the usual body, as the kick is; each begins and ends in the guard. Where pelvis,
trunk, kicking ankle and wrists are at some moments is chosen by eye; curves that never overshoot
(PCHIP) go through them, and limbs are bent to reach. The left foot stands all the time.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid
from usdmotion.demos.gait.pelvis import about, hip_offset
from usdmotion.demos.gait.posture import local_rotations
from usdmotion.demos.kick import leg
from usdmotion.kernels import from_vector, multiply, rotate, to_vector
from usdmotion.motion import Motion

HEIGHT = 1.7
"""Of the body that knows them [m]."""
RATE = 24.0
"""Frames per second."""
_ANKLE_HEIGHT = 0.0663
_LEFT_STANDS = np.array((0.08, _ANKLE_HEIGHT, 0.12))
_RIGHT_STANDS = (-0.09, _ANKLE_HEIGHT, -0.16)
_ELBOWS = np.array((0.45, -1.0, -0.35))
"""Where elbows point, in the chest's frame: out, up, ahead."""

Table = tuple[tuple[float, ...], ...]
"""Rows of a moment [s] and values."""


@dataclass(frozen=True)
class Gesture:
    """What a motion is made of; the world's axes: +X is left, +Z ahead."""

    pelvis: Table
    """Place [m]."""
    trunk: Table
    """Pelvis: forward, left; chest: forward, left; head: forward [degrees]."""
    right_ankle: Table
    """Place [m], toes down [degrees]."""
    left_wrist: Table
    """From its shoulder: outwards, up, ahead of the chest, in lengths of the arm."""
    right_wrist: Table
    """The same."""

    @property
    def length(self) -> float:
        """How long it is [s]."""
        return self.pelvis[-1][0]


_PELVIS = (-0.010, 0.885, -0.02)
_TRUNK = (4.0, -25.0, 6.0, -30.0, 2.0)
_RIGHT_ANKLE = (*_RIGHT_STANDS, 0.0)
_LEFT_WRIST = (-0.18, -0.02, 0.62)
_RIGHT_WRIST = (-0.38, -0.06, 0.42)

GUARD = Gesture(
    pelvis=(
        (0.0, *_PELVIS),
        (0.3, 0.000, 0.878, -0.015),
        (0.6, *_PELVIS),
        (0.9, 0.000, 0.878, -0.015),
        (1.2, *_PELVIS),
    ),
    trunk=((0.0, *_TRUNK), (0.6, 4.0, -24.0, 7.0, -28.0, 1.0), (1.2, *_TRUNK)),
    right_ankle=((0.0, *_RIGHT_ANKLE), (1.2, *_RIGHT_ANKLE)),
    left_wrist=((0.0, *_LEFT_WRIST), (0.6, -0.16, -0.05, 0.60), (1.2, *_LEFT_WRIST)),
    right_wrist=((0.0, *_RIGHT_WRIST), (0.6, -0.37, -0.08, 0.42), (1.2, *_RIGHT_WRIST)),
)
KICK = Gesture(
    pelvis=(
        (0.0, *_PELVIS),
        (0.40, 0.050, 0.880, 0.06),
        (0.80, 0.055, 0.890, 0.12),
        (0.95, 0.055, 0.890, 0.12),
        (1.35, 0.050, 0.875, 0.08),
        (1.9, *_PELVIS),
    ),
    trunk=(
        (0.0, *_TRUNK),
        (0.35, 2.0, -12.0, 5.0, -22.0, 2.0),
        (0.60, -8.0, 4.0, 0.0, -12.0, 2.0),
        (0.82, -14.0, 16.0, -8.0, -8.0, 4.0),
        (0.92, -14.0, 16.0, -8.0, -8.0, 4.0),
        (1.15, -7.0, 2.0, 2.0, -14.0, 4.0),
        (1.45, 3.0, -16.0, 7.0, -25.0, 2.0),
        (1.9, *_TRUNK),
    ),
    right_ankle=(
        (0.0, *_RIGHT_ANKLE),
        (0.22, *_RIGHT_ANKLE),
        (0.36, -0.085, 0.20, -0.13, 25.0),
        (0.60, -0.070, 0.60, 0.22, 15.0),
        (0.82, -0.030, 0.95, 0.72, -45.0),
        (0.92, -0.030, 0.95, 0.72, -45.0),
        (1.12, -0.070, 0.52, 0.28, 10.0),
        (1.36, -0.085, 0.19, -0.08, 22.0),
        (1.60, *_RIGHT_ANKLE),
        (1.9, *_RIGHT_ANKLE),
    ),
    left_wrist=(
        (0.0, *_LEFT_WRIST),
        (0.6, -0.05, -0.10, 0.60),
        (0.87, 0.15, -0.30, 0.50),
        (1.3, -0.10, -0.08, 0.60),
        (1.9, *_LEFT_WRIST),
    ),
    right_wrist=(
        (0.0, *_RIGHT_WRIST),
        (0.6, -0.20, -0.25, 0.38),
        (0.87, 0.05, -0.55, 0.20),
        (1.3, -0.30, -0.15, 0.40),
        (1.9, *_RIGHT_WRIST),
    ),
)
WARD_AND_PUNCH = Gesture(
    pelvis=(
        (0.0, *_PELVIS),
        (0.45, -0.020, 0.872, -0.05),
        (0.70, -0.020, 0.870, -0.05),
        (1.05, 0.015, 0.860, 0.15),
        (1.17, 0.015, 0.860, 0.15),
        (1.9, *_PELVIS),
    ),
    trunk=(
        (0.0, *_TRUNK),
        (0.45, 6.0, -30.0, 12.0, -42.0, 0.0),
        (0.70, 6.0, -28.0, 12.0, -34.0, 0.0),
        (1.05, 10.0, 10.0, 20.0, 38.0, -8.0),
        (1.17, 10.0, 10.0, 20.0, 38.0, -8.0),
        (1.9, *_TRUNK),
    ),
    right_ankle=(
        (0.0, *_RIGHT_ANKLE),
        (0.75, *_RIGHT_ANKLE),
        (1.05, *_RIGHT_STANDS, 0.0),
        (1.9, *_RIGHT_ANKLE),
    ),
    left_wrist=(
        (0.0, *_LEFT_WRIST),
        (0.22, -0.50, -0.05, 0.50),
        (0.45, -0.42, -0.58, 0.56),
        (0.70, -0.12, -0.62, 0.58),
        (1.05, -0.15, -0.12, 0.40),
        (1.17, -0.15, -0.10, 0.40),
        (1.9, *_LEFT_WRIST),
    ),
    right_wrist=(
        (0.0, *_RIGHT_WRIST),
        (0.45, -0.20, -0.25, 0.20),
        (0.78, -0.15, -0.20, 0.22),
        (1.05, -0.15, 0.32, 0.80),
        (1.17, -0.15, 0.32, 0.80),
        (1.45, -0.25, -0.02, 0.45),
        (1.9, *_RIGHT_WRIST),
    ),
)
DUCK = Gesture(
    pelvis=(
        (0.0, *_PELVIS),
        (0.38, -0.015, 0.855, -0.11),
        (0.62, -0.015, 0.855, -0.11),
        (1.25, *_PELVIS),
    ),
    trunk=(
        (0.0, *_TRUNK),
        (0.38, -12.0, -22.0, -31.0, -22.0, -14.0),
        (0.62, -12.0, -22.0, -31.0, -22.0, -14.0),
        (1.25, *_TRUNK),
    ),
    right_ankle=((0.0, *_RIGHT_ANKLE), (1.25, *_RIGHT_ANKLE)),
    left_wrist=(
        (0.0, *_LEFT_WRIST),
        (0.38, -0.25, 0.10, 0.50),
        (0.62, -0.25, 0.10, 0.50),
        (1.25, *_LEFT_WRIST),
    ),
    right_wrist=(
        (0.0, *_RIGHT_WRIST),
        (0.38, -0.30, 0.05, 0.40),
        (0.62, -0.30, 0.05, 0.40),
        (1.25, *_RIGHT_WRIST),
    ),
)
GESTURES: Mapping[str, Gesture] = {
    "guard": GUARD,
    "kick": KICK,
    "ward_and_punch": WARD_AND_PUNCH,
    "duck": DUCK,
}
"""All that they know."""


def performed(gesture: Gesture) -> Motion:
    """Return a gesture on the usual body."""
    times = np.arange(round(gesture.length * RATE) + 1) / RATE
    skeleton, _, _ = humanoid(HEIGHT)
    translations = np.tile(skeleton.rest_translations, (len(times), 1, 1))
    translations[:, 0] = _through(gesture.pelvis, times)
    return Motion(times, translations, local_rotations(_world_rotations(gesture, times)))


def _through(table: Table, times: Floats) -> Floats:
    """(F,) to (F, C): the curves through the rows of a table, whose first column is the moment."""
    rows = np.array(table)
    return np.asarray(PchipInterpolator(rows[:, 0], rows[:, 1:])(np.minimum(times, rows[-1, 0])))


def _world_rotations(gesture: Gesture, times: Floats) -> dict[str, Floats]:
    """Return the world orientation of every joint by its name, each of shape (F, 4)."""
    angles = _through(gesture.trunk, times).T
    hips = multiply(about(1, angles[1]), about(0, angles[0]))
    chest = multiply(about(1, angles[3]), about(0, angles[2]))
    low, high, head = to_vector(hips), to_vector(chest), np.radians(angles[4])[:, None] * (1, 0, 0)
    rotations = {
        "Hips": hips,
        "Spine": from_vector(low + (high - low) / 3.0),
        "Spine1": from_vector(low + (high - low) * (2.0 / 3.0)),
        "Spine2": chest,
        "Neck": from_vector(0.5 * (high + head)),
        "Head": from_vector(head),
    }
    for name, side, wrist in (("Left", 1, gesture.left_wrist), ("Right", -1, gesture.right_wrist)):
        rotations |= _arm(chest, _through(wrist, times), name, side)
    pelvis, ankle = _through(gesture.pelvis, times), _through(gesture.right_ankle, times)
    for name, side, foot, pitch in (
        ("Left", 1, _LEFT_STANDS, np.zeros(len(times))),
        ("Right", -1, ankle[:, :3], ankle[:, 3]),
    ):
        hip = pelvis + rotate(hips, HEIGHT * hip_offset(side))
        rotations |= leg((foot - hip) / HEIGHT, pitch, name)
    return rotations


def _arm(chest: Floats, wrist: Floats, name: str, side: int) -> dict[str, Floats]:
    """Return an arm whose wrist is somewhere, in lengths of the arm out, up and ahead.

    Law of cosines; the hinge of the elbow is the y axis of both segments.
    """
    skeleton, _, _ = humanoid(1.0)
    names = [token.rsplit("/", 1)[-1] for token in skeleton.joints]
    upper, lower = (
        float(np.linalg.norm(skeleton.rest_translations[names.index(f"{name}{part}")]))
        for part in ("ForeArm", "Hand")
    )
    mirror = np.array((side, 1.0, 1.0))
    way = wrist * mirror * (upper + lower)
    distance = np.linalg.norm(way, axis=1, keepdims=True)
    ahead = way / distance
    aside = _ELBOWS * mirror
    aside = aside - np.sum(aside * ahead, axis=1, keepdims=True) * ahead
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    along = (upper**2 - lower**2 + distance**2) / (2.0 * distance)
    elbow = along * ahead + np.sqrt(upper**2 - along**2) * aside
    first, second = elbow / upper, (way - elbow) / lower
    bent = second - np.sum(first * second, axis=1, keepdims=True) * first
    bent /= np.linalg.norm(bent, axis=1, keepdims=True)
    segments = [
        multiply(chest, _frame(side * along, np.cross(bent, side * first)))
        for along in (first, second)
    ]
    return {
        f"{name}Shoulder": chest,
        f"{name}Arm": segments[0],
        f"{name}ForeArm": segments[1],
        f"{name}Hand": segments[1],
    }


def _frame(x: Floats, y: Floats) -> Floats:
    """(F, 3), (F, 3) to (F, 4): the frames with these axes, at right angles to each other."""
    columns = np.stack([x, y, np.cross(x, y)], axis=-1)
    return np.asarray(Rotation.from_matrix(columns).as_quat())

"""One pose at any phase of the walk: legs from hips and feet, trunk and arms around the pelvis.

Lengths are fractions of the body's height; phases are those of the left leg.
"""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid
from usdmotion.demos.gait.pelvis import (
    about,
    hip_position,
    leg_lengths,
    pelvis_ride,
    pelvis_rotation,
)
from usdmotion.demos.gait.stance import TOE_OUT, pitch, toe_pitch
from usdmotion.demos.gait.stride import ankle_position
from usdmotion.kernels import conjugate, from_vector, multiply, rotate, to_vector

# Mean and amplitude [degrees], and what part of a cycle it comes after the leg of the other side.
# Upper arm: about 24 degrees back to 8 ahead (Murray, Sepic & Barnard 1967). The rest is by eye.
_ARM_MEAN, _ARM_SWING, _ARM_LAG = -8.0, 15.0, 0.03
_ELBOW_MEAN, _ELBOW_SWING, _ELBOW_LAG = 24.0, 10.0, 0.07
_ARM_ASIDE = 7.0
_CHEST_LEAN, _CHEST_ROLL, _CHEST_TURN = 2.5, 1.0, 3.5
"""Forward, towards the standing leg, against the pelvis [degrees]."""


def world_rotations(phase: Floats) -> dict[str, Floats]:
    """Return the world orientation of every joint by its name, each of shape (…, 4)."""
    rotations = {"Hips": pelvis_rotation(phase)}
    rotations |= _trunk(phase, rotations["Hips"])
    for name, side in (("Left", 1), ("Right", -1)):
        own_phase = phase if side > 0 else phase + 0.5
        rotations |= _arm(own_phase, rotations["Spine2"], name, side)
        rotations |= _leg(phase, name, side)
    return rotations


def local_rotations(world: dict[str, Floats]) -> Floats:
    """Return the rotation of every joint in its parent's frame, shape (…, joint_count, 4)."""
    skeleton, _, _ = humanoid(1.0)
    names = [token.rsplit("/", 1)[-1] for token in skeleton.joints]
    locals_ = []
    for name, parent in zip(names, skeleton.parents, strict=True):
        turn = world[name]
        if parent >= 0:
            turn = multiply(conjugate(world[names[parent]]), turn)
        locals_.append(np.where(turn[..., 3:] < 0.0, -turn, turn))
    return np.stack(locals_, axis=-2)


def _trunk(phase: Floats, pelvis: Floats) -> dict[str, Floats]:
    """Return spine, neck and head: the chest turns against the pelvis, the head looks ahead."""
    turn = 2.0 * np.pi * phase
    chest = multiply(
        about(1, _CHEST_TURN * np.cos(turn)),
        multiply(about(2, -_CHEST_ROLL * np.sin(turn)), about(0, np.full_like(turn, _CHEST_LEAN))),
    )
    low, high = to_vector(pelvis), to_vector(chest)
    return {
        "Spine": from_vector(low + (high - low) / 3.0),
        "Spine1": from_vector(low + (high - low) * (2.0 / 3.0)),
        "Spine2": chest,
        "Neck": from_vector(0.5 * high),
        "Head": from_vector(0.0 * high),
    }


def _arm(own_phase: Floats, chest: Floats, name: str, side: int) -> dict[str, Floats]:
    """Return an arm that hangs and swings; its phase is that of the leg of the same side."""
    swing = _ARM_MEAN - _ARM_SWING * np.cos(2.0 * np.pi * (own_phase - _ARM_LAG))
    bend = _ELBOW_MEAN - _ELBOW_SWING * np.cos(2.0 * np.pi * (own_phase - _ELBOW_LAG))
    hang = about(2, np.full_like(swing, -side * (90.0 - _ARM_ASIDE)))
    upper = multiply(chest, multiply(about(0, -swing), hang))
    fore = multiply(upper, about(1, -side * bend))
    return {
        f"{name}Shoulder": chest,
        f"{name}Arm": upper,
        f"{name}ForeArm": fore,
        f"{name}Hand": fore,
    }


def _leg(phase: Floats, name: str, side: int) -> dict[str, Floats]:
    """Return a leg that reaches from its hip to its planted or swinging foot."""
    own_phase = phase if side > 0 else phase + 0.5
    ankle = ankle_position(own_phase) * np.array((side, 1.0, 1.0))
    if side < 0:
        ankle[..., 2] -= 0.5 * pelvis_ride().stride
    heading = about(1, np.full_like(phase, side * TOE_OUT))
    ahead = rotate(heading, np.array((0.0, 0.0, 1.0)))
    thigh, shank = two_segments(ankle - hip_position(phase, side), ahead)
    foot = multiply(heading, about(0, -np.degrees(pitch(own_phase))))
    toes = multiply(heading, about(0, -np.degrees(toe_pitch(own_phase))))
    return {
        f"{name}UpLeg": thigh,
        f"{name}Leg": shank,
        f"{name}Foot": foot,
        f"{name}ToeBase": toes,
    }


def two_segments(way: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """(…, 3), (…, 3) to (…, 4), (…, 4): thigh and shank that span a way, the knee pointing ahead.

    Law of cosines: 2 a d cos(hip) = a² + d² - b² and 2 a b cos(knee) = d² - a² - b².
    """
    upper, lower = leg_lengths()
    square = np.sum(way**2, axis=-1)
    distance = np.sqrt(square)
    at_hip = np.arccos((upper**2 + square - lower**2) / (2.0 * upper * distance))
    at_knee = np.arccos((square - upper**2 - lower**2) / (2.0 * upper * lower))
    frame = _frame(-way / distance[..., None], ahead)
    thigh = multiply(frame, about(0, -np.degrees(at_hip)))
    return thigh, multiply(thigh, about(0, np.degrees(at_knee)))


def _frame(up: Floats, ahead: Floats) -> Floats:
    """(…, 3), (…, 3) to (…, 4): the frame with its y along up, and its z as far ahead as can be.

    No way of a leg is ever turned by half a turn, so w is safely above zero.
    """
    x = np.cross(up, ahead)
    x /= np.linalg.norm(x, axis=-1, keepdims=True)
    z = np.cross(x, up)
    w = 0.5 * np.sqrt(1.0 + x[..., 0] + up[..., 1] + z[..., 2])
    vector = np.stack([up[..., 2] - z[..., 1], z[..., 0] - x[..., 2], x[..., 1] - up[..., 0]], -1)
    return np.concatenate([vector / (4.0 * w[..., None]), w[..., None]], axis=-1)

"""Forward kinematics: local transforms of joints to world transforms."""

import numpy as np

from usdmotion.arrays import Floats, Ints
from usdmotion.kernels.compiling import kernel, shared
from usdmotion.kernels.quaternions import product, quaternion_at, turned, unit, vector_at
from usdmotion.kernels.rotations import conjugate, multiply, rotate


def forward(parents: Ints, translations: Floats, rotations: Floats) -> tuple[Floats, Floats]:
    """(J,), (F, J, 3), (F, J, 4) to (F, J, 3), (F, J, 4): world positions and orientations."""
    positions = np.empty(translations.shape)
    orientations = np.empty(rotations.shape)
    _forward(parents, translations, rotations, positions, orientations)
    return positions, orientations


def world_points(positions: Floats, orientations: Floats, points: Floats) -> Floats:
    """(…, 3), (…, 4), (…, 3) to (…, 3): points fixed to joints, in the world."""
    return positions + rotate(orientations, points)


def relative(
    position_a: Floats, orientation_a: Floats, position_b: Floats, orientation_b: Floats
) -> tuple[Floats, Floats]:
    """(…, 3), (…, 4), (…, 3), (…, 4) to (…, 3), (…, 4): frame b as seen from frame a."""
    inverse = conjugate(orientation_a)
    return rotate(inverse, position_b - position_a), multiply(inverse, orientation_b)


@kernel
def _forward(
    parents: Ints,
    translations: Floats,
    rotations: Floats,
    positions: Floats,
    orientations: Floats,
) -> None:
    """(J,), (F, J, 3), (F, J, 4) into (F, J, 3), (F, J, 4)."""
    for frame in range(translations.shape[0]):
        place(
            parents,
            translations[frame],
            rotations[frame],
            positions[frame],
            orientations[frame],
        )


@shared
def place(
    parents: Ints,
    translations: Floats,
    rotations: Floats,
    positions: Floats,
    orientations: Floats,
) -> None:
    """(J,), (J, 3), (J, 4) into (J, 3), (J, 4): one pose; parents stand before children."""
    for joint in range(parents.shape[0]):
        parent = parents[joint]
        position = vector_at(translations, joint)
        turn = quaternion_at(rotations, joint)
        if parent >= 0:
            frame = quaternion_at(orientations, parent)
            step = turned(frame, position)
            origin = vector_at(positions, parent)
            position = (origin[0] + step[0], origin[1] + step[1], origin[2] + step[2])
            turn = product(frame, turn)
        turn = unit(turn)
        for axis in range(3):
            positions[joint, axis] = position[axis]
        for axis in range(4):
            orientations[joint, axis] = turn[axis]

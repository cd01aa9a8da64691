"""What the channels of a force plate say about the force on it, for every type of plate.

C3D.org, "The C3D File Format User Guide", FORCE_PLATFORM:TYPE. A wrench is a force and a moment
about the middle of the plate's upper face, in the axes of the plate: x and y along its sides, z
down into it.
"""

import numpy as np

from usdmotion import Floats

CHANNELS = {1: 6, 2: 6, 3: 8, 4: 6}
"""How many channels a plate of each type has."""


def plate_axes(corners: Floats) -> Floats:
    """Return the axes of a plate as columns, shape (3, 3).

    Args:
        corners: In the order of the file: at (+x, +y), (−x, +y), (−x, −y), (+x, −y).
    """
    x = corners[0] + corners[3] - corners[1] - corners[2]
    y = corners[0] + corners[1] - corners[2] - corners[3]
    z = np.cross(x, y)
    axes = np.stack([x, np.cross(z, x), z], axis=1)
    return np.asarray(axes / np.linalg.norm(axes, axis=0))


def wrench(
    kind: int, channels: Floats, origin: Floats, matrix: Floats, arm: float
) -> tuple[Floats, Floats]:
    """Return forces [N] and moments [N m], both of shape (sample_count, 3).

    Args:
        kind: Type of the plate, 1 to 4.
        channels: Its channels, shape (sample_count, channel_count).
        origin: FORCE_PLATFORM:ORIGIN [m], shape (3,).
        matrix: Of a plate of type 4, what makes forces and moments of volts, shape (6, 6).
        arm: Metres in the unit of length of its moments, and of the places of type 1.
    """
    if kind == 1:
        return _centre_of_pressure(channels, arm)
    if kind == 3:
        return _corner_forces(channels, origin)
    if kind == 4:
        channels = channels @ matrix.T
    forces, moments = channels[:, :3], channels[:, 3:] * arm
    return forces, moments - np.cross(_to_face(origin), forces)


def _to_face(origin: Floats) -> Floats:
    """Return where the middle of the face is, from the sensors [m].

    The face is above the sensors, and z points down: where a file has it the other way round, it
    has written the vector from the face to the sensors.
    """
    return -origin if origin[2] > 0.0 else origin


def _centre_of_pressure(channels: Floats, arm: float) -> tuple[Floats, Floats]:
    """Type 1: forces, where they attack, and the free moment there."""
    forces = channels[:, :3]
    places = np.zeros_like(forces)
    places[:, :2] = channels[:, 3:5] * arm
    moments = np.cross(places, forces)
    moments[:, 2] += channels[:, 5] * arm
    return forces, moments


def _corner_forces(channels: Floats, origin: Floats) -> tuple[Floats, Floats]:
    """Type 3: Fx12 Fx34 Fy14 Fy23 Fz1 Fz2 Fz3 Fz4, sensors at (±a, ±b), as Kistler's plates."""
    x12, x34, y14, y23, z1, z2, z3, z4 = channels.T
    a, b, depth = np.abs(origin)
    forces = np.stack([x12 + x34, y14 + y23, z1 + z2 + z3 + z4], axis=1)
    moments = np.stack(
        [
            b * (z1 + z2 - z3 - z4),
            a * (-z1 + z2 + z3 - z4),
            b * (x34 - x12) + a * (y14 - y23),
        ],
        axis=1,
    )
    return forces, moments - np.cross((0.0, 0.0, -depth), forces)

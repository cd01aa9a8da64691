"""How a die rolls on a carpet, made of moves whose contacts are known.

It tips about an edge, pivots on a corner, rests on a face, and flies in between. The world is in
metres with +Y up, the carpet is y = 0, and a die's frame is at its centre.
"""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.detecting import Contact
from usdmotion.kernels import conjugate, from_vector, multiply, rotate

RATE = 24.0
"""Frames per second."""
EDGE = 0.2
"""Of a die [m]; they are dice of foam, as one throws by hand."""
CORNERS = EDGE * (np.array(list(np.ndindex(2, 2, 2))) - 0.5)
"""In the frame of a die [m], shape (8, 3)."""
_UP = np.array((0.0, 1.0, 0.0))
_GRAVITY = 9.81
_ANY_AXIS = np.array((0.0, 0.0, 1.0))
"""Of what has none."""
_UNEVEN = 0.06
"""How much a tip over its edge is slower in the middle, where the die is highest."""
_OVER_CORNER = 0.6
"""How far a pivot leads over the corner, and not along an edge."""
_NEAR = 1e-9


@dataclass(frozen=True, eq=False)
class Rolled:
    """How a die moves, and every contact it has meanwhile."""

    times: Floats
    """Seconds, shape (frame_count,)."""
    translations: Floats
    """Its centre [m], shape (frame_count, 3)."""
    rotations: Floats
    """xyzw, shape (frame_count, 4)."""
    contacts: tuple[Contact, ...]
    """In the order of their times; between them it is in the air."""

    def corners(self) -> Floats:
        """Return where its corners are [m], shape (frame_count, 8, 3)."""
        return rotate(self.rotations[:, None], CORNERS) + self.translations[:, None]


class Roll:
    """A die that is rolled, a move at a time; each takes some frames and begins where it is."""

    def __init__(self, translation: Floats, rotation: Floats) -> None:
        self._translations = [np.asarray(translation)]
        self._rotations = [np.asarray(rotation)]
        self._contacts: list[Contact] = []

    def rest(self, frames: int) -> None:
        """Stay: a space contact."""
        self._hold("space", frames, np.zeros(3))
        self._append(np.tile(self._translations[-1], (frames, 1)), self._rotations[-1:] * frames)

    def tip(self, frames: int, heading: float) -> None:
        """Turn about the foremost edge on the carpet, onto the next face: a line contact.

        Args:
            frames: How long it takes.
            heading: Where to, as an angle about the up axis from +Z [degrees].
        """
        second, first = self._foremost(heading)[:2]
        axis = rotate(self._rotations[-1], _unit(CORNERS[second] - CORNERS[first]))
        axis = axis if np.cross(axis, _UP) @ _ahead(heading) > 0.0 else -axis
        self._hold("line", frames, 0.5 * (CORNERS[first] + CORNERS[second]), axis)
        steps = _steps(frames) + _UNEVEN * np.sin(2.0 * np.pi * _steps(frames))
        turns = from_vector((self._to_next_face(axis) * steps)[:, None] * axis)
        self._turn(multiply(turns, self._rotations[-1]), self._contacts[-1])

    def pivot(self, frames: int, heading: float, axis: int, turn: float) -> None:
        """Turn on the foremost corner on the carpet, onto a face: a point contact.

        Args:
            frames: How long it takes.
            heading: Where foremost is, as in a tip.
            axis: The axis of the die that is upright at the end.
            turn: How far it turns about the up axis meanwhile [degrees].
        """
        corner = CORNERS[self._foremost(heading)[0]]
        self._hold("point", frames, corner)
        steps = _steps(frames)[:, None]
        start = rotate(conjugate(self._rotations[-1]), _UP)
        inside = -_unit(corner)
        over = _OVER_CORNER * 4.0 * steps * (1.0 - steps) * inside
        up = (1.0 - steps) * start + steps * np.sign(inside) * np.eye(3)[axis] + over
        tilts = multiply(self._rotations[-1], _arcs(up, start))
        turns = multiply(_about_up(np.radians(turn) * steps[:, 0] ** 2), tilts)
        self._turn(turns, self._contacts[-1])

    def fly(
        self, frames: int, travel: tuple[float, float], spin: tuple[float, float, float]
    ) -> None:
        """Fly to where the lowest corner is on the carpet: no contact.

        Args:
            frames: How long it takes.
            travel: How far along +X and +Z [m].
            spin: How it turns, as a rotation vector in its frame [degrees]; about an axis of the
                die it lands on an edge if it was on a face.
        """
        steps, length = _steps(frames)[:, None], frames / RATE
        rotations = multiply(self._rotations[-1], from_vector(np.radians(spin) * steps))
        start = self._translations[-1]
        lowest = rotate(rotations[-1], CORNERS)[:, 1].min()
        end = np.array((start[0] + travel[0], -lowest, start[2] + travel[1]))
        fall = 0.5 * _GRAVITY * length**2 * steps * (1.0 - steps)
        self._append(start + steps * (end - start) + fall * _UP, list(rotations))

    def done(self) -> Rolled:
        """Return the motion."""
        count = len(self._translations)
        return Rolled(
            times=np.arange(count) / RATE,
            translations=np.array(self._translations),
            rotations=np.array(self._rotations),
            contacts=tuple(self._contacts),
        )

    def _foremost(self, heading: float) -> list[int]:
        """Return which corners are on the carpet, the foremost of them first."""
        corners = rotate(self._rotations[-1], CORNERS)
        low = np.flatnonzero(corners[:, 1] < corners[:, 1].min() + _NEAR)
        ahead = corners[low] @ _ahead(heading)
        return [int(each) for each in low[np.argsort(-ahead)]]

    def _to_next_face(self, axis: Floats) -> float:
        """Return how far it has to turn about an axis until a face is down [radians]."""
        faces = rotate(self._rotations[-1], np.concatenate([np.eye(3), -np.eye(3)]))
        angles = np.arctan2(np.cross(faces, -_UP) @ axis, faces @ -_UP)
        return float(angles[(angles > _NEAR) & (np.abs(faces @ axis) < _NEAR)].min())

    def _hold(self, kind: str, frames: int, point: Floats, axis: Floats = _ANY_AXIS) -> None:
        """Note a contact that begins now."""
        frame, turn = len(self._translations) - 1, self._rotations[-1]
        self._contacts.append(
            Contact(
                kind=kind,
                start=frame / RATE,
                end=(frame + frames) / RATE,
                point=point,
                location=rotate(turn, point) + self._translations[-1],
                orientation=turn,
                axis=axis,
            )
        )

    def _turn(self, rotations: Floats, contact: Contact) -> None:
        """Go on as a contact lets it."""
        self._append(contact.location - rotate(rotations, contact.point), list(rotations))

    def _append(self, translations: Floats, rotations: list[Floats]) -> None:
        self._translations.extend(translations)
        self._rotations.extend(rotations)


def _steps(frames: int) -> Floats:
    """Return the shares of a move that are done at its frames, without its start."""
    return np.arange(1, frames + 1) / frames


def _about_up(angles: float | Floats) -> Floats:
    """Return rotations about the up axis [radians]."""
    return from_vector(np.multiply.outer(angles, _UP))


def _ahead(heading: float) -> Floats:
    return rotate(_about_up(np.radians(heading)), np.array((0.0, 0.0, 1.0)))


def _unit(vector: Floats) -> Floats:
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _arcs(directions: Floats, end: Floats) -> Floats:
    """Return the shortest turns of directions (N, 3) to one."""
    directions = _unit(directions)
    turns = np.empty((len(directions), 4))
    turns[:, :3] = np.cross(directions, end)
    turns[:, 3] = 1.0 + directions @ end
    return _unit(turns)

"""2006, section 8.1: two dice roll over a carpet, on corners, edges and faces; 141 frames."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from usdmotion import usd
from usdmotion.arrays import Floats
from usdmotion.demos.figures import Figure
from usdmotion.demos.rolling import CORNERS, EDGE, RATE, Roll, Rolled
from usdmotion.kernels import conjugate, from_vector, multiply

NEXT = "usdmotion detect {stage} --prims /Dice/First,/Dice/Second --kinds space,line,point"
"""There is no skeleton to solve; there are contacts to find."""
FIRST = 1.0
"""Time code of the first frame."""
CARPET = 2.4
"""Its edge [m]."""
_PIP = 0.09
"""Radius of a pip, over the edge of a die."""
_PROUD = 0.004
"""How far a pip stands out of its face, over the edge of a die."""
_APART = 0.25
"""How far pips are from each other and from the middle of a face, over the edge of a die."""
_DIGITS = 6
"""Of the places of their corners [m]; cosines leave something beyond."""
_PATTERNS = {
    1: ((0, 0),),
    2: ((-1, -1), (1, 1)),
    3: ((-1, -1), (0, 0), (1, 1)),
    4: ((-1, -1), (-1, 1), (1, -1), (1, 1)),
    5: ((-1, -1), (-1, 1), (0, 0), (1, -1), (1, 1)),
    6: ((-1, -1), (-1, 0), (-1, 1), (1, -1), (1, 0), (1, 1)),
}
_SIDES = {1: (1, 1), 6: (1, -1), 2: (2, 1), 5: (2, -1), 3: (0, 1), 4: (0, -1)}
"""Axis and sign of the face with each number; opposite ones make seven."""
_FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
_IVORY, _RED, _INK, _GREEN = (0.90, 0.87, 0.78), (0.72, 0.16, 0.14), (0.05,) * 3, (0.10, 0.33, 0.20)


def build(output: Path) -> None:
    """Write the stage."""
    dice = {"First": first(), "Second": second()}
    codes = FIRST + np.round(dice["First"].times * RATE)
    with usd.new_stage(
        output, frame_rate=RATE, first=float(codes[0]), last=float(codes[-1]), root="Dice"
    ) as stage:
        usd.author_prop(stage, "/Dice")
        _author_carpet(stage, "/Dice/Carpet")
        usd.author_mesh(stage, "/Dice/Die/Body", CORNERS, _FACES, color=_IVORY)
        _author_pips(stage, "/Dice/Die/Pips")
        for name, rolled in dice.items():
            usd.author_prop(
                stage,
                f"/Dice/{name}",
                translation=rolled.translations,
                rotation=rolled.rotations,
                time_codes=codes,
                inherits="/Dice/Die",
            )


def first() -> Rolled:
    """Return a die that is thrown in with backspin, rolls back, jumps again and comes to rest."""
    roll = Roll(np.array((0.0, 0.62, -0.55)), _turned((20.0, 40.0, -20.0)))
    roll.fly(16, travel=(0.55, 0.20), spin=(40.0, 40.0, 180.0))
    roll.pivot(16, heading=0.0, axis=0, turn=-90.0)
    roll.tip(12, heading=210.0)
    roll.tip(12, heading=210.0)
    roll.fly(16, travel=(-0.50, 0.10), spin=(0.0, 40.0, -180.0))
    roll.pivot(18, heading=30.0, axis=1, turn=100.0)
    roll.rest(50)
    return roll.done()


def second() -> Rolled:
    """Return a die that lands on edges, waits in between, and goes over a corner."""
    landed, spin = _turned((0.0, 0.0, 40.0)), (0.0, 0.0, 200.0)
    thrown = multiply(landed, conjugate(_turned(spin)))
    roll = Roll(np.array((0.90, 0.45, 0.60)), thrown)
    roll.fly(13, travel=(-0.40, -0.25), spin=spin)
    roll.tip(9, heading=-90.0)
    roll.rest(16)
    roll.tip(12, heading=180.0)
    roll.pivot(18, heading=120.0, axis=1, turn=-90.0)
    roll.fly(14, travel=(-0.40, 0.10), spin=(-320.0, 0.0, 0.0))
    roll.tip(10, heading=-90.0)
    roll.rest(48)
    return roll.done()


def _turned(degrees: tuple[float, float, float]) -> Floats:
    return from_vector(np.radians(degrees))


def _author_carpet(stage: Any, path: str) -> None:
    half = 0.5 * CARPET
    corners = np.array(
        [(-half, 0.0, -half), (-half, 0.0, half), (half, 0.0, half), (half, 0.0, -half)]
    )
    usd.author_mesh(stage, path, corners, [[0, 1, 2, 3]], color=_GREEN)


def _author_pips(stage: Any, path: str) -> None:
    outlines = list(_outlines())
    faces = np.arange(6 * len(outlines)).reshape(-1, 6).tolist()
    usd.author_mesh(stage, path, np.concatenate(outlines), faces, color=_INK)


def _outlines() -> Iterator[Floats]:
    """Yield the corners of each pip [m], (6, 3), counterclockwise seen from outside."""
    angles = np.arange(6) * np.pi / 3.0
    circle = _PIP * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for number, (axis, sign) in _SIDES.items():
        across = [(axis + 1) % 3, (axis + 2) % 3]
        for place in _PATTERNS[number]:
            points = np.empty((6, 3))
            points[:, across] = circle[::sign] + _APART * np.array(place)
            points[:, axis] = sign * (0.5 + _PROUD)
            yield np.round(EDGE * points, _DIGITS)


PICTURE = Figure(
    "2006, section 8.1: two dice, and what they roll over",
    frames=(10.0, 20.0, 36.0, 52.0, 71.0, 106.0),
    before=False,
)

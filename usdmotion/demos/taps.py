"""2006, section 9: a foot that taps so quickly that its taps are taken for one contact."""

from pathlib import Path

import numpy as np

from usdmotion.demos.figures import Answer, Figure
from usdmotion.demos.gait import Walk
from usdmotion.demos.kick import guard, turned_foot
from usdmotion.demos.walker import write_walk
from usdmotion.kernels import rotate

NEXT = "usdmotion detect {stage} --joints RightToeBase --option clock=0.25"
TAPS = 8
"""How often the ball of the right foot comes down again."""
BEFORE, AFTER = 13, 12
"""For how many frames it is down at first, and at the end."""
_TAP = (8.0, 16.0, 8.0, 0.0, 0.0, 0.0)
"""How far the toes are turned up on each frame of a tap [degrees]: half of it they are down."""


def tap() -> Walk:
    """Return somebody who stands, and taps with the right foot about its heel."""
    taps = np.tile(_TAP, TAPS)
    pitch = -np.concatenate([np.zeros(BEFORE), taps, np.zeros(AFTER)])
    heel = guard(np.zeros((1, 3)), np.zeros(1)).heel_point
    flat, turned = turned_foot(np.zeros(1)), turned_foot(pitch)
    return guard(rotate(flat, heel) - rotate(turned, heel), pitch)


def downs() -> list[tuple[int, int]]:
    """Return the first and the last frame of each contact of the ball, counted from 0."""
    starts = [BEFORE + len(_TAP) * each + 3 for each in range(TAPS)]
    between = [(start, start + 2) for start in starts[:-1]]
    return [(0, BEFORE - 1), *between, (starts[-1], starts[-1] + 2 + AFTER)]


def build(output: Path) -> None:
    """Write the stage."""
    write_walk(output, tap(), "Contacts", ())


PICTURE = Figure(
    "2006, section 9: taps that are taken for one contact, and by a slower clock",
    frames=(15.0, 19.0, 23.0, 27.0, 31.0),
    views=("side",),
    answers=(
        Answer("usual", steps=("usdmotion detect {stage} --joints RightToeBase",)),
        Answer("slower clock"),
    ),
    before=False,
)

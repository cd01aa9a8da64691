"""What people do in the demos: talk at a table, carry something, reach for something.

Where hands and pelvis are at some moments is chosen by eye, for a body of 1.7 m; +X is left, +Z
ahead.
"""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.acting import RATE, Script, act, through, turn
from usdmotion.demos.gait import Walk
from usdmotion.kernels import rotate

_ANKLE = 0.0663
"""Height of an ankle above its sole [m]."""
_TALK = (
    # moment, left wrist, right wrist, chest: forward, left; head: forward, left
    (0.0, 0.17, 0.57, 0.22, -0.17, 0.57, 0.22, 5, 0, 5, 0),
    (0.5, 0.17, 0.57, 0.22, -0.17, 0.57, 0.22, 5, 0, 5, 0),
    (1.0, 0.18, 0.60, 0.26, -0.24, 0.95, 0.26, 2, -6, -2, -14),
    (1.4, 0.17, 0.58, 0.24, -0.30, 0.86, 0.30, 3, -8, 2, -16),
    (1.8, 0.16, 0.57, 0.22, -0.18, 0.62, 0.26, 5, -2, 4, -4),
    (2.2, 0.20, 0.76, 0.32, -0.16, 0.57, 0.22, 6, 4, 2, 8),
    (2.7, 0.28, 0.97, 0.24, -0.24, 0.90, 0.24, 1, 6, -4, 14),
    (3.2, 0.20, 0.70, 0.27, -0.18, 0.68, 0.27, 4, 2, 3, 4),
    (3.7, 0.17, 0.57, 0.22, -0.17, 0.57, 0.22, 5, 0, 5, 0),
    (4.2, 0.17, 0.57, 0.22, -0.17, 0.57, 0.22, 5, 0, 5, 0),
)
_CARRY = (
    # moment, pelvis: left, down; wrists: half their distance, height, ahead; chest: forward, left
    (0.0, 0.00, 0.00, 0.24, 0.86, 0.12, 2, 0),
    (0.4, 0.00, 0.00, 0.24, 0.86, 0.12, 2, 0),
    (1.0, 0.02, 0.03, 0.20, 1.00, 0.34, 6, 5),
    (1.6, 0.03, 0.02, 0.19, 1.16, 0.36, 3, 12),
    (2.2, -0.02, 0.03, 0.20, 1.08, 0.38, 5, -12),
    (2.8, -0.02, 0.05, 0.21, 0.96, 0.36, 9, -6),
    (3.4, 0.00, 0.00, 0.24, 0.86, 0.12, 2, 0),
    (3.8, 0.00, 0.00, 0.24, 0.86, 0.12, 2, 0),
)
_REACH = (
    # moment, pelvis: ahead, down; left wrist; right wrist; chest: forward, left
    (0.0, 0.00, 0.000, 0.24, 0.87, 0.06, -0.24, 0.87, 0.06, 2, 0),
    (0.5, 0.00, 0.000, 0.24, 0.87, 0.06, -0.24, 0.87, 0.06, 2, 0),
    (1.3, 0.01, 0.010, 0.25, 0.88, 0.02, -0.20, 1.05, 0.38, 6, 6),
    (1.6, 0.01, 0.010, 0.25, 0.88, 0.02, -0.18, 1.06, 0.42, 7, 7),
    (2.1, 0.01, 0.010, 0.25, 0.88, 0.02, -0.18, 1.06, 0.42, 7, 7),
    (2.9, 0.00, 0.000, 0.24, 0.87, 0.06, -0.24, 0.87, 0.06, 2, 0),
    (3.4, 0.00, 0.000, 0.24, 0.87, 0.06, -0.24, 0.87, 0.06, 2, 0),
)


def talk() -> Walk:
    """Return somebody who sits, hands on his thighs, and talks with his hands now and then."""
    times = _times(_TALK[-1][0])
    column = through(_TALK, times).T
    count = len(times)
    pelvis = np.tile((0.0, 0.535, -0.10), (count, 1))
    script = Script(
        pelvis=pelvis,
        hips=_still(turn((0, -6.0)), count),
        chest=turn((1, column[7]), (0, column[6])),
        head=turn((1, column[9]), (0, column[8])),
        ankles=_standing(count, aside=0.11, ahead=0.36),
        feet=_toes_out(count, 8.0),
        wrists=(column[0:3].T, column[3:6].T),
        elbows=_elbows(count, out=0.5),
    )
    return act(times, script)


def carry() -> Walk:
    """Return somebody who lifts a thing with both hands, turns with it and puts it down again.

    How big it is cannot be told from his hands, which are somewhere about it.
    """
    times = _times(_CARRY[-1][0])
    left, down, half, high, ahead, lean, about = through(_CARRY, times).T
    # The hands go with the chest, about the up axis.
    middle = turn((1, about))
    wrists = tuple(
        rotate(middle, np.stack([side * half, high, ahead], axis=-1)) for side in (1, -1)
    )
    script = _stand(len(times), left, -down, np.zeros_like(left), (wrists[0], wrists[1]))
    return act(times, _leaning(script, lean, about))


def reach() -> Walk:
    """Return somebody who stands, and takes something in front of him with his right hand."""
    times = _times(_REACH[-1][0])
    column = through(_REACH, times).T
    wrists = column[2:5].T, column[5:8].T
    script = _stand(len(times), np.zeros_like(times), -column[1], column[0], wrists)
    return act(times, _leaning(script, column[8], column[9]))


def _stand(
    count: int, left: Floats, up: Floats, ahead: Floats, wrists: tuple[Floats, Floats]
) -> Script:
    """Return somebody who stands upright, with his pelvis moved out of the middle [m]."""
    still = _still(turn((0, 2.0)), count)
    pelvis = np.stack([left, 0.935 + up, ahead - 0.01], axis=-1)
    return Script(
        pelvis=pelvis,
        hips=still,
        chest=still,
        head=still,
        ankles=_standing(count, aside=0.12, ahead=0.0),
        feet=_toes_out(count, 12.0),
        wrists=wrists,
        elbows=_elbows(count, out=0.35),
    )


def _leaning(script: Script, lean: Floats, about: Floats) -> Script:
    """Return a script with the chest, and the head after it, leaning and turned [degrees]."""
    return Script(
        pelvis=script.pelvis,
        hips=turn((1, 0.3 * about), (0, 0.3 * lean)),
        chest=turn((1, about), (0, lean)),
        head=turn((1, about), (0, 1.5 * lean)),
        ankles=script.ankles,
        feet=script.feet,
        wrists=script.wrists,
        elbows=script.elbows,
    )


def _times(length: float) -> Floats:
    """Return the moments of the frames of so many seconds."""
    return np.arange(round(length * RATE) + 1) / RATE


def _still(value: Floats, count: int) -> Floats:
    """Return the same on every frame."""
    return np.tile(value, (count, 1))


def _standing(count: int, *, aside: float, ahead: float) -> tuple[Floats, Floats]:
    """Return ankles that stand."""
    left, right = ((side * aside, _ANKLE, ahead) for side in (1, -1))
    return _still(np.array(left), count), _still(np.array(right), count)


def _toes_out(count: int, degrees: float) -> tuple[Floats, Floats]:
    """Return feet flat on the ground, their toes turned out."""
    return _still(turn((1, degrees)), count), _still(turn((1, -degrees)), count)


def _elbows(count: int, *, out: float) -> tuple[Floats, Floats]:
    """Return where elbows point: down and back, and a little out."""
    left, right = (np.array((side * out, -0.7, -0.5)) for side in (1, -1))
    return _still(left, count), _still(right, count)

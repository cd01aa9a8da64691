"""What carries the root: ankles, knees, wrists, elbows.

The paper has only legs carry it, and says of the handstand what is done here (2005, section 11).
"""

from collections.abc import Sequence

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.errors import SceneError
from usdmotion.humanoid import ANKLE
from usdmotion.s4d.bodies import Measures

Held = tuple[str, float, float]
"""A part of a body that something holds, from when to when [s]."""

_THICKNESS = {"knee": 0.06, "radiocarpal": 0.04, "elbow": 0.045}
"""Height of a joint over the ground that its limb lies on, over leg length."""
_PASSING = 0.5
"""How long it takes until others carry [s]."""
_ANKLES, _KNEES, _WRISTS, _ELBOWS = (
    (f"l_{joint}", f"r_{joint}") for joint in (ANKLE, "knee", "radiocarpal", "elbow")
)


def carriers_of(times: Floats, held: Sequence[Held]) -> tuple[tuple[str, ...], Floats]:
    """Return the joints that carry the root and how much each does, from what is held.

    Who stands on his feet is carried by them, whatever his hands hold on to. Knees on the ground
    carry instead of feet, and share it with wrists or elbows; these carry alone where no leg does.
    Between contacts nothing changes abruptly.

    Args:
        times: Seconds, ascending, shape (F,).
        held: The contacts of a motion; parts that carry nobody may be among them.

    Returns:
        H-Anim names, none where it is always the ankles, and shares, shape (F, C).
    """
    down = {part: np.zeros(len(times), dtype=bool) for part in _EVERY}
    for part, start, end in held:
        carrier = _carrier_of(part)
        if carrier in down:
            down[carrier] |= (times >= start - 1e-6) & (times <= end + 1e-6)
    shares = _shares(down)
    carried = shares.sum(axis=1) > 0.0
    if not carried.any() or not shares[:, len(_ANKLES) :].any():
        return (), np.zeros((len(times), 0))
    passed = [np.interp(times, times[carried], share[carried]) for share in shares.T]
    eased = _eased(times, _eased(times, np.stack(passed, axis=1)))
    used = np.flatnonzero(eased.any(axis=0))
    return tuple(_EVERY[index] for index in used), eased[:, used]


_EVERY = (*_ANKLES, *_KNEES, *_WRISTS, *_ELBOWS)


def _carrier_of(part: str) -> str:
    side, _, joint = part.partition("_")
    if "tars" in joint:
        return f"{side}_{ANKLE}"
    return f"{side}_radiocarpal" if "carp" in joint else part


def _shares(down: dict[str, Bools]) -> Floats:
    """Return how much each of `_EVERY` carries on each frame, nothing where nobody is held."""
    ankles, knees, wrists, elbows = (
        np.stack([down[part] for part in pair], axis=1)
        for pair in (_ANKLES, _KNEES, _WRISTS, _ELBOWS)
    )
    ankles = ankles & ~knees
    wrists = wrists & ~elbows
    arms = np.concatenate([wrists, elbows], axis=1) & ~ankles.any(axis=1, keepdims=True)
    legs = np.concatenate([ankles, knees], axis=1)
    each = [_evenly(side.astype(np.float64)) for side in (legs, arms)]
    both = _evenly(np.stack([side.sum(axis=1) for side in each], axis=1))
    return np.concatenate([side * both[:, [index]] for index, side in enumerate(each)], axis=1)


def _evenly(counts: Floats) -> Floats:
    whole = counts.sum(axis=1, keepdims=True)
    return np.asarray(np.divide(counts, whole, out=np.zeros_like(counts), where=whole > 0.0))


def _eased(times: Floats, shares: Floats) -> Floats:
    """Return the means of shares over half of `_PASSING` around each time."""
    area = np.zeros_like(shares)
    steps = np.diff(times)[:, None]
    np.cumsum(0.5 * steps * (shares[1:] + shares[:-1]), axis=0, out=area[1:])
    reach = 0.25 * _PASSING
    ahead, back = times + reach, times - reach

    def until(ends: Floats, index: int) -> Floats:
        # Before the first sample and after the last the shares are held.
        inside = np.interp(ends, times, area[:, index])
        first, last = shares[0, index], shares[-1, index]
        return np.asarray(
            inside
            + np.minimum(ends - times[0], 0.0) * first
            + np.maximum(ends - times[-1], 0.0) * last
        )

    columns = [until(ahead, index) - until(back, index) for index in range(shares.shape[1])]
    return np.asarray(np.stack(columns, axis=1) / (2.0 * reach))


def carried_heights(
    measures: Measures, carriers: tuple[str, ...], shares: Floats
) -> tuple[Floats, Floats]:
    """Return how high the joints that carry are, and how far the root is from them, in shares.

    Args:
        measures: Of the body, on N frames.
        carriers: H-Anim names; none is the ankles.
        shares: How much each carries, shape (F, C).

    Returns:
        Heights and lengths [m], each of shape (F or N,).

    Raises:
        SceneError: A name is of no joint that carries.
    """
    if not carriers:
        return measures.ankle_height, measures.leg
    for part in carriers:
        if part not in _EVERY:
            raise SceneError(f"'{part}' carries nobody; name some of {', '.join(_EVERY)}")
    each = [_carrier(measures, part) for part in carriers]
    heights, lengths = (np.stack(side, axis=1) for side in zip(*each, strict=True))
    return (shares * heights).sum(axis=1), (shares * lengths).sum(axis=1)


def _carrier(measures: Measures, part: str) -> tuple[Floats, Floats]:
    side, _, joint = part.partition("_")
    arm, leg = (0, 1) if side == "l" else (2, 3)
    upper_arm, forearm = measures.limbs[:, arm].T
    thigh = measures.limbs[:, leg, 0]
    if joint == ANKLE:
        return measures.ankle_height, measures.leg
    height = _THICKNESS[joint] * measures.leg
    if joint == "knee":
        return height, thigh
    return height, measures.trunk + upper_arm + (forearm if joint == "radiocarpal" else 0.0)

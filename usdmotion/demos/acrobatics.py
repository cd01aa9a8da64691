"""Motion that hands carry: a handstand, and a crawl on hands and knees.

Where everything is at some moments is chosen by eye, for a body of 1.7 m; +X is left, +Z ahead.
"""

from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.acting import RATE, SIDES, Script, act, through, turn
from usdmotion.demos.gait import Stance, Walk
from usdmotion.kernels import multiply

_WRIST = 0.034
"""How high a wrist is above the ground that its hand lies on [m]."""
_ANKLE = 0.0663
_KNEE = 0.05
"""How high a knee is above the ground that it lies on [m]."""
_HANDSTAND = (
    # moment; pelvis: high, ahead, pitch; chest and head: pitch; ankles: high, ahead, pitch;
    # wrists: high, ahead
    (0.0, 0.935, 0.00, 0, 0, 0, _ANKLE, 0.00, 0, 0.87, 0.05),
    (0.3, 0.935, 0.00, 0, 0, 0, _ANKLE, 0.00, 0, 0.87, 0.05),
    (0.65, 0.83, -0.02, 36, 58, 50, _ANKLE, 0.00, 0, 0.64, 0.42),
    (0.85, 0.69, 0.00, 60, 90, 80, _ANKLE, 0.00, 0, 0.24, 0.49),
    (1.0, 0.61, 0.03, 75, 112, 100, _ANKLE, 0.00, 0, _WRIST, 0.50),
    (1.2, 0.64, 0.08, 85, 125, 110, _ANKLE, 0.00, 0, _WRIST, 0.50),
    (1.6, 0.92, 0.38, 125, 160, 140, 0.60, 0.05, 90, _WRIST, 0.50),
    (2.1, 1.035, 0.49, 172, 176, 160, 1.70, 0.40, 205, _WRIST, 0.50),
    (2.4, 1.035, 0.50, 180, 180, 165, 1.86, 0.50, 215, _WRIST, 0.50),
    (3.0, 1.035, 0.50, 182, 180, 165, 1.86, 0.54, 217, _WRIST, 0.50),
    (3.3, 1.035, 0.49, 172, 176, 160, 1.70, 0.40, 205, _WRIST, 0.50),
    (3.8, 0.92, 0.38, 125, 160, 140, 0.60, 0.05, 90, _WRIST, 0.50),
    (4.2, 0.64, 0.08, 85, 125, 110, _ANKLE, 0.00, 0, _WRIST, 0.50),
    (4.4, 0.61, 0.03, 75, 112, 100, _ANKLE, 0.00, 0, _WRIST, 0.50),
    (4.55, 0.69, 0.00, 60, 90, 80, _ANKLE, 0.00, 0, 0.24, 0.49),
    (4.75, 0.83, -0.02, 36, 58, 50, _ANKLE, 0.00, 0, 0.64, 0.42),
    (5.1, 0.935, 0.00, 0, 0, 0, _ANKLE, 0.00, 0, 0.87, 0.05),
    (5.4, 0.935, 0.00, 0, 0, 0, _ANKLE, 0.00, 0, 0.87, 0.05),
)
HANDS_DOWN, FEET_UP, FEET_DOWN, HANDS_UP = 1.0, 1.2, 4.2, 4.4
"""When hands and feet come and go in the handstand [s]."""
_CYCLES, _CYCLE, _STEP = 3, 1.2, 0.30
"""How often the crawl goes around, how long each takes [s], and how far it gets [m]."""
_THIGH, _SHANK = 0.245 * 1.7, 0.246 * 1.7
_HIP = (0.085, 0.0, -0.0425)
"""A hip joint of who is on all fours, from the root joint [m]."""


def handstand() -> Walk:
    """Return somebody who bends down, does a handstand, and gets up again."""
    times = np.arange(round(_HANDSTAND[-1][0] * RATE) + 1) / RATE
    high, ahead, hips, chest, head, up, forth, feet, wrist_up, wrist_forth = through(
        _HANDSTAND, times
    ).T
    zeros = np.zeros_like(times)
    down = np.clip((wrist_up - _WRIST) / 0.5, 0.0, 1.0)
    script = Script(
        pelvis=np.stack([zeros, high, ahead], axis=-1),
        hips=turn((0, hips)),
        chest=turn((0, chest)),
        head=turn((0, head)),
        ankles=_both(0.10 + 0.0 * times, up, forth),
        feet=(turn((1, 8.0), (0, feet)), turn((1, -8.0), (0, feet))),
        wrists=_both(0.20 + 0.04 * down, wrist_up, wrist_forth),
        elbows=(_elbow(1, hips), _elbow(-1, hips)),
        hands=(_flat(1, down), _flat(-1, down)),
    )
    acted = act(times, script)
    end = float(times[-1])
    feet_down, hands_down = ((0.0, FEET_UP), (FEET_DOWN, end)), ((HANDS_DOWN, HANDS_UP),)
    spans: dict[str, tuple[tuple[float, float], ...]] = {
        f"{side}{name}": times
        for side, _ in SIDES
        for name, times in (("Foot", feet_down), ("Hand", hands_down))
    }
    return replace(acted, stances=_stances(acted, spans))


def crawl() -> Walk:
    """Return somebody who crawls ahead on hands and knees, which slide to their next place."""
    times = np.arange(round(_CYCLES * _CYCLE * RATE) + 1) / RATE
    phase = times / _CYCLE
    zeros = np.zeros_like(times)
    knees = [_steps(phase + shift) for shift in (0.0, 0.5)]
    wrists = [_steps(phase + shift) for shift in (0.25, 0.75)]
    # The pelvis rides on the thigh of the knee that stands.
    hip = _STEP * (phase - phase[0])
    away = [knee - hip for knee in knees]
    rise = np.sqrt(_THIGH**2 - np.minimum(*np.abs(away)) ** 2)
    pelvis = np.stack([zeros, _KNEE + rise - _HIP[1], hip - _HIP[2]], axis=-1)
    legs = [_kneeling(side, knee, pelvis) for (_, side), knee in zip(SIDES, knees, strict=True)]
    script = Script(
        pelvis=pelvis,
        hips=turn((0, 90.0 + zeros)),
        chest=turn((0, 86.0 + zeros)),
        head=turn((0, 50.0 + zeros)),
        ankles=(legs[0][1], legs[1][1]),
        knees=(legs[0][0], legs[1][0]),
        feet=(turn((0, 172.0 + zeros)), turn((0, 172.0 + zeros))),
        wrists=_mirrored(0.17, _WRIST, 0.42, wrists),
        elbows=_mirrored(0.5, -0.3, -0.7, [zeros, zeros]),
        hands=(_flat(1, zeros), _flat(-1, zeros)),
    )
    acted = act(times, script)
    stands = {
        f"{name}{joint}": _stands(float(times[-1]), shift)
        for joint, shifts in (("Leg", (0.0, 0.5)), ("Hand", (0.25, 0.75)))
        for (name, _), shift in zip(SIDES, shifts, strict=True)
    }
    return replace(acted, stances=_stances(acted, stands))


def _stands(end: float, shift: float) -> tuple[tuple[float, float], ...]:
    """Return when something stands that goes on in the second half of each of its cycles [s]."""
    starts = (_CYCLE * (cycle - shift) for cycle in range(_CYCLES + 1))
    spans = ((max(start, 0.0), min(start + 0.5 * _CYCLE, end)) for start in starts)
    return tuple((start, stop) for start, stop in spans if stop > start)


def _steps(phase: Floats) -> Floats:
    """Return how far something is that stands for half of each cycle and then goes on [m].

    Where it is meets what rides over it in the middle of its stand.
    """
    whole = np.floor(phase)
    part = np.clip(2.0 * (phase - whole) - 1.0, 0.0, 1.0)
    eased = part**3 * (10.0 - 15.0 * part + 6.0 * part**2)
    return np.asarray(_STEP * (whole + 0.25 + eased - phase[0]))


def _kneeling(side: int, knee: Floats, pelvis: Floats) -> tuple[Floats, Floats]:
    """Return the way from hip to knee, and where the ankle is that lies behind it [m]."""
    hip = pelvis + np.array((side * _HIP[0], _HIP[1], _HIP[2]))
    ahead = knee - hip[:, 2]
    # A knee that is not under its hip goes aside, as far as its thigh is too long.
    down = hip[:, 1] - _KNEE
    aside = np.sqrt(np.maximum(_THIGH**2 - ahead**2 - down**2, 0.0))
    way = np.stack([side * aside, -down, ahead], axis=-1)
    return way, hip + way + _SHANK * np.array((0.0, 0.02, -np.sqrt(1.0 - 0.02**2)))


def _mirrored(
    aside: float, up: float, ahead: float, further: list[Floats]
) -> tuple[Floats, Floats]:
    """Return places or ways on both sides, each further ahead by some way of its own."""
    left, right = (
        np.stack([np.full_like(way, side * aside), np.full_like(way, up), ahead + way], axis=-1)
        for (_, side), way in zip(SIDES, further, strict=True)
    )
    return left, right


def _both(aside: Floats, up: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """Return places left and right that mirror each other."""
    left, right = (np.stack([side * aside, up, ahead], axis=-1) for _, side in SIDES)
    return left, right


def _elbow(side: int, pitch: Floats) -> Floats:
    """Return where an elbow points: aside, and to the back of a body that pitches."""
    aback = np.radians(pitch)
    return np.stack(
        [
            np.full_like(pitch, side * 0.6),
            0.3 * np.sin(aback) - 0.5 * np.cos(aback),
            -0.5 * np.cos(aback) - 0.4 * np.sin(aback),
        ],
        axis=-1,
    )


def _flat(side: int, away: Floats) -> Floats:
    """Return a hand that lies flat, fingers ahead, and hangs where it is away from the ground."""
    ahead = turn((1, -side * 90.0 * (1.0 - away)))
    return multiply(ahead, turn((2, -side * 80.0 * away)))


def _stances(acted: Walk, spans: dict[str, tuple[tuple[float, float], ...]]) -> tuple[Stance, ...]:
    """Return when joints stand, by their names."""
    return tuple(
        Stance(
            next(side for side, _ in SIDES if name.startswith(side)),
            "heel",
            acted.skeleton.joints[acted.joint(name)],
            start,
            end,
        )
        for name, times in spans.items()
        for start, end in times
    )

"""Footprints: where feet stand, when, and what moves a foot from one to the next."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from usdmotion.arrays import Bools, Floats, seal
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import slerp

_STRIKE = 0.25
"""A ball comes down this soon after its heel, if the heel belongs to its stance [s]."""
_SLACK = 1e-6
"""How far a frame may be beside the end of a footprint that it counts to [s]."""


@dataclass(frozen=True, eq=False)
class Footprint:
    """Where a joint of a foot is held for a while."""

    part: str
    """H-Anim name of the joint: an ankle, or the ball of a foot."""
    start: float
    """First time [s]."""
    end: float
    """Last time [s]."""
    place: Floats
    """Where the joint is, in the world [m], shape (3,)."""
    rotation: Floats | None = None
    """World orientation of the joint, xyzw, shape (4,); None leaves it to the motion."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "place", seal(self.place, 3, name="place"))
        if self.rotation is not None:
            object.__setattr__(self, "rotation", seal(self.rotation, 4, name="rotation"))

    def during(self, times: Floats) -> Bools:
        """Return on which frames it holds; between two frames it holds on the nearer one."""
        holds = (times >= self.start - _SLACK) & (times <= self.end + _SLACK)
        inside = len(times) > 0 and times[0] < self.start and self.end < times[-1]
        if inside and not holds.any():
            holds[np.abs(times - 0.5 * (self.start + self.end)).argmin()] = True
        return np.asarray(holds, dtype=np.bool_)


@dataclass(frozen=True, eq=False)
class Stance:
    """A foot that stands: on its ball where it has one, else on its ankle."""

    footprint: Footprint
    """What is held in place."""
    held: Bools
    """When it is, shape (frame_count,)."""
    frames: Bools
    """When the foot stands on anything, its heel included, shape (frame_count,)."""
    turned: tuple[Footprint, ...] = field(default=())
    """Footprints of the ankle meanwhile that say how the foot is turned."""

    def drawn(self, places: Floats) -> Floats:
        """Return what brings the foot to its footprint on the frames of the stance.

        While only the heel stands, it is what it is where the ball comes down, or has left.

        Args:
            places: Of the joint that is held [m], shape (frame_count, 3).

        Returns:
            Shape (stance_frame_count, 3).
        """
        held, frames = np.flatnonzero(self.held), np.flatnonzero(self.frames)
        return self.footprint.place - places[np.clip(frames, held[0], held[-1])]


def stances_of(footprints: Sequence[Footprint], side: str, times: Floats) -> tuple[Stance, ...]:
    """Return the stances of one foot, in the order of their times.

    Args:
        footprints: Those of the whole body.
        side: "l" or "r".
        times: Seconds, shape (frame_count,).
    """
    mine = sorted(footprints, key=lambda each: (each.start, each.end))
    balls = [each for each in mine if each.part == f"{side}_{BALL}"]
    ankles = [each for each in mine if each.part == f"{side}_{ANKLE}"]
    taken: set[int] = set()
    stances = []
    for each in balls:
        held = each.during(times)
        if not held.any():
            continue
        with_it = [one for one in ankles if (one.during(times) & held).any()]
        taken |= {id(one) for one in with_it}
        frames = np.any([held, *(one.during(times) for one in with_it)], axis=0)
        turned = tuple(one for one in with_it if one.rotation is not None)
        stances.append(Stance(each, held, frames, turned))
    for each in ankles:
        if id(each) not in taken:
            held = each.during(times)
            turned = (each,) if each.rotation is not None else ()
            stances.append(Stance(each, held, held, turned))
    return _apart(sorted(stances, key=lambda each: int(each.frames.argmax())))


def _apart(stances: Sequence[Stance]) -> tuple[Stance, ...]:
    """Return stances that share no frame: what was held first keeps it."""
    kept: list[Stance] = []
    for each in stances:
        free = ~np.any([one.frames for one in kept], axis=0) if kept else np.ones_like(each.frames)
        held, frames = each.held & free, each.frames & free
        if held.any():
            kept.append(Stance(each.footprint, held, frames, each.turned))
    return tuple(kept)


def from_heel_strike(stances: Sequence[Stance], times: Floats, heel: Bools) -> tuple[Stance, ...]:
    """Return stances that begin when the heel comes to stand, not when the ball does.

    Args:
        stances: Of one foot.
        times: Seconds, shape (frame_count,).
        heel: On which frames the heel rests on the ground, shape (frame_count,).
    """
    free = heel & ~np.any([each.frames for each in stances] or [np.zeros_like(heel)], axis=0)
    grown = []
    for each in stances:
        frames = np.array(each.frames)
        first, begins = int(frames.argmax()), times[frames.argmax()]
        while first and free[first - 1] and begins - times[first - 1] <= _STRIKE:
            first -= 1
            frames[first] = True
        grown.append(Stance(each.footprint, each.held, frames, each.turned))
    return tuple(grown)


def between(times: Floats, known: Bools, values: Floats) -> Floats:
    """Return values that are known on some frames, eased from each to the next one known.

    Before the first and after the last they stay what they are there.

    Args:
        times: Seconds, shape (frame_count,).
        known: On which frames, at least one, shape (frame_count,).
        values: Shape (frame_count, …); rotations where the last axis has four.
    """
    frames, index = np.flatnonzero(known), np.arange(len(times))
    before = frames[np.maximum(np.searchsorted(frames, index, side="right") - 1, 0)]
    after = frames[np.minimum(np.searchsorted(frames, index), len(frames) - 1)]
    gap = np.where(after > before, times[after] - times[before], 1.0)
    s = np.clip((times - times[before]) / gap, 0.0, 1.0)
    s = s * s * (3.0 - 2.0 * s)
    if values.ndim == 2 and values.shape[1] == 4:
        return slerp(values[before], values[after], s)
    s = s.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[before] + s * (values[after] - values[before]))

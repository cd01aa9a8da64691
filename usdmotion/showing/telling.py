"""The frames that tell a motion: where most is missed, where something is wanted for a while."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.quality import runs
from usdmotion.showing.shown import ShownEdit

USUAL = 6
"""How many frames tell a motion."""
_ON = 0.999
"""Activity of a goal that is wholly on."""
_SLACK = 1e-6


@dataclass(frozen=True)
class Clip:
    """When there is something to be seen on a stage, in time codes."""

    first: float
    last: float
    step: float
    """Of one frame."""

    @property
    def frame_count(self) -> int:
        """Number of frames."""
        return int((self.last - self.first) / self.step + _SLACK) + 1

    def snapped(self, codes: Floats) -> Floats:
        """Return the frames of the clip nearest to some time codes."""
        frames = np.round((codes - self.first) / self.step)
        return np.asarray(
            self.first + self.step * np.clip(frames, 0.0, self.frame_count - 1), dtype=np.float64
        )


def tiers_of(edit: ShownEdit) -> tuple[list[int], list[int], list[int]]:
    """Return numbers of frames at which there is something to be seen, the most important first.

    They are the frames where most is missed, then the middles of what goals ask, then those of what
    is asked without a goal.
    """
    return list(_worst(edit)), list(_wanted(edit)), list(_asked(edit))


def telling_frames(edit: ShownEdit, frame_count: int) -> list[int]:
    """Return numbers of some frames at which it is worth looking at an edit, ascending."""
    clip = Clip(0.0, frame_count - 1.0, 1.0)
    return [int(frame) for frame in telling(tiers_of(edit), clip)]


def telling(tiers: Sequence[Sequence[float]], clip: Clip, count: int = USUAL) -> Floats:
    """Return some frames at which it is worth looking.

    Args:
        tiers: Time codes of what there is to be seen, the most important first; those of one tier
            are as important as each other.
        clip: When there is something to be seen.
        count: How many frames.

    Returns:
        The start, the end, what is told of, and frames in the widest gaps; ascending.
    """
    found = np.unique(np.array([clip.first, clip.snapped(np.array([clip.last]))[0]]))
    apart = (clip.last - clip.first) / (2.5 * count)
    for tier in tiers:
        left = clip.snapped(np.unique(np.array(tier, dtype=np.float64)))
        while len(left) and len(found) < count:
            gaps = np.abs(left[:, None] - found).min(axis=1)
            if gaps.max() <= max(apart, _SLACK):
                break
            found = np.sort(np.append(found, left[gaps.argmax()]))
    while len(found) < min(count, clip.frame_count):
        widest = int(np.diff(found).argmax())
        middle = clip.snapped(np.array([0.5 * (found[widest] + found[widest + 1])]))
        if np.abs(found - middle).min() < _SLACK:
            break
        found = np.sort(np.append(found, middle))
    return found


def _worst(edit: ShownEdit) -> Iterator[int]:
    for miss in edit.misses:
        yield int(np.where(miss.missed, miss.errors, -1.0).argmax())


def _wanted(edit: ShownEdit) -> Iterator[int]:
    for goal in edit.goals:
        yield from _middles(goal.activity >= min(_ON, float(goal.activity.max(initial=0.0))))


def _asked(edit: ShownEdit) -> Iterator[int]:
    for course in edit.courses:
        yield from _middles(course.on)


def _middles(on: Bools) -> Iterator[int]:
    """Yield the middles of stretches that are not all of a clip: those say nothing of when."""
    for first, end in runs(on):
        if end - first < len(on):
            yield (first + end - 1) // 2

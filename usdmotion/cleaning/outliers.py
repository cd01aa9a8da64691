"""Samples that are no part of a motion: spikes that jump away and back, and frozen ones."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.kernels import slerp
from usdmotion.motion import Motion
from usdmotion.resampling import resample

LONGEST = 0.1
"""For how long a joint may be lost [s]; what lasts longer is taken for motion."""
_TWITCH = 0.04
"""Nothing gets away and back within this time [s]; what lasts longer has to stay away evenly."""
_NEARBY = 5
"""How many steps on each side say how far a joint usually moves from sample to sample."""
_USUAL = 4.0
"""How many times the usual step an outlier jumps at least."""
_BESIDE = 2.0
"""How many times the steps beside its jumps an outlier jumps at least: a quick move gathers speed
and loses it over several samples, a spike does not."""
_AWAY = 0.5
"""Share of its larger jump that an outlier is off the way between its neighbours at least."""
_STILL = 1e-7
"""Steps below this are none: the sample was repeated [rad or m]."""
_MISSED = 0.5
"""Share of the way missed while frozen that a joint has to jump over."""


@dataclass(frozen=True)
class _Sizes:
    """How large is what counts."""

    jump: float
    """The smallest jump of an outlier [rad or m]."""
    moving: float
    """The smallest usual step at which a repeated sample is a frozen one [rad or m]."""


_OF_ROTATIONS = _Sizes(jump=np.radians(2.0), moving=np.radians(0.2))
_OF_TRANSLATIONS = _Sizes(jump=0.01, moving=0.001)


@dataclass(frozen=True, eq=False)
class Outliers:
    """Which samples of which joints are no part of a motion, shape (frame_count, joint_count)."""

    rotations: Bools
    translations: Bools

    @property
    def either(self) -> Bools:
        """Which samples are wrong in one or the other."""
        return np.asarray(self.rotations | self.translations)


def find_outliers(motion: Motion) -> Outliers:
    """Return the outliers of a motion, each joint judged by itself in its parent's frame.

    A run of samples of up to `LONGEST` is one where the joint jumps into it and out of it again,
    and where its ends are off the way between its neighbours by half as much. All of these are more
    than 2 degrees or 1 cm above four times the usual step nearby (the median of five on each side,
    so that one spike does not hide another) and twice the steps beside them. The first and the last
    sample of the clip need one jump. A run of a repeated sample is one too where the joint moves
    before and after, and jumps over the way it missed. A true move away and back within six samples
    looks the same.

    Everything is measured by distances, which no choice of frame, axis or sign changes, and the
    same backwards in time.
    """
    if motion.frame_count <= _NEARBY:
        nothing = np.zeros(motion.rotations.shape[:2], dtype=np.bool_)
        return Outliers(nothing, nothing)
    rotations = _Track(motion.times, motion.rotations, _OF_ROTATIONS)
    translations = _Track(motion.times, motion.translations, _OF_TRANSLATIONS)
    return Outliers(_found(rotations), _found(translations))


def without(motion: Motion, outliers: Outliers) -> Motion:
    """Return a motion with outliers replaced: evenly from the last good sample to the next one.

    At an end of the clip the nearest good sample is held.
    """
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    for joint in np.flatnonzero(outliers.rotations.any(axis=0)):
        bad = outliers.rotations[:, joint]
        rotations[bad, joint] = _bridged(motion, joint, bad).rotations[:, 0]
    for joint in np.flatnonzero(outliers.translations.any(axis=0)):
        bad = outliers.translations[:, joint]
        translations[bad, joint] = _bridged(motion, joint, bad).translations[:, 0]
    return Motion(motion.times, translations, rotations)


def _bridged(motion: Motion, joint: np.intp, bad: Bools) -> Motion:
    """Return one joint at its bad samples, from its good ones."""
    good = Motion(
        motion.times[~bad],
        motion.translations[~bad, joint, None],
        motion.rotations[~bad, joint, None],
    )
    return resample(good, motion.times[bad])


@dataclass(frozen=True, eq=False)
class _Track:
    """The rotations or the translations of all joints, and how they go on from step to step."""

    times: Floats
    values: Floats
    """Shape (frame_count, joint_count, 4 or 3)."""
    sizes: _Sizes

    @cached_property
    def gap(self) -> float:
        """The usual time between two samples [s]."""
        return float(np.median(np.diff(self.times)))

    @cached_property
    def longest(self) -> int:
        """Samples in the longest run that may be an outlier."""
        return max(round(LONGEST / self.gap), 1)

    @cached_property
    def steps(self) -> Floats:
        """Distances between neighbours, as if samples were even, (frame_count − 1, joint_count)."""
        uneven = (self.gap / np.diff(self.times))[:, None]
        return np.asarray(_apart(self.values[:-1], self.values[1:]) * uneven)

    @cached_property
    def nearby(self) -> Floats:
        """The median of every five steps in a row, shape (frame_count + 5, joint_count).

        Row k is of those that end at sample k, and so of those that start at sample k − 5; of
        fewer where the clip has no more, 0 where it has none.
        """
        padded = np.pad(self.steps, ((_NEARBY, _NEARBY), (0, 0)), constant_values=np.inf)
        windows = np.sort(sliding_window_view(padded, _NEARBY, axis=0), axis=-1)
        known = np.count_nonzero(np.isfinite(windows), axis=-1)
        middle = (np.maximum(known - 1, 0) // 2)[..., None]
        return np.where(known > 0, np.take_along_axis(windows, middle, axis=-1)[..., 0], 0.0)

    def reversed(self) -> "_Track":
        """Return the track backwards in time."""
        return _Track(-self.times[::-1], self.values[::-1], self.sizes)

    def between(self, start: Ints, end: Ints, at: Ints, joint: Ints) -> Floats:
        """Return where joints would be at samples, were they on their way from one to another."""
        span = self.times[end] - self.times[start]
        way = self.times[at] - self.times[start]
        share = np.divide(way, span, out=np.zeros_like(span), where=span > 0.0)
        first, last = self.values[start, joint], self.values[end, joint]
        if self.values.shape[-1] == 4:
            return slerp(first, last, share)
        return np.asarray(first + share[:, None] * (last - first))


def _found(track: _Track) -> Bools:
    """Return the outliers among rotations or translations, short runs first."""
    bad = _frozen(track) | _frozen(track.reversed())[::-1]
    for length in range(1, min(track.longest, len(track.values) - _NEARBY) + 1):
        _mark_spikes(bad, track, length)
    return bad


def _mark_spikes(bad: Bools, track: _Track, length: int) -> None:
    """Mark the runs of one length, good at their ends and between good samples, that jump."""
    count = len(bad)
    first = np.arange(count - length + 1) if length == 1 else np.arange(1, count - length)
    before, after = np.maximum(first - 1, 0), np.minimum(first + length, count - 1)
    steps = np.pad(track.steps, ((1, 1), (0, 0)), constant_values=np.inf)  # row k ends at k
    enter, leave = steps[first], steps[first + length]
    least = track.sizes.jump + _least(track, first, before, after, length)
    good = np.pad(~bad, ((1, 1), (0, 0)), constant_values=True)  # row k is of sample k − 1
    for sample in (first, first + 1, first + length, first + length + 1):
        enter = np.where(good[sample], enter, 0.0)
    run, joint = np.nonzero(np.minimum(enter, leave) > least)
    enter, leave, least = enter[run, joint], leave[run, joint], least[run, joint]
    # Beyond an end of the clip there is no neighbour: the other one is held.
    start, end = np.where(np.isinf(enter), after[run], before[run]), after[run]
    end = np.where(np.isinf(leave), start, end)
    larger = np.maximum(enter, leave)
    larger = np.where(np.isinf(larger), np.minimum(enter, leave), larger)
    off = np.ones(len(run), dtype=np.bool_)
    for at in (first[run], first[run] + length - 1):
        there = track.between(start, end, at, joint)
        off &= _apart(there, track.values[at, joint]) > np.maximum(least, _AWAY * larger)
    for at, which in zip(first[run][off], joint[off], strict=True):
        bad[at : at + length, which] = True


def _least(track: _Track, first: Ints, before: Ints, after: Ints, length: int) -> Floats:
    """Return what steps nearby and beside say that an outlier has to exceed."""
    usual = np.maximum(track.nearby[before], track.nearby[after + _NEARBY])
    steps = np.pad(track.steps, ((2, 2), (0, 0)))
    beside = np.maximum(steps[first], steps[first + length + 2])
    if length > 1 and length * track.gap > _TWITCH:
        inside = np.maximum(track.steps[first], track.steps[first + length - 2])
        beside = np.maximum(beside, inside)
    return np.asarray(np.maximum(_USUAL * usual, _BESIDE * beside))


def _frozen(track: _Track) -> Bools:
    """Return the repeated samples after which a joint jumps over the way it missed."""
    steps, nearby = track.steps, track.nearby
    bad = np.zeros((len(steps) + 1, steps.shape[1]), dtype=np.bool_)
    still = np.pad(steps < _STILL, ((1, 1), (0, 0)))
    for joint in range(bad.shape[1]):
        edges = np.diff(still[:, joint].astype(np.int8))
        starts, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0)
        inside = (starts > 0) & (ends < len(steps)) & (ends - starts <= track.longest)
        for start, end in zip(starts[inside], ends[inside], strict=True):
            around = nearby[[start, end + 1 + _NEARBY], joint]
            beside = steps[[start - 1, min(end + 1, len(steps) - 1)], joint]
            least = max(*around, *beside) * (1.0 + _MISSED * (end - start))
            if around.min() > track.sizes.moving and steps[end, joint] > least:
                bad[start + 1 : end + 1, joint] = True
    return bad


def _apart(a: Floats, b: Floats) -> Floats:
    """(…, 4), (…, 4) or (…, 3), (…, 3) to (…): the angle [rad] or the distance [m] between them."""
    if a.shape[-1] == 3:
        return np.asarray(np.linalg.norm(a - b, axis=-1))
    # The sign of a quaternion says nothing; the sine of a quarter of the angle is exact near 0.
    chord = np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return np.asarray(4.0 * np.arcsin(np.minimum(0.5 * chord, 1.0)))

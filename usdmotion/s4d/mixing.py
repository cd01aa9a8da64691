"""Normalized motions mixed: blended into each other, or at another pace than their own."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.motion import between_samples
from usdmotion.s4d.bodies.places import ENDS, TOPS
from usdmotion.s4d.conforming import conformed
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.postures import require_whole
from usdmotion.s4d.steadiness import Steady
from usdmotion.s4d.turns import continuous

_WHOLE = 1e-6
"""How far shares may be beside adding up to 1."""


def blend(motions: Sequence[NormalizedMotion], shares: Floats) -> NormalizedMotion:
    """Return motions blended into each other, with the parts and joints of the first.

    Args:
        motions: At the same times; of bodies with any vertebrae and fingers.
        shares: How much each counts, adding up to 1, shape (F, motion_count).

    Raises:
        SceneError: They are not at the same times or not whole, or the shares do not add up to 1.
    """
    shares = np.asarray(shares, dtype=np.float64)
    _refuse(motions, shares)
    alike = conformed(motions)
    first, mean = alike[0], _Mean(shares)
    steady = [_steady(each) for each in alike]
    (frames, lengths, twists), ends = Steady(
        frames=mean.turning([each.frames for each in steady]),
        bends=mean.linear([each.bends for each in steady]),
        twists=mean.linear([each.twists for each in steady]),
        ends=mean.turning([each.ends for each in steady]),
    ).told(first.limbs)
    rotations = mean.turning([each.segment_rotations for each in alike])
    rotations[:, _places_of_ends(first)] = continuous(ends)

    def turning(name: str) -> Floats:
        return mean.turning([getattr(each, name) for each in alike])

    def linear(name: str) -> Floats:
        return mean.linear([getattr(each, name) for each in alike])

    return replace(
        first,
        limb_frames=continuous(frames),
        limb_lengths=lengths,
        limb_twists=twists,
        segment_rotations=rotations,
        spine=linear("spine"),
        root_position=linear("root_position"),
        root_heading=turning("root_heading"),
        root_orientation=turning("root_orientation"),
        carrier_shares=linear("carrier_shares"),
        extra_rotations=turning("extra_rotations"),
        offsets=linear("offsets"),
    )


def warp(motion: NormalizedMotion, times: Floats, at: Floats) -> NormalizedMotion:
    """Return a motion at another pace: what was at some times of its own is at others.

    Args:
        motion: The motion.
        times: When something is shown, ascending [s], shape (F,).
        at: What is shown then, in the motion's own seconds, shape (F,); it may stop, go back or
            begin anew. Before its first sample and after its last the motion is held. From a few
            keys `curves.Spline.through` makes a curve that goes back only where they do.

    Raises:
        SceneError: The times when it is shown do not ascend.
    """
    times, at = np.asarray(times, dtype=np.float64), np.asarray(at, dtype=np.float64)
    if np.any(np.diff(times) <= 0.0) or times.shape != at.shape:
        raise SceneError(
            "a motion is warped to times that ascend; give as many of its own for them"
        )
    before, after, share = between_samples(motion.times, at)
    start, end = (replace(motion.on(frames), times=times) for frames in (before, after))
    return blend((start, end), np.stack([1.0 - share, share], axis=1))


@dataclass(frozen=True, eq=False)
class _Mean:
    shares: Floats

    def linear(self, values: Sequence[Floats]) -> Floats:
        """(F, …) each to (F, …)."""
        weights = self.shares.reshape(*self.shares.shape, *(1,) * (values[0].ndim - 1))
        return np.asarray(sum(weights[:, index] * each for index, each in enumerate(values)))

    def turning(self, values: Sequence[Floats]) -> Floats:
        """(F, …, 4) each to (F, …, 4): quaternions of the sign of the one that counts most."""
        most = np.array(values)[np.argmax(self.shares, axis=1), np.arange(len(self.shares))]
        dots = (np.sum(each * most, axis=-1, keepdims=True) for each in values)
        near = [np.where(dot < 0.0, -q, q) for dot, q in zip(dots, values, strict=True)]
        mean = self.linear(near)
        # The one that counts most changes on the way, and with it the sign.
        return continuous(mean / np.linalg.norm(mean, axis=-1, keepdims=True))


def _steady(motion: NormalizedMotion) -> Steady:
    told = motion.limb_frames, motion.limb_lengths, motion.limb_twists
    ends = motion.segment_rotations[:, _places_of_ends(motion)]
    return Steady.of(motion.limbs, told, ends)


def _places_of_ends(motion: NormalizedMotion) -> list[int]:
    """Return where the hand or foot of each limb is among the segments."""
    return [motion.segments.index(ENDS[TOPS.index(limb)]) for limb in motion.limbs]


def _refuse(motions: Sequence[NormalizedMotion], shares: Floats) -> None:
    if not motions:
        raise SceneError("there is nothing to blend; name a motion")
    for each in motions:
        require_whole(each)
    first = motions[0]
    if any(not np.array_equal(each.times, first.times) for each in motions):
        raise SceneError("motions at different times cannot be blended; warp them to the same")
    if shares.shape != (len(first.times), len(motions)):
        raise SceneError(
            f"{len(motions)} motions of {len(first.times)} frames cannot be blended by shares of "
            f"shape {shares.shape}; give one for each motion on each frame"
        )
    if np.any(shares < 0.0) or np.any(np.abs(shares.sum(axis=1) - 1.0) > _WHOLE):
        raise SceneError("the shares of blended motions must add up to 1 and not be negative")

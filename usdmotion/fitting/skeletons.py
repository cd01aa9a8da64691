"""A skeleton of the lengths that segments have in the middle of a clip, and how it moves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from usdmotion.arrays import Floats
from usdmotion.fitting.landmarks import Landmarks
from usdmotion.fitting.segments import Segment
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.motion import Motion, Skeleton


@dataclass(frozen=True, eq=False)
class Rig:
    """A skeleton, where the markers are on it, and a first guess of its motion."""

    skeleton: Skeleton
    motion: Motion
    riding: dict[str, int]
    """The joint that each marker rides on, by its Plug-in-Gait name."""
    points: dict[str, Floats]
    """Where it is in that joint's frame [m], shape (3,)."""
    tip_joints: tuple[int, ...]
    """Joints at which a segment ends freely."""
    tip_points: Floats
    """Where, in the joint's frame [m], shape (tip_count, 3)."""


def make_rig(segments: Sequence[Segment], marks: Landmarks, times: Floats, up: str) -> Rig:
    """Return the skeleton of some segments, in a T-pose at rest, and its motion.

    Lengths are medians over the clip, so that a few bad frames say nothing; between frames on
    which a segment is not known, it turns evenly.
    """
    names = [each.name for each in segments]
    parents = np.array([names.index(s.parent) if s.parent else -1 for s in segments])
    turns = np.stack([_turns(each.axes) for each in segments], axis=1)
    places = _inside(segments, parents, turns)
    tips = [number for number, each in enumerate(segments) if each.end is not None]
    ends = [usual(segments[n].end - segments[n].origins, turns[:, n]) for n in tips]  # type: ignore[operator]
    rest = _rest(places, parents, ends, tips, up)
    motion = Motion(
        times,
        np.concatenate(
            [_filled(segments[0].origins)[:, None], np.tile(places[1:], (len(times), 1, 1))], axis=1
        ),
        np.where(
            (parents < 0)[None, :, None], turns, multiply(conjugate(turns[:, parents]), turns)
        ),
    )
    riding = {
        mark: number
        for number, each in enumerate(segments)
        for mark in (marks.worn.get(each.name, ()) if marks.worn else each.markers)
        if marks.has(mark)
    }
    points = {
        mark: usual(marks[mark] - segments[number].origins, turns[:, number])
        for mark, number in riding.items()
    }
    # What was never seen together with its segment has no place on it.
    riding = {mark: joint for mark, joint in riding.items() if np.isfinite(points[mark]).all()}
    skeleton = Skeleton(_tokens(names, parents), parents, *rest)
    return Rig(skeleton, motion, riding, points, tuple(tips), np.array(ends).reshape(-1, 3))


def _inside(segments: Sequence[Segment], parents: Floats, turns: Floats) -> Floats:
    """Return where each joint is in its parent's frame, zeros for the root, (joint_count, 3)."""
    places = np.zeros((len(segments), 3))
    for number, segment in enumerate(segments):
        above = int(parents[number])
        if above >= 0:
            off = segment.origins - segments[above].origins
            places[number] = usual(off, turns[:, above])
    return places


def usual(offsets: Floats, turns: Floats) -> Floats:
    """Return the median of world offsets in a frame; NaN where none is known.

    Args:
        offsets: From the frame's origin [m], NaN where nobody knows, shape (frame_count, 3).
        turns: World orientation of the frame, unit xyzw, shape (frame_count, 4).
    """
    known = np.isfinite(offsets).all(axis=1)
    if not known.any():
        return np.full(3, np.nan)
    return np.asarray(np.median(rotate(conjugate(turns[known]), offsets[known]), axis=0))


def _rest(
    places: Floats, parents: Floats, ends: Sequence[Floats], tips: Sequence[int], up: str
) -> tuple[Floats, Floats]:
    """Return the T-pose: no joint is turned, what is lowest is on the floor."""
    heights = np.zeros(len(places))
    for number, above in enumerate(parents):
        heights[number] = places[number, 1] + (heights[above] if above >= 0 else 0.0)
    soles = [heights[n] + end[1] for n, end in zip(tips, ends, strict=True)]
    places, turns = places.copy(), np.tile((0.0, 0.0, 0.0, 1.0), (len(places), 1))
    places[0] = (0.0, -min([*heights, *soles]), 0.0)
    if up == "Z":
        turns[0] = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))
        places[0] = places[0, [0, 2, 1]]
    return places, turns


def _turns(axes: Floats) -> Floats:
    """Return axes as unit quaternions of all frames, (F, 3, 3) to (F, 4)."""
    known = np.flatnonzero(np.isfinite(axes).all(axis=(1, 2)))
    every = np.clip(np.arange(len(axes)), known[0], known[-1])
    turns = Rotation.from_matrix(axes[known])
    found = Slerp(known, turns)(every) if len(known) > 1 else turns[np.zeros(len(axes), dtype=int)]
    return np.asarray(found.as_quat())


def _filled(places: Floats) -> Floats:
    """Return places of all frames, on straight lines between those that are known."""
    known = np.flatnonzero(np.isfinite(places).all(axis=1))
    frames = np.arange(len(places))
    return np.stack([np.interp(frames, known, each) for each in places[known].T], axis=1)


def _tokens(names: Sequence[str], parents: Floats) -> tuple[str, ...]:
    tokens: list[str] = []
    for name, above in zip(names, parents, strict=True):
        tokens.append(f"{tokens[above]}/{name}" if above >= 0 else name)
    return tuple(tokens)

"""Fits a skeleton to captured markers."""

from dataclasses import replace

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.capture import Capture
from usdmotion.cast import Character
from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.fitting import optitrack
from usdmotion.fitting.landmarks import Landmarks
from usdmotion.fitting.segments import segments_of_body
from usdmotion.fitting.skeletons import Rig, make_rig, usual
from usdmotion.kernels import forward, world_points
from usdmotion.marker_sets import places, subjects
from usdmotion.motion import Body, Motion, Placement
from usdmotion.options import configured
from usdmotion.passes import Passes
from usdmotion.plugins import host
from usdmotion.recording import Recording
from usdmotion.scene import Edit, Scene

_PELVIS = (("LASI", "RASI"), ("LPSI", "RPSI", "SACR"))
_LEGS = tuple(side + mark for side in "LR" for mark in ("KNE", "ANK", "TOE"))
_SKELETON = "/Body/Skeleton"
_SOLVER = "prioritized_ik"
_OPTIONS = {"iterations": 20, "finish": 0}
"""All markers have one rank: nothing above has to be held while the last of it is made up for."""
_FEW = 5
"""So many places that no marker has are told one by one."""
_FAR = 0.05
"""A body that is farther from its markers than this [m] is none."""
_FEWEST = 10
"""Frames on which the whole body must be known, so that its lengths can be told."""


def fit(capture: Capture) -> tuple[Recording | None, tuple[str, ...]]:
    """Return the skeleton that wears the markers of a capture, and what there is to say about it.

    There is none where the labels do not tell a body, at least from the pelvis down. Of several
    subjects it is the one who wears most markers.
    """
    up = np.eye(3)["XYZ".index(capture.up)]
    # Of places that are not known or fall together, nothing follows, frame by frame.
    with np.errstate(invalid="ignore", divide="ignore"):
        marks, seen = _marks(capture, up)
        lacking = _lacking(marks)
        if lacking:
            return None, lacking
        segments = segments_of_body(marks, up)
    known = np.all([np.isfinite(each.axes).all(axis=(1, 2)) for each in segments], axis=0)
    if known.sum() < _FEWEST:
        return None, ("no skeleton is fitted: its markers are never seen all together",)
    if _SOLVER not in host().solvers:
        return None, (f"no skeleton is fitted: the solver '{_SOLVER}' is not installed",)
    rig = make_rig(segments, marks, capture.times, capture.up)
    motion = _solved(rig, marks, seen, up)
    # Once more, with the markers where the motion has them in the middle of the clip.
    rig = _glued(rig, motion, marks)
    motion = _solved(rig, marks, seen, up)
    off, told = _told(rig, motion, marks)
    if off > _FAR:
        return None, (f"no skeleton is fitted, as the markers do not move like a body: {told}",)
    return _recording(capture, rig, motion), (told, *_unseen(rig, seen), *_others(capture))


def _marks(capture: Capture, up: Floats) -> tuple[Landmarks, dict[str, Bools]]:
    """Return the markers of the one who wears most, by their places on the body.

    They are NaN where they were not seen; the second mapping says where they were.
    """
    markers = capture.markers
    labels = max(subjects(markers.labels).values(), key=len)
    suit = optitrack.cores(labels)
    known, seen = {}, {}
    for place, label in (suit or places(labels)).items():
        number = markers.labels.index(label)
        seen[place] = markers.seen[:, number]
        if seen[place].any():
            known[place] = np.where(seen[place][:, None], markers.positions[:, number], np.nan)
    if suit and known.keys() == suit.keys():
        return optitrack.landmarks(known, up), seen
    return Landmarks(known, len(capture.times)), seen


def _lacking(marks: Landmarks) -> tuple[str, ...]:
    front, back = _PELVIS
    missing = [name for name in (*front, *_LEGS) if not marks.has(name)]
    if not any(marks.has(name) for name in back):
        missing.append("SACR")
    if not missing:
        return ()
    which = ", ".join(missing) if len(missing) <= _FEW else "on which place of a body"
    return (f"no skeleton is fitted: no label says which marker is {which}",)


def _solved(rig: Rig, marks: Landmarks, seen: dict[str, Bools], up: Floats) -> Motion:
    """Return the motion that brings every marker of the skeleton to where it was seen."""
    skeleton = rig.skeleton
    frames = len(rig.motion.times)
    constraints = tuple(
        PositionConstraint(
            path=f"{_SKELETON}/Fit/{mark}",
            skeleton=_SKELETON,
            joint=skeleton.joints[joint],
            point=rig.points[mark],
            activity=seen[mark].astype(np.float64),
            goals=(Goal(translation=np.nan_to_num(marks[mark])),),
        )
        for mark, joint in rig.riding.items()
    )
    body = Body.unknown(len(skeleton.joints))
    place = Placement.identity(frames)
    character = Character(_SKELETON, skeleton, body, rig.motion, place, root=0)
    edit = Edit(f"{_SKELETON}/Fit", _SKELETON, constraints)
    scene = Scene((character,), (edit,), np.arange(frames, dtype=np.float64), up)
    found = Passes(scene, configured(host().solver(_SOLVER), _OPTIONS)).last
    own = scene.nodes(_SKELETON)
    return Motion(rig.motion.times, found.translations[:, own], found.rotations[:, own])


def _glued(rig: Rig, motion: Motion, marks: Landmarks) -> Rig:
    """Return a rig whose markers are where they are in the middle of a motion."""
    positions, turns = forward(rig.skeleton.parents, motion.translations, motion.rotations)
    points = {
        mark: usual(marks[mark] - positions[:, joint], turns[:, joint])
        for mark, joint in rig.riding.items()
    }
    return replace(rig, points=points, motion=motion)


def _errors(rig: Rig, motion: Motion, marks: Landmarks) -> dict[str, Floats]:
    """Return how far each marker is from where it was seen [m], NaN where it was not."""
    positions, turns = forward(rig.skeleton.parents, motion.translations, motion.rotations)
    return {
        mark: np.linalg.norm(
            world_points(positions[:, joint], turns[:, joint], rig.points[mark]) - marks[mark],
            axis=1,
        )
        for mark, joint in rig.riding.items()
    }


def _told(rig: Rig, motion: Motion, marks: Landmarks) -> tuple[float, str]:
    """Return how far markers usually are from the body [m], and a sentence about it."""
    errors = _errors(rig, motion, marks)
    every = np.concatenate(list(errors.values()))
    typical = {mark: float(np.sqrt(np.nanmean(each**2))) for mark, each in errors.items()}
    worst = max(typical, key=typical.__getitem__)
    off = float(np.sqrt(np.nanmean(every**2)))
    return off, (
        f"a skeleton of {len(rig.skeleton.joints)} joints is fitted to {len(errors)} markers: they "
        f"are {1000.0 * off:.1f} mm from it (root mean square), most of all {worst}, "
        f"{1000.0 * typical[worst]:.1f} mm"
    )


def _others(capture: Capture) -> tuple[str, ...]:
    """Return what there is to say about bodies that nothing is fitted to."""
    whose = subjects(capture.markers.labels)
    found = {name: len(places(labels)) for name, labels in whose.items() if name}
    if len(found) < 2:
        return ()
    first = max(whose, key=lambda name: len(whose[name]))
    return (f"of the subjects {', '.join(found)}, the skeleton is that of {first}",)


def _unseen(rig: Rig, seen: dict[str, Bools]) -> tuple[str, ...]:
    """Return what there is to say about frames on which nothing shows where the body is."""
    blind = ~np.any([seen[mark] for mark in rig.riding], axis=0)
    if not blind.any():
        return ()
    return (
        f"on {blind.sum()} of {len(blind)} frames no marker of the body is seen: there it goes "
        "evenly from one side of the gap to the other, or stays",
    )


def _recording(capture: Capture, rig: Rig, motion: Motion) -> Recording:
    return Recording(
        name="Body",
        skeleton=rig.skeleton,
        motion=motion,
        frame_rate=capture.frame_rate,
        original_names=tuple(token.rpartition("/")[2] for token in rig.skeleton.joints),
        up=capture.up,
        tip_joints=np.array(rig.tip_joints, dtype=np.int64),
        tip_points=rig.tip_points,
    )

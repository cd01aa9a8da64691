"""Something to look at: an octahedron along every segment of a skeleton."""

from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats, Ints

_WAIST = 0.2
"""Where along its segment an octahedron is widest."""
GIRTH = 0.09
"""Its half width there, over its length."""
_SHORTEST = 1e-4
"""Segments shorter than this have none [m]."""
_FACES = np.array(
    [(5, 1, 2), (5, 2, 3), (5, 3, 4), (5, 4, 1), (0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4)]
)
"""Corners of the eight faces: 0 is the start, 1 to 4 the waist, 5 the end."""


@dataclass(frozen=True, eq=False)
class SegmentGuide:
    """A mesh whose every point follows one joint."""

    points: Floats
    """In the skeleton's space, in the pose in which it was made [m], shape (point_count, 3)."""
    joints: Ints
    """The joint that each point follows, shape (point_count,)."""
    faces: Ints
    """Corners of each triangle, counterclockwise seen from outside, shape (face_count, 3)."""
    ends: Ints
    """The joint at which each segment of six points ends, -1 of a free end, (segment_count,)."""

    @property
    def reaching(self) -> Ints:
        """The joints that points follow so that segments grow with what they connect, (N,)."""
        joints = self.joints.reshape(-1, 6).copy()
        joints[:, 5] = np.where(self.ends >= 0, self.ends, joints[:, 5])
        return np.asarray(joints.ravel())


def segment_guide(parents: Ints, positions: Floats, tip_joints: Ints, tips: Floats) -> SegmentGuide:
    """Return the guide of a skeleton in a pose.

    Args:
        parents: Index of each joint's parent, -1 for none.
        positions: Where the joints are [m], shape (joint_count, 3).
        tip_joints: Joints at which a last segment ends freely, shape (tip_count,).
        tips: Where it ends [m], shape (tip_count, 3).
    """
    children = np.flatnonzero(parents >= 0)
    joints = np.concatenate([parents[children], tip_joints])
    starts = positions[joints]
    ends = np.concatenate([positions[children], tips])
    reached = np.concatenate([children, np.full(len(tip_joints), -1)])
    long = np.linalg.norm(ends - starts, axis=1) > _SHORTEST
    joints, starts, ends = joints[long], starts[long], ends[long]
    points = _octahedra(starts, ends)
    firsts = 6 * np.arange(len(joints))
    return SegmentGuide(
        points=points.reshape(-1, 3),
        joints=np.repeat(joints, 6),
        faces=(firsts[:, None, None] + _FACES).reshape(-1, 3),
        ends=reached[long],
    )


def is_segment_guide(faces: Ints) -> bool:
    """Tell whether the triangles of a mesh, shape (face_count, 3), are those of such a guide."""
    count, rest = divmod(len(faces), len(_FACES))
    firsts = 6 * np.arange(count)
    return (
        count > 0
        and rest == 0
        and bool((faces.reshape(-1, *_FACES.shape) == firsts[:, None, None] + _FACES).all())
    )


def _octahedra(starts: Floats, ends: Floats) -> Floats:
    """(N, 3), (N, 3) to (N, 6, 3): the corners, in the order of `_FACES`."""
    along = ends - starts
    length = np.linalg.norm(along, axis=1, keepdims=True)
    axis = along / length
    # Any direction that is not along the segment will do to start from.
    away = np.eye(3)[np.abs(axis).argmin(axis=1)]
    side = np.cross(axis, away)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    front = np.cross(axis, side)
    middle, width = starts + _WAIST * along, GIRTH * length
    waist = [middle + width * way for way in (side, front, -side, -front)]
    return np.stack([starts, *waist, ends], axis=1)

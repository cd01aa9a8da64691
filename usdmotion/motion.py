"""A skeleton, the body around it, and its motion: plain values, lengths in metres."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from usdmotion.arrays import Floats, Ints, seal
from usdmotion.errors import SceneError

WorldPose = tuple[Floats, Floats]
"""World positions [m] and orientations (xyzw) of some joints, the last axes 3 and 4."""


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Joints in a hierarchy, parents before their children."""

    joints: tuple[str, ...]
    """Token of each joint, unique; a path of names as UsdSkel has it."""
    parents: Ints
    """Index of each joint's parent, -1 for a top joint, shape (joint_count,)."""
    rest_translations: Floats
    """Rest position in the parent's frame [m], shape (joint_count, 3)."""
    rest_rotations: Floats
    """Rest orientation in the parent's frame, xyzw, shape (joint_count, 4)."""

    def __post_init__(self) -> None:
        count = len(self.joints)
        _freeze(
            self,
            parents=seal(self.parents, count, dtype=np.int64, name="parents"),
            rest_translations=seal(self.rest_translations, count, 3, name="rest_translations"),
            rest_rotations=seal(self.rest_rotations, count, 4, name="rest_rotations"),
        )
        if len(set(self.joints)) != count:
            twice = next(token for token in self.joints if self.joints.count(token) > 1)
            raise SceneError(f"joint '{twice}' stands twice in the skeleton; tokens must be unique")
        if np.any(self.parents >= np.arange(count)) or np.any(self.parents < -1):
            raise SceneError("a joint stands before its parent; parents must come first")

    @cached_property
    def index(self) -> dict[str, int]:
        """Where each joint token stands."""
        return {token: index for index, token in enumerate(self.joints)}

    def chain(self, joint: int) -> tuple[int, ...]:
        """Return a joint and all its ancestors, from the joint up."""
        chain = []
        while joint >= 0:
            chain.append(joint)
            joint = int(self.parents[joint])
        return tuple(chain)


@dataclass(frozen=True, eq=False)
class Body:
    """What a skeleton weighs and how far its joints turn; arrays parallel to its joints."""

    masses: Floats
    """Mass of the segment that each joint moves [kg], shape (joint_count,); only ratios count."""
    mass_centers: Floats
    """Centre of that mass in the joint's frame [m], shape (joint_count, 3)."""
    limits_min: Floats
    """Lower limit of the rotation vector of R_rest⁻¹R [degrees], shape (joint_count, 3)."""
    limits_max: Floats
    """Upper limit of the same [degrees]; ±inf is free."""
    stiffness: Floats
    """Resistance of each joint in 0..1, shape (joint_count,): 0 moves freely, 1 not at all."""
    priorities: Ints = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    """Which joint of a chain moves first, shape (joint_count,): the lower number; of equal ones the
    farther one from the root. None given are all equal."""

    def __post_init__(self) -> None:
        count = len(self.masses)
        _freeze(
            self,
            masses=seal(self.masses, count, name="masses"),
            mass_centers=seal(self.mass_centers, count, 3, name="mass_centers"),
            limits_min=seal(self.limits_min, count, 3, name="limits_min"),
            limits_max=seal(self.limits_max, count, 3, name="limits_max"),
            stiffness=seal(self.stiffness, count, name="stiffness"),
            priorities=seal(
                self.priorities if len(self.priorities) else np.zeros(count),
                count,
                dtype=np.int64,
                name="priorities",
            ),
        )
        ordered = self.limits_min <= self.limits_max
        turns = (self.limits_min <= 360.0) & (self.limits_max >= -360.0)
        for joint in np.flatnonzero(~(ordered & turns).all(axis=1)):
            raise SceneError(
                f"the limits of joint {joint} leave it no angle: from {self.limits_min[joint]} to "
                f"{self.limits_max[joint]} degrees; give lower ones that are not above the upper "
                "ones, and within a whole turn"
            )

    @classmethod
    def unknown(cls, joint_count: int) -> "Body":
        """Return the body of which nothing is known: no masses, no limits, no stiffness."""
        free = np.full((joint_count, 3), np.inf)
        zeros = np.zeros(joint_count)
        return cls(zeros, np.zeros((joint_count, 3)), -free, free, zeros)


@dataclass(frozen=True, eq=False)
class Motion:
    """The local transforms of a skeleton's joints over time."""

    times: Floats
    """Seconds, ascending, shape (frame_count,)."""
    translations: Floats
    """Position of each joint in its parent's frame [m], shape (frame_count, joint_count, 3).

    Rigid: scales of the joints above, of the skeleton and of the stage are in it already.
    """
    rotations: Floats
    """Orientation of each joint in its parent's frame, unit xyzw, (frame_count, joint_count, 4)."""

    def __post_init__(self) -> None:
        frames = len(self.times)
        joints = np.shape(self.rotations)[1] if np.ndim(self.rotations) == 3 else 0
        _freeze(
            self,
            times=seal(self.times, frames, name="times"),
            translations=seal(self.translations, frames, joints, 3, name="translations"),
            rotations=seal(self.rotations, frames, joints, 4, name="rotations"),
        )

    @property
    def frame_count(self) -> int:
        """Number of samples."""
        return len(self.times)

    def during(self, frames: slice) -> "Motion":
        """Return the motion on some of its frames."""
        return Motion(self.times[frames], self.translations[frames], self.rotations[frames])


@dataclass(frozen=True, eq=False)
class Placement:
    """Where a frame is in the world over time."""

    translations: Floats
    """World position [m], shape (frame_count, 3)."""
    rotations: Floats
    """World orientation, unit xyzw, shape (frame_count, 4)."""

    def __post_init__(self) -> None:
        frames = len(self.translations)
        _freeze(
            self,
            translations=seal(self.translations, frames, 3, name="translations"),
            rotations=seal(self.rotations, frames, 4, name="rotations"),
        )

    def during(self, frames: slice) -> "Placement":
        """Return the placement on some of its frames."""
        return Placement(self.translations[frames], self.rotations[frames])

    @classmethod
    def identity(cls, frame_count: int) -> "Placement":
        """Return the placement that is the world itself."""
        return cls(np.zeros((frame_count, 3)), np.tile((0.0, 0.0, 0.0, 1.0), (frame_count, 1)))


def between_samples(samples: Floats, times: Floats) -> tuple[Ints, Ints, Floats]:
    """Return which samples are before and after some times, and how far along each time is.

    Args:
        samples: Seconds, ascending, at least one, shape (sample_count,).
        times: Seconds, shape (time_count,); before the first and after the last they are held.

    Returns:
        Two indices and a share in 0..1 for each time, each of shape (time_count,).
    """
    last = len(samples) - 1
    before = np.clip(np.searchsorted(samples, times, side="right") - 1, 0, max(last - 1, 0))
    after = np.minimum(before + 1, last)
    span = samples[after] - samples[before]
    past = np.divide(times - samples[before], span, out=np.zeros(len(times)), where=span > 0.0)
    return before, after, np.clip(past, 0.0, 1.0)


def _freeze(value: object, **arrays: object) -> None:
    for name, array in arrays.items():
        object.__setattr__(value, name, array)

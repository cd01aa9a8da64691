"""Scale, which a rigid motion has none of: how many metres a unit is, in every frame it meets."""

from dataclasses import dataclass

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.usd.clips import sample
from usdmotion.usd.relations import bound_animation, clip_joints, is_a
from usdmotion.usd.shot import Facts, Rest, Samples
from usdmotion.usd.skeletons import Joints, read_joints
from usdmotion.usd.transforms import even, rigid, world_matrices

_STEADY = 1e-12
"""Relative change of a scale over time that comes from turning matrices."""


@dataclass(frozen=True, eq=False)
class Scaling:
    """Metres per unit in the frames of a skeleton; one frame stands for all where none changes."""

    of_space: Floats
    """In the skeleton's own space, shape (frame_count or 1,)."""
    of_parents: Floats
    """In the frame of each joint's parent, shape (frame_count or 1, joint_count)."""
    of_joints: Floats
    """Along the axes of each joint, shape (frame_count or 1, joint_count, 3)."""


def columns_of(clip: tuple[str, ...], joints: Joints) -> Ints:
    """Return which joint of a clip each joint of a skeleton is, -1 for none."""
    index = {token: column for column, token in enumerate(clip)}
    return np.array([index.get(token, -1) for token in joints.tokens], dtype=np.int64)


def needed_rest(joints: Joints, columns: Ints) -> Rest | None:
    """Return the rest pose of a skeleton.

    Raises:
        SceneError: There is none, and a joint that no animation moves needs it.
    """
    uncovered = np.flatnonzero(columns < 0)
    if len(uncovered) and joints.rest is None:
        token = joints.tokens[uncovered[0]]
        raise SceneError(f"{joints.rest_fault}, because no animation moves the joint '{token}'")
    return joints.rest


def spread(values: np.ndarray, columns: Ints, rest: Floats | None) -> Floats:
    """Return the values of a clip's joints as those of a skeleton's, rest where it has none."""
    if np.array_equal(columns, np.arange(values.shape[1])):
        return values.astype(np.float64)
    every = np.empty((len(values), len(columns), values.shape[2]))
    covered = columns >= 0
    every[:, covered] = values[:, columns[covered]]
    if rest is not None:
        every[:, ~covered] = rest[~covered]
    return every


def read_space(
    skeleton: Usd.Prim, time_codes: Floats, facts: Facts
) -> tuple[Floats, Floats, Floats]:
    """Return where a skeleton's space is [m], how it is turned, and its metres per unit.

    Raises:
        SceneError: It is scaled unevenly, mirrored or sheared.
    """
    name = f"<{skeleton.GetPath()}>"
    translations, rotations, scales = rigid(world_matrices(skeleton, time_codes), name)
    if not even(scales):
        raise SceneError(
            f"{name} is scaled unevenly by itself or a prim above it; make the scale uniform"
        )
    units = scales[:, 0] * facts.meters_per_unit
    if np.ptp(units) <= _STEADY * units[0]:
        units = units[:1]
    return translations * facts.meters_per_unit, rotations, units


def scaling_of(joints: Joints, of_space: Floats, scales: Floats) -> Scaling:
    """Return the scaling of a skeleton's frames from the scales of its joints.

    Args:
        joints: The skeleton.
        of_space: Metres per unit in its space, shape (frame_count or 1,).
        scales: Scale of each joint, shape (frame_count or 1, joint_count, 3).
    """
    of_parents = np.empty((max(len(of_space), len(scales)), len(joints.tokens)))
    for joint, parent in enumerate(joints.parents):
        of_parents[:, joint] = (
            of_parents[:, parent] * scales[:, parent, 0] if parent >= 0 else of_space
        )
    return Scaling(of_space, of_parents, of_parents[..., None] * scales)


def joint_scales(
    joints: Joints, samples: Samples, columns: Ints, rest: Rest | None, name: str
) -> Floats:
    """Return the scales of all joints, (frame_count or 1, joint_count, 3).

    Raises:
        SceneError: A joint with others below it is scaled unevenly or to nothing.
    """
    bits = samples.scales.view(np.uint16)  # halves are slow to compare
    values = samples.scales[: 1 if (bits == bits[:1]).all() else None]
    scales = spread(values, columns, rest.scales if rest else None)
    for joint in np.unique(joints.parents[joints.parents >= 0]):
        own = scales[:, joint]
        if not even(own):
            raise SceneError(
                f"{name} scales the joint '{joints.tokens[joint]}' unevenly, which shears the "
                "joints below it; make its scale the same along the three axes"
            )
        # A negative one mirrors through a point, which changes places with every rotation: it is
        # nothing but a negative unit for what is below.
        if not own.all():
            raise SceneError(
                f"{name} scales the joint '{joints.tokens[joint]}' to nothing; give it a scale "
                "that is not zero"
            )
    return scales


def joint_units(
    stage: Usd.Stage, skeleton: str, token: str, time_codes: Floats, facts: Facts
) -> Floats:
    """Return metres per unit along the axes of a joint, (frame_count or 1, 3).

    Raises:
        SceneError: There is no such joint, or its scale is not one that a motion can have.
    """
    prim = stage.GetPrimAtPath(skeleton) if skeleton else None
    if not prim or not is_a(prim, "UsdSkelSkeleton"):
        raise SceneError(f"there is no Skeleton <{skeleton}>; author it before what it is held by")
    joints = read_joints(prim)
    if token not in joints.tokens:
        raise SceneError(f"<{skeleton}> has no joint '{token}'; name one of its joints")
    animation = bound_animation(prim)
    columns = columns_of(clip_joints(animation), joints)
    rest = needed_rest(joints, columns)
    samples = sample(animation, time_codes)
    scales = joint_scales(joints, samples, columns, rest, f"<{skeleton}>")
    _, _, of_space = read_space(prim, time_codes, facts)
    return scaling_of(joints, of_space, scales).of_joints[:, joints.tokens.index(token)]

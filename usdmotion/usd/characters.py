"""A skeleton and its animation, in metres: the rigid motion that UsdSkel shows."""

from dataclasses import dataclass

import numpy as np
from pxr import Usd

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.cast import Character
from usdmotion.errors import SceneError
from usdmotion.motion import Motion, Placement, Skeleton
from usdmotion.usd.clips import clip_joints, own_times, resample, sample
from usdmotion.usd.faults.skeletons import find_unreadable_animations
from usdmotion.usd.scaling import (
    Scaling,
    columns_of,
    joint_scales,
    needed_rest,
    read_space,
    scaling_of,
    spread,
)
from usdmotion.usd.shot import Facts, Rest, Samples
from usdmotion.usd.skeletons import Joints, pelvis_of, read_body, read_joints
from usdmotion.usd.stages import refuse

_UNIT = 1e-3
"""How far the square of a quaternion may be from one before it is no rotation any more."""
_STILL = 1e-3
"""Share of a usual joint's length below which the travel of a joint is noise."""


@dataclass(frozen=True, eq=False)
class Sitting:
    """A character as it was read, with all that leads back from it to its prims."""

    character: Character
    joints: Joints
    clip: tuple[str, ...]
    """Joint tokens of the animation, in its own order."""
    columns: Ints
    """Which of those each joint is, -1 for none."""
    own: Samples
    """The animation at its own times."""
    solved: Samples
    """The animation at the times that were asked for."""
    scaling: Scaling


def read_character(
    skeleton: Usd.Prim, animation: Usd.Prim | None, time_codes: Floats, facts: Facts
) -> Sitting:
    """Return a character at some times.

    Args:
        skeleton: The Skeleton prim.
        animation: The SkelAnimation that moves it; None leaves it at rest.
        time_codes: When, shape (frame_count,).
        facts: Units and rates of the stage.

    Raises:
        SceneError: The motion is not rigid, or cannot be told without guessing.
    """
    joints, clip = read_joints(skeleton), clip_joints(animation)
    columns = columns_of(clip, joints)
    _require_match(animation, clip, columns, joints)
    rest = needed_rest(joints, columns)
    own = sample(animation, own_times(animation))
    solved = resample(own, animation, time_codes)
    name = f"<{animation.GetPath()}>" if animation else f"<{joints.path}>"
    placed, turned, of_space = read_space(skeleton, time_codes, facts)
    scales = joint_scales(joints, solved, columns, rest, name)
    scaling = scaling_of(joints, of_space, scales)
    motion = _motion(solved, columns, rest, scaling, facts, name)
    frames = len(time_codes)
    character = Character(
        path=joints.path,
        skeleton=_skeleton(joints, of_space[:1], motion),
        body=read_body(skeleton, joints, scaling.of_joints[0]),
        motion=motion,
        placement=Placement(
            np.broadcast_to(placed, (frames, 3)), np.broadcast_to(turned, (frames, 4))
        ),
        root=root_joint(skeleton, joints, own, columns),
    )
    return Sitting(character, joints, clip, columns, own, solved, scaling)


def _require_match(
    animation: Usd.Prim | None, clip: tuple[str, ...], columns: Ints, joints: Joints
) -> None:
    if animation is None or not clip:
        return
    if len(set(clip)) < len(clip):
        refuse(list(find_unreadable_animations(animation)))
    if (columns < 0).all():
        raise SceneError(
            f"<{animation.GetPath()}> has none of the joints of <{joints.path}>; name another "
            "animation, or rename its joints"
        )


def _motion(
    solved: Samples,
    columns: Ints,
    rest: Rest | None,
    scaling: Scaling,
    facts: Facts,
    name: str,
) -> Motion:
    codes = solved.time_codes
    translations = spread(solved.translations, columns, rest.translations if rest else None)
    translations *= scaling.of_parents[..., None]
    if not np.isfinite(translations.sum()):
        raise SceneError(f"{name} has a translation that is not a number; author it again")
    rotations = spread(solved.rotations, columns, rest.rotations if rest else None)
    _normalize(rotations, name)
    for array in (translations, rotations):
        array.flags.writeable = False  # nobody else has it, so it need not be copied
    return Motion((codes - codes[0]) / facts.time_codes_per_second, translations, rotations)


def _normalize(rotations: Floats, name: str) -> None:
    """Bring quaternions to length one; USD shows one without length as no rotation."""
    squares = np.einsum("fji,fji->fj", rotations, rotations)
    fine = np.abs(squares - 1.0) < _UNIT
    if not fine.all():
        nothing = squares == 0.0
        if not (fine | nothing).all():
            raise SceneError(
                f"{name} has a rotation that is not a quaternion of length one, which shears; "
                "normalize its rotations"
            )
        rotations[nothing] = (0.0, 0.0, 0.0, 1.0)
        squares[nothing] = 1.0
    rotations /= np.sqrt(squares)[..., None]


def _skeleton(joints: Joints, of_space: Floats, motion: Motion) -> Skeleton:
    """Return a skeleton in metres; its first pose is its rest where it has no other."""
    if joints.rest is None:
        rest = motion.translations[0], motion.rotations[0]
    else:
        units = scaling_of(joints, of_space, joints.rest.scales[None]).of_parents[0]
        rest = joints.rest.translations * units[:, None], joints.rest.rotations
    return Skeleton(joints.tokens, joints.parents, *rest)


def root_joint(skeleton: Usd.Prim, joints: Joints, own: Samples, columns: Ints) -> int:
    """Return the joint with six degrees of freedom.

    It is the pelvis where the skeleton names one, else the topmost joint that travels and carries
    at least half of all joints (a knee that stretches does not), else the top joint.

    Args:
        skeleton: The Skeleton prim.
        joints: Its joints.
        own: The animation at its own times.
        columns: Which joint of the animation each joint is, -1 for none.
    """
    pelvis = pelvis_of(skeleton)
    if pelvis is not None:
        return pelvis
    carried = np.ones(len(joints.tokens))
    for joint in range(len(carried) - 1, -1, -1):
        if joints.parents[joint] >= 0:
            carried[joints.parents[joint]] += carried[joint]
    depths = np.zeros(len(carried))
    for joint, parent in enumerate(joints.parents):
        depths[joint] = depths[parent] + 1 if parent >= 0 else 0
    fit = _travels(own, columns) & (2 * carried >= len(carried))
    return int(np.argmin(np.where(fit, depths, depths + len(depths))))


def _travels(own: Samples, columns: Ints) -> Bools:
    """Return which joints of a skeleton change their translation over time."""
    if len(own.time_codes) < 2:
        return np.zeros(len(columns), dtype=np.bool_)
    travel = np.ptp(own.translations, axis=0).max(axis=-1)
    lengths = np.linalg.norm(own.translations[0], axis=-1)
    length = np.median(lengths[lengths > 0.0]) if lengths.any() else 0.0
    return np.where(columns >= 0, (travel > _STILL * length)[columns], False)

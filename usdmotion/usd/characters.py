"""A skeleton and its animation, in metres: the rigid motion that UsdSkel shows."""

from dataclasses import dataclass

import numpy as np
from pxr import Usd

from usdmotion.anthropometry import with_masses
from usdmotion.arrays import Floats, Ints
from usdmotion.cast import Character
from usdmotion.errors import SceneError
from usdmotion.humanoid import recognize
from usdmotion.motion import Motion, Placement, Skeleton
from usdmotion.usd.clips import own_times, resample, sample
from usdmotion.usd.faults.skeletons import find_unreadable_animations
from usdmotion.usd.relations import clip_joints
from usdmotion.usd.roots import parts_of, root_joint, travelling
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
from usdmotion.usd.skeletons import Joints, read_body, read_joints
from usdmotion.usd.stages import refuse

_UNIT = 1e-3
"""How far the square of a quaternion may be from one before it is no rotation any more."""


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
    shape = _skeleton(joints, of_space[:1], motion)
    parts = recognize(shape, parts_of(skeleton, len(joints.tokens)))
    body = read_body(skeleton, joints, scaling.of_joints[0])
    body, masses_from = with_masses(shape, body, parts)
    character = Character(
        path=joints.path,
        skeleton=shape,
        body=body,
        masses_from=masses_from,
        motion=motion,
        placement=Placement(
            np.broadcast_to(placed, (frames, 3)), np.broadcast_to(turned, (frames, 4))
        ),
        parts=parts,
        root=root_joint(skeleton, joints.parents, travelling(own.translations, columns)),
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

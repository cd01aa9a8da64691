"""Which joint of a skeleton has six degrees of freedom in a solve.

Readers, checks and `inspect` all ask here, so that they never differ.
"""

import numpy as np
from pxr import Usd, UsdSkel

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.errors import SceneError
from usdmotion.humanoid import pelvis
from usdmotion.motion import Skeleton
from usdmotion.usd.relations import clip_joints, joints_of, value
from usdmotion.usd.shot import Singles

_STILL = 1e-3
"""Share of a usual joint's length below which the travel of a joint is noise."""


def root_of(skeleton: Usd.Prim, animation: Usd.Prim | None) -> int:
    """Return the root of a solve of a skeleton that starts from an animation.

    Args:
        skeleton: A Skeleton with at least one joint.
        animation: The SkelAnimation; None leaves it at rest.
    """
    joints, clip = joints_of(skeleton), clip_joints(animation)
    parents = np.array(UsdSkel.Topology(list(joints)).GetParentIndices(), dtype=np.int64)
    columns = np.array([clip.index(each) if each in clip else -1 for each in joints])
    return root_joint(skeleton, parents, travelling(_translations(animation, len(clip)), columns))


def root_joint(skeleton: Usd.Prim, parents: Ints, travels: Bools) -> int:
    """Return the joint with six degrees of freedom.

    It is the pelvis where the skeleton says or shows which joint that is, else the topmost joint
    that travels and carries at least half of all joints (a knee that stretches does not), else the
    top joint.

    Args:
        skeleton: The Skeleton prim.
        parents: Parent of each of its joints, -1 for none.
        travels: Which of them change their translation over time.
    """
    shape = in_rest(skeleton, parents)
    known = pelvis(shape, parts_of(skeleton, len(parents))) if shape is not None else None
    if known is not None:
        return known
    carried = np.ones(len(parents))
    for joint in range(len(parents) - 1, -1, -1):
        if parents[joint] >= 0:
            carried[parents[joint]] += carried[joint]
    depths = np.zeros(len(parents))
    for joint, parent in enumerate(parents):
        depths[joint] = depths[parent] + 1 if parent >= 0 else 0
    fit = travels & (2 * carried >= len(parents))
    return int(np.argmin(np.where(fit, depths, depths + len(depths))))


def in_rest(skeleton: Usd.Prim, parents: Ints) -> Skeleton | None:
    """Return the joints of a Skeleton in their rest pose, which may be nowhere; None if unsound."""
    tokens, count = joints_of(skeleton), len(parents)
    matrices = np.array(value(skeleton, "restTransforms", ()), dtype=np.float64)
    places = matrices[:, 3, :3] if matrices.shape == (count, 4, 4) else np.zeros((count, 3))
    try:
        return Skeleton(tokens, parents, places, np.tile((0.0, 0.0, 0.0, 1.0), (count, 1)))
    except SceneError:
        return None  # other checks say so


def parts_of(skeleton: Usd.Prim, count: int) -> tuple[str, ...]:
    """Return the parts that a Skeleton names, none where they are not one for each joint."""
    parts = tuple(str(part) for part in value(skeleton, "usdmotion:parts", ()))
    return parts if len(parts) == count else ()


def travelling(translations: Floats | Singles, columns: Ints) -> Bools:
    """Return which joints of a skeleton change their translation over time.

    Args:
        translations: Those of an animation's joints at its own times, (sample_count, any, 3).
        columns: Which of its joints each joint of the skeleton is, -1 for none, (joint_count,).
    """
    if len(translations) < 2:
        return np.zeros(len(columns), dtype=np.bool_)
    travel = np.ptp(translations, axis=0).max(axis=-1)
    lengths = np.linalg.norm(translations[0], axis=-1)
    length = np.median(lengths[lengths > 0.0]) if lengths.any() else 0.0
    return np.where(columns >= 0, (travel > _STILL * length)[columns], False)


def _translations(animation: Usd.Prim | None, count: int) -> Floats:
    """Return the translations of an animation; none where USD would not show them."""
    nothing = np.zeros((0, count, 3))
    if animation is None or count == 0:
        return nothing
    attribute = UsdSkel.Animation(animation).GetTranslationsAttr()
    values = [np.asarray(attribute.Get(time)) for time in attribute.GetTimeSamples()]
    if any(each.shape != (count, 3) for each in values):
        return nothing  # other checks say so
    return np.stack(values) if values else nothing

"""The body on a stage that a motion is put on, and what is written there."""

from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology
from usdmotion.travelling import Luggage, Meanings, Way, bodies
from usdmotion.usd.bindings import holder_of
from usdmotion.usd.characters import Sitting, read_character
from usdmotion.usd.concerns import concerns
from usdmotion.usd.drawn import without_guides
from usdmotion.usd.layers import apply_schema, over, relate, write_animation
from usdmotion.usd.normalized.subjects import bodies_of, morphology_of
from usdmotion.usd.relations import bound_animation, is_a
from usdmotion.usd.shot import Facts, Samples
from usdmotion.usd.skeletons import read_joints
from usdmotion.usd.stages import refuse


@dataclass(frozen=True, eq=False)
class Target:
    """A body on a stage, at rest, wherever the prims above it carry it."""

    skeleton: Usd.Prim
    sitting: Sitting
    morphology: Morphology
    holder: str
    """Path of the prim on which an animation is bound."""
    time_codes: Floats
    """Time code of each frame."""

    @property
    def path(self) -> str:
        """Path of the Skeleton."""
        return str(self.skeleton.GetPath())


def find_target(stage: Usd.Stage, named: str) -> Usd.Prim:
    """Return the Skeleton that is meant.

    Args:
        stage: The stage.
        named: Its path; "" is the only one.

    Raises:
        SceneError: There are several, or none, or not that one.
    """
    everything = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    prims = without_guides(everything)
    known = {str(prim.GetPath()): prim for prim in prims if is_a(prim, "UsdSkelSkeleton")}
    if not known:
        raise SceneError("there is no Skeleton to put the motion on; name another stage")
    if named and named not in known:
        raise SceneError(f"<{named}> is no Skeleton; there are: {', '.join(known)}")
    if not named and len(known) > 1:
        raise SceneError(
            f"there are several Skeletons, {', '.join(known)}; name one with --skeleton"
        )
    return known[named] if named else next(iter(known.values()))


def read_target(skeleton: Usd.Prim, time_codes: Floats, facts: Facts) -> Target:
    """Return a body that a motion can be put on.

    Args:
        skeleton: The Skeleton.
        time_codes: Time code of each frame.
        facts: Units and rates of its stage.

    Raises:
        SceneError: It is no human body, has no rest pose, or no animation can be bound to it.
    """
    refuse(concerns(skeleton))
    at_rest = read_joints(skeleton).rest is not None
    animation = None if at_rest else bound_animation(skeleton)
    sitting = read_character(skeleton, animation, time_codes, facts)
    morphology = morphology_of(skeleton, sitting)
    return Target(skeleton, sitting, morphology, holder_of(skeleton), time_codes)


def author_animation(stage: Usd.Stage, target: Target, motion: Motion) -> str:
    """Write a motion of a body beside it and bind it, in the edit target of a stage.

    Returns:
        Path of the SkelAnimation.
    """
    path = free(stage, f"{target.holder}_retargeted")
    scaling, frames = target.sitting.scaling, motion.frame_count
    scales = (scaling.of_joints / scaling.of_parents[..., None])[:1]
    samples = Samples(
        time_codes=target.time_codes,
        translations=(motion.translations / scaling.of_parents[..., None]).astype(np.float32),
        rotations=_continuous(motion.rotations).astype(np.float32),
        scales=np.broadcast_to(scales, (frames, *scales.shape[1:])).astype(np.float16),
    )
    layer = stage.GetEditTarget().GetLayer()
    with Sdf.ChangeBlock():
        prim = over(layer, path)
        write_animation(prim, target.morphology.skeleton.joints, samples, ("scales",))
        holder = over(layer, target.holder)
        apply_schema(holder, "SkelBindingAPI")
        relate(holder, "skel:animationSource", path)
    return path


def edit_path(stage: Usd.Stage, target: Target, name: str) -> str:
    """Return where an edit of a body goes: under its Skeleton, beside what nothing goes under."""
    inside = target.holder != target.path
    return free(stage, f"{target.holder}_{name}" if inside else f"{target.path}/{name}")


def free(stage: Usd.Stage, path: str) -> str:
    """Return a path that no prim has, the given one if that is free."""
    number, found = 1, path
    while stage.GetPrimAtPath(found):
        number += 1
        found = f"{path}{number}"
    return found


def set_range(stage: Usd.Stage, first: float, last: float) -> None:
    """Let a stage show a motion from its first time code to its last, whatever it showed before."""
    stage.SetStartTimeCode(first)
    stage.SetEndTimeCode(last)


def _continuous(rotations: Floats) -> Floats:
    """Return rotations with the signs that make them change little from frame to frame."""
    flips = np.einsum("fji,fji->fj", rotations[1:], rotations[:-1]) < 0.0
    signs = np.where(np.cumsum(flips, axis=0) % 2, -1.0, 1.0)
    return np.concatenate([rotations[:1], rotations[1:] * signs[..., None]])


def ways_onto(stage: Usd.Stage, target: Target, luggage: Luggage, facts: Facts) -> dict[str, Way]:
    """Return the way onto each body that what travels may be about, by what stands for it.

    Args:
        stage: The stage of the target.
        target: The body that the motion is put on.
        luggage: What travels.
        facts: Units and rates of the stage.
    """
    own = Meanings.of(target.path, target.morphology, facts.up)
    known = luggage.motion.segments
    ways = {each: Way(own, True, target.path, known) for each in (luggage.prim, luggage.source)}
    for path in {body for each in luggage.travellers for body in bodies(each)} - set(ways):
        prim = stage.GetPrimAtPath(path)
        if is_a(prim, "UsdSkelSkeleton"):
            sitting = read_character(prim, bound_animation(prim), target.time_codes, facts)
            for other, body in bodies_of(stage, {path: sitting}):
                ways[other] = Way(Meanings.of(other, body, facts.up), True, other)
    return ways

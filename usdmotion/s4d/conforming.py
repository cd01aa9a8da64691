"""Normalized motions of different bodies told by the same parts, so that they can be mixed."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.humanoid import SPINE
from usdmotion.kernels import conjugate, multiply
from usdmotion.s4d.bodies.places import ENDS, ROOT
from usdmotion.s4d.chains import spine_points
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.postures import Postures, seen_from_carriers
from usdmotion.s4d.turns import IDENTITY

_ANKLES = (ENDS[1], ENDS[3])
_GIRDLES = ("sacroiliac", "sternoclavicular", "acromioclavicular")
"""What limbs hang on: where it is unknown, it is at rest."""


def conformed(motions: Sequence[NormalizedMotion]) -> list[NormalizedMotion]:
    """Return motions with the parts and joints of the first, carried by the same.

    Where another one does not know a finger or a joint, it does what the first does.
    """
    first = motions[0]
    carriers = tuple(dict.fromkeys(name for each in motions for name in _carriers(each)))
    if not any(each.carriers for each in motions):
        carriers = ()
    alike = [first, *(_with_parts(each, first) for each in motions[1:])]
    return [_carried(each, carriers) for each in alike]


def _with_parts(motion: NormalizedMotion, first: NormalizedMotion) -> NormalizedMotion:
    motion = replace(
        motion,
        extra_joints=first.extra_joints,
        extra_rotations=_chosen(
            (motion.extra_joints, motion.extra_rotations),
            first.extra_joints,
            first.extra_rotations,
        ),
        offset_joints=first.offset_joints,
        offsets=_chosen((motion.offset_joints, motion.offsets), first.offset_joints, first.offsets),
    )
    same = motion.segments == first.segments and motion.limbs == first.limbs
    return motion if same else _with_segments(motion, first)


def _with_segments(motion: NormalizedMotion, first: NormalizedMotion) -> NormalizedMotion:
    unknown = []

    def at_rest(part: str, above: str) -> Floats:
        unknown.append(part)
        return IDENTITY

    postures = Postures(motion)
    lengths = np.linalg.norm(np.diff(first.spine, axis=1), axis=-1).mean(axis=0)
    turned = postures.on((ROOT, *first.limbs, *first.segments), lengths, at_rest)
    limbs = {limb: postures.limbs[limb] for limb in first.limbs}
    frames, rotations = seen_from_carriers(turned, limbs, first.segments)
    for part in unknown:
        if not part.endswith(_GIRDLES):
            place = first.segments.index(part)
            rotations[:, place] = first.segment_rotations[:, place]
    places = [motion.limbs.index(limb) for limb in first.limbs]
    back = np.stack([turned[part] for part in SPINE if part in first.segments], axis=1)
    return replace(
        motion,
        limbs=first.limbs,
        limb_frames=frames,
        limb_lengths=motion.limb_lengths[:, places],
        limb_twists=motion.limb_twists[:, places],
        segments=first.segments,
        segment_rotations=rotations,
        spine=spine_points(lengths[None], multiply(conjugate(turned[ROOT])[:, None], back)),
    )


def _chosen(told: tuple[Sequence[str], Floats], wanted: Sequence[str], otherwise: Floats) -> Floats:
    """Return what a motion tells of some joints, and something else of those it does not know."""
    tokens, values = told
    chosen = np.array(otherwise)
    for place, token in enumerate(wanted):
        if token in tokens:
            chosen[:, place] = values[:, tokens.index(token)]
    return chosen


def _carriers(motion: NormalizedMotion) -> tuple[str, ...]:
    return motion.carriers or _ANKLES


def _carried(motion: NormalizedMotion, carriers: tuple[str, ...]) -> NormalizedMotion:
    """Return a motion that tells the share of each of some joints that carry the root."""
    own = motion.carrier_shares
    if not motion.carriers:
        own = np.full((len(motion.times), 2), 0.5)
    shares = np.zeros((len(motion.times), len(carriers)))
    for place, part in enumerate(carriers):
        if part in _carriers(motion):
            shares[:, place] = own[:, _carriers(motion).index(part)]
    return replace(motion, carriers=carriers, carrier_shares=shares)

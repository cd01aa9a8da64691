"""From the normalized motion to a motion of a body (2005, sections 6 and 8)."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, forward, multiply, rotate
from usdmotion.motion import Motion, Placement
from usdmotion.s4d.bodies import Limb, Measures, Morphology
from usdmotion.s4d.bodies.places import ROOT
from usdmotion.s4d.carrying import carried_heights
from usdmotion.s4d.limbs import aligned, unfold
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.postures import Postures
from usdmotion.s4d.turns import Y, continuous, swing


def restore(
    normalized: NormalizedMotion,
    morphology: Morphology,
    placement: Placement,
    *,
    up: Floats,
    translations: Floats | None = None,
) -> Motion:
    """Return the motion of a body.

    Args:
        normalized: What to do.
        morphology: The body that does it.
        placement: Where its skeleton's space is, at the times of the motion.
        up: The direction away from the ground in the world, shape (3,).
        translations: Of its joints at rest where it grows [m], shape (F, joint_count, 3).

    Raises:
        SceneError: The motion is not that of a whole body.
    """
    upright = swing(up / np.linalg.norm(up), Y)
    measures = morphology.measures if translations is None else morphology.measured(translations)
    local = _translations(normalized, morphology, measures, translations)
    rotations = _extras(normalized, morphology)
    wanted = _orientations(normalized, morphology, local, rotations)
    _make_local(morphology, wanted, multiply(upright, placement.rotations), rotations)
    hips = rotate(conjugate(upright), _hips(normalized, measures)) - placement.translations
    _place_root(morphology, rotate(conjugate(placement.rotations), hips), local, rotations)
    return Motion(normalized.times, local, continuous(rotations))


def _translations(
    normalized: NormalizedMotion,
    body: Morphology,
    measures: Measures,
    growing: Floats | None,
) -> Floats:
    """Return where joints are in their parents [m], (F, J, 3); the root is not placed yet."""
    skeleton = body.skeleton
    frames = len(normalized.times)
    rest = skeleton.rest_translations if growing is None else growing
    local = np.array(np.broadcast_to(rest, (frames, len(skeleton.joints), 3)))
    for joint, theirs in _matches(normalized.offset_joints, body):
        away = rotate(body.frames_above[joint], normalized.offsets[:, theirs])
        local[:, joint] += measures.leg[:, None] * away
    return local


def _extras(normalized: NormalizedMotion, body: Morphology) -> Floats:
    """Return the rotations of the joints that are no parts, (F, J, 4); the others are at rest."""
    skeleton = body.skeleton
    frames = len(normalized.times)
    rotations = np.array(
        np.broadcast_to(skeleton.rest_rotations, (frames, len(skeleton.joints), 4))
    )
    for joint, theirs in _matches(normalized.extra_joints, body):
        if not body.parts.parts[joint]:
            seen = multiply(body.frames_above[joint], normalized.extra_rotations[:, theirs])
            rotations[:, joint] = multiply(seen, conjugate(body.part_frames[joint]))
    return rotations


def _matches(tokens: tuple[str, ...], body: Morphology) -> list[tuple[int, int]]:
    """Return the joints that some tokens name, by the token or by its last name where it is alone.

    A joint comes with where its token stands.
    """
    found: dict[int, int] = {}
    leaves = [token.rpartition("/")[2] for token in body.skeleton.joints]
    for place, token in enumerate(tokens):
        leaf = token.rpartition("/")[2]
        joint = body.skeleton.index.get(token)
        if joint is None and leaves.count(leaf) == 1:
            joint = leaves.index(leaf)
        if joint is not None and joint != body.parts.joint(ROOT):
            found.setdefault(joint, place)
    return list(found.items())


def _orientations(
    normalized: NormalizedMotion, body: Morphology, local: Floats, rotations: Floats
) -> dict[int, Floats]:
    """Return the orientation of every joint that is a part in the world, y up, each (F, 4)."""
    postures = Postures(normalized)
    wanted = {}
    parts = filter(None, body.parts.parts)
    for part, turned in postures.on(parts, body.measures.spine[0], body.at_rest).items():
        joint = body.joint(part)
        wanted[joint] = multiply(turned, conjugate(body.part_frames[joint]))
    for index, limb in enumerate(body.limbs):
        ways = [_way(body, pair, local, rotations) for pair in _pairs(limb)]
        frames = unfold(
            postures.limbs[limb.name],
            normalized.limb_lengths[:, index],
            normalized.limb_twists[:, index],
            *(np.linalg.norm(way, axis=-1) for way in ways),
        )
        for joint, way, frame in zip((limb.top, limb.middle), ways, frames, strict=True):
            own = multiply(body.part_frames[joint], body.basis(limb))
            wanted[joint] = multiply(frame, conjugate(aligned(own, way)))
    return wanted


def _pairs(limb: Limb) -> tuple[tuple[int, int], tuple[int, int]]:
    return (limb.top, limb.middle), (limb.middle, limb.end)


def _way(body: Morphology, pair: tuple[int, int], local: Floats, rotations: Floats) -> Floats:
    """Return where a joint is in the frame of one above it [m], shape (F, 3)."""
    above, joint = pair
    place = local[:, joint]
    while (joint := int(body.skeleton.parents[joint])) != above:
        place = local[:, joint] + rotate(rotations[:, joint], place)
    return place


def _make_local(
    body: Morphology, wanted: dict[int, Floats], turn: Floats, rotations: Floats
) -> None:
    """Turn the orientations of parts in the world, y up, into rotations in their parents."""
    orientations: list[Floats] = []
    for joint, parent in enumerate(body.skeleton.parents):
        above = orientations[parent] if parent >= 0 else turn
        if joint in wanted:
            orientations.append(wanted[joint])
            rotations[:, joint] = multiply(conjugate(above), wanted[joint])
        else:
            orientations.append(multiply(above, rotations[:, joint]))


def _hips(normalized: NormalizedMotion, measures: Measures) -> Floats:
    """Return the middle of the hip joints in the world, y up [m], shape (F, 3)."""
    root = normalized.root_position
    stand, length = carried_heights(measures, normalized.carriers, normalized.carrier_shares)
    leg = np.broadcast_to(measures.leg, len(root))
    hips = root * leg[:, None]
    # What grows on the way goes on from where it is: it does not move away from the world's origin.
    steps = np.diff(root, axis=0) * (0.5 * (leg[1:] + leg[:-1]))[:, None]
    if np.ptp(leg) > 0.0:
        hips = hips[:1] + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    hips[:, 1] = root[:, 1] * length + stand
    return np.asarray(hips)


def _place_root(body: Morphology, hips: Floats, local: Floats, rotations: Floats) -> None:
    """Move the pelvis until the middle of the hips is somewhere in the skeleton's space, (F, 3)."""
    parents, root = body.skeleton.parents, body.joint(ROOT)
    positions, orientations = forward(parents, local, rotations)
    left, right = (positions[:, body.joint(f"{side}_hip")] for side in "lr")
    away = hips - 0.5 * (left + right)
    if parents[root] >= 0:
        away = rotate(conjugate(orientations[:, parents[root]]), away)
    local[:, root] += away

"""From a motion of a body to the normalized motion (2005, section 4)."""

from collections.abc import Sequence

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.humanoid import PARTS
from usdmotion.kernels import conjugate, forward, multiply, rotate
from usdmotion.motion import Motion, Placement
from usdmotion.s4d.bodies import Morphology
from usdmotion.s4d.bodies.places import MIDDLES, ROOT, TOPS
from usdmotion.s4d.carrying import Held, carried_heights, carriers_of
from usdmotion.s4d.chains import spine_points
from usdmotion.s4d.limbs import aligned, fold
from usdmotion.s4d.normalized import NormalizedMotion
from usdmotion.s4d.postures import seen_from_carriers
from usdmotion.s4d.roots import split_heading
from usdmotion.s4d.turns import Y, continuous, swing

_STILL = 2e-6
"""Translation of a joint away from rest that is none, over leg length."""


def normalize(
    motion: Motion,
    placement: Placement,
    morphology: Morphology,
    *,
    up: Floats,
    held: Sequence[Held] = (),
) -> NormalizedMotion:
    """Return a motion without the body that it was recorded on.

    Args:
        motion: Of the body's skeleton.
        placement: Where the skeleton's space is, on the same frames.
        morphology: The body, with the lengths that it has in the motion (`Morphology.of` with
            poses): what is elsewhere than those say moves, and does so on every body.
        up: The direction away from the ground in the world, shape (3,).
        held: Its contacts: which part, from when to when [s]. They tell what carries the root; a
            motion without any stands on its feet.
    """
    body = _Posed(motion, placement, morphology, up)
    segments = tuple(part for part in PARTS if body.has(part) and part not in _LIMB_PARTS)
    limbs, lengths, twists = body.limbs()
    turned = {part: body.of(part) for part in (ROOT, *segments)}
    tops = dict(zip(TOPS, np.moveaxis(limbs, 1, 0), strict=True))
    frames, rotations = seen_from_carriers(turned, tops, segments)
    heading, orientation = split_heading(body.of(ROOT))
    extras, offsets = body.extras(), body.offsets()
    back = multiply(conjugate(body.of(ROOT))[:, None], body.canonical[:, morphology.parts.spine])
    carriers, shares = carriers_of(motion.times, held)
    return NormalizedMotion(
        times=motion.times,
        limbs=TOPS,
        limb_frames=frames,
        limb_lengths=lengths,
        limb_twists=twists,
        segments=segments,
        segment_rotations=rotations,
        spine=spine_points(morphology.measures.spine, back),
        root_position=body.root(carriers, shares),
        root_heading=heading,
        root_orientation=orientation,
        carriers=carriers,
        carrier_shares=shares,
        extra_joints=extras[0],
        extra_rotations=extras[1],
        offset_joints=offsets[0],
        offsets=offsets[1],
    )


_LIMB_PARTS = (ROOT, *TOPS, *MIDDLES)


class _Posed:
    """A body in its postures, in a world whose y is up."""

    def __init__(self, motion: Motion, placement: Placement, body: Morphology, up: Floats) -> None:
        positions, orientations = forward(
            body.skeleton.parents, motion.translations, motion.rotations
        )
        upright = swing(up / np.linalg.norm(up), Y)
        turn = multiply(upright, placement.rotations)[:, None]
        self.motion, self.body = motion, body
        self.positions = rotate(turn, positions) + rotate(upright, placement.translations)[:, None]
        self.orientations = multiply(turn, orientations)
        self.canonical = multiply(self.orientations, body.part_frames)

    def has(self, part: str) -> bool:
        return self.body.parts.joint(part) is not None

    def of(self, part: str) -> Floats:
        """Return the canonical orientation of a part, shape (F, 4)."""
        return np.asarray(self.canonical[:, self.body.joint(part)])

    def limbs(self) -> tuple[Floats, Floats, Floats]:
        """Return the frames of the limbs in the world, their lengths and twists."""
        body, limbs = self.body, self.body.limbs
        joints = np.array([(limb.top, limb.middle, limb.end) for limb in limbs]).T
        bases = np.array([body.basis(limb) for limb in limbs])
        tops, middles, ends = (self.positions[:, row] for row in joints)
        ways = middles - tops, ends - middles
        upper, lower = (
            aligned(multiply(self.canonical[:, row], bases), way)
            for row, way in zip(joints[:2], ways, strict=True)
        )
        return fold(ways, (upper, lower))

    def root(self, carriers: tuple[str, ...], shares: Floats) -> Floats:
        """Return the normalized place of the root, shape (F, 3)."""
        hips = [self.positions[:, self.body.joint(f"{side}_hip")] for side in "lr"]
        place = 0.5 * (hips[0] + hips[1])
        stand, length = carried_heights(self.body.measures, carriers, shares)
        root = place / self.body.leg_length
        root[:, 1] = (place[:, 1] - stand) / length
        return np.asarray(root)

    def extras(self) -> tuple[tuple[str, ...], Floats]:
        """Return the joints that are no parts, and how each is turned away from rest."""
        body, skeleton = self.body, self.body.skeleton
        joints = np.flatnonzero([not part for part in body.parts.parts])
        above = body.frames_above[joints]
        turned = multiply(self.motion.rotations[:, joints], body.part_frames[joints])
        tokens = tuple(skeleton.joints[joint] for joint in joints)
        return tokens, continuous(multiply(conjugate(above), turned))

    def offsets(self) -> tuple[tuple[str, ...], Floats]:
        """Return the joints that are translated, and how far over leg length."""
        body, skeleton = self.body, self.body.skeleton
        away = (self.motion.translations - skeleton.rest_translations) / body.leg_length
        moved = np.abs(away).max(axis=(0, 2), initial=0.0) > _STILL
        moved[body.joint(ROOT)] = False
        joints = np.flatnonzero(moved)
        tokens = tuple(skeleton.joints[joint] for joint in joints)
        return tokens, rotate(conjugate(body.frames_above[joints]), away[:, joints])

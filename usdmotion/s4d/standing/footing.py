"""Ground adaptation: a motion stands on its footprints, and on the ground (2005, section 7)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.ground import Ground
from usdmotion.humanoid import ANKLE, BALL
from usdmotion.kernels import conjugate, forward, multiply, rotate
from usdmotion.motion import Body, Motion, Placement
from usdmotion.quality import speed
from usdmotion.s4d.bodies import Morphology
from usdmotion.s4d.standing.ankles import Foot, held_back
from usdmotion.s4d.standing.clearance import lift
from usdmotion.s4d.standing.footprints import Footprint, Stance, from_heel_strike, stances_of
from usdmotion.s4d.standing.heights import Heights, heights_of
from usdmotion.s4d.standing.legs import Leg, Pose, bent
from usdmotion.s4d.standing.treads import Level, Tread, treads_of
from usdmotion.s4d.turns import across

_HEEL_AT, _HEEL_RESTS = 0.03, 0.4
"""A heel this near to the ground [m], and this slow [m/s], has come down."""
_ROUNDS = 4
"""How often legs are bent and ankles held back, until both agree."""


@dataclass(frozen=True, eq=False)
class Standing:
    """A motion that stands on its footprints."""

    motion: Motion
    heights: Heights
    """How high the root is, and how high it might be."""
    treads: Mapping[str, Tread]
    """The way of each foot over the ground, by its side, "l" or "r"."""
    made_on: float
    """Height of the ground that the motion was made on, where lowest, along the up axis [m]."""

    @property
    def groundless(self) -> tuple[Footprint, ...]:
        """The footprints under which there is no ground; the motion stays as it was there."""
        return tuple(each for tread in self.treads.values() for each in tread.groundless)


def stand(
    motion: Motion,
    placement: Placement,
    morphology: Morphology,
    footprints: Sequence[Footprint],
    ground: Ground | None = None,
    *,
    up: Floats,
    body: Body | None = None,
) -> Standing:
    """Return a motion that stands on its footprints, and these on the ground.

    While a foot stands, its ball (its ankle where it has none) is on its footprint, as high above
    the ground as it was above the one that the motion was made on, and the sole lies on the ground
    as far as the ankle can be bent. In between, what that takes is eased, and feet clear what they
    swing over. The root goes along with the feet, and is as high as that says or, where that is
    less, as the legs reach: `h = min(h1, h2, h3)`. Legs follow in closed form; everything else is
    carried along as it was.

    Args:
        motion: Of the skeleton's joints.
        placement: The skeleton's space in the world.
        morphology: The body.
        footprints: Where feet stand on the ground that the motion was made on. If most are on one
            level, that is the ground, and the height of what stands on something of its own there
            is kept above the ground here; else, as on stairs, each is on the ground itself.
        ground: What to stand on; None is the ground that the motion was made on.
        up: The direction away from the ground, shape (3,).
        body: Limits of the ankles; None, or without limits, are those of most people.
    """
    pose = _pose(motion, placement, morphology)
    legs = [Leg.of(morphology, side) for side in "lr"]
    at_rest = dict(zip((ANKLE, BALL), morphology.standing_heights, strict=True))
    level = Level.of(footprints, at_rest, up)
    stances = [_stances(pose, leg, footprints, level, motion.times, up) for leg in legs]
    treads = treads_of(pose, legs, stances, level, ground, times=motion.times, up=up)
    feet = [
        _foot(pose, leg, tread, level, ground, motion.times, up)
        for leg, tread in zip(legs, treads, strict=True)
    ]
    carried = _carried(treads)
    for again in reversed(range(_ROUNDS)):
        ankles = [foot.ankle for foot in feet]
        heights = heights_of(pose, legs, ankles, carried, motion.times, up)
        shift = across(carried, up) + (heights.root - heights.original)[:, None] * up
        turns = [_reaching(pose, leg, foot, shift) for leg, foot in zip(legs, feet, strict=True)]
        if again:
            limited = zip(legs, turns, feet, strict=True)
            feet = [
                held_back(leg, pose, morphology.skeleton, body, shank, foot, up)
                for leg, (_, shank), foot in limited
            ]
    local = _carried_along(motion, pose, placement, morphology, shift)
    for leg, turn, foot in zip(legs, turns, feet, strict=True):
        _bend(local.rotations, pose, morphology, leg, turn, foot)
    return Standing(
        Motion(motion.times, *local), heights, dict(zip("lr", treads, strict=True)), level.height
    )


def _reaching(pose: Pose, leg: Leg, foot: Foot, shift: Floats) -> tuple[Floats, Floats]:
    """Return what turns thigh and shank so that they reach a foot from a hip that is shifted."""
    return bent(leg, pose, pose.positions[:, leg.hip] + shift, foot.ankle)


def _pose(motion: Motion, placement: Placement, morphology: Morphology) -> Pose:
    """Return where all joints are in the world."""
    parents = np.concatenate([[-1], morphology.skeleton.parents + 1])
    translations = np.concatenate([placement.translations[:, None], motion.translations], axis=1)
    rotations = np.concatenate([placement.rotations[:, None], motion.rotations], axis=1)
    positions, orientations = forward(parents, translations, rotations)
    return Pose(positions[:, 1:], orientations[:, 1:])


def _stances(
    pose: Pose,
    leg: Leg,
    footprints: Sequence[Footprint],
    level: Level,
    times: Floats,
    up: Floats,
) -> tuple[Stance, ...]:
    """Return when and where a foot stands, from the moment on at which its heel does."""
    stances = stances_of(footprints, leg.side, times)
    point = leg.sole_points(level.over)[0]
    heel = pose.positions[:, leg.ankle] + rotate(pose.rotations[:, leg.ankle], point)
    low = np.abs(heel @ up - level.height) < _HEEL_AT
    return from_heel_strike(stances, times, low & (speed(times, heel) < _HEEL_RESTS))


def _foot(
    pose: Pose,
    leg: Leg,
    tread: Tread,
    level: Level,
    ground: Ground | None,
    times: Floats,
    up: Floats,
) -> Foot:
    """Return where a foot is to be, lifted over what it swings over."""
    foot = tread.moved(leg, pose, up)
    if ground is None:
        return foot
    points = leg.sole_points(level.over)
    soles, original = (
        ankle[:, None] + rotate(turn[:, None], points)
        for ankle, turn in (foot[:2], (pose.positions[:, leg.ankle], pose.rotations[:, leg.ankle]))
    )
    higher = lift(soles, original, level.height, tread.stands, ground, times, up)
    return foot._replace(ankle=foot.ankle + higher[:, None] * up)


def _carried(treads: Sequence[Tread]) -> Floats:
    """Return by how much the body goes along with its feet: by the mean of those that stand."""
    drawn = [tread.drawn for tread in treads if tread.stands.any()]
    return np.asarray(np.mean(drawn or [tread.drawn for tread in treads], axis=0))


def _carried_along(
    motion: Motion, pose: Pose, placement: Placement, morphology: Morphology, shift: Floats
) -> Pose:
    """Return the local transforms of the joints with the pelvis, and all it carries, shifted."""
    pelvis = morphology.parts.pelvis
    assert pelvis is not None, "a morphology has one"
    above = int(morphology.skeleton.parents[pelvis])
    carrier = placement.rotations if above < 0 else pose.rotations[:, above]
    translations = np.array(motion.translations)
    translations[:, pelvis] += rotate(conjugate(carrier), shift)
    return Pose(translations, np.array(motion.rotations))


def _bend(
    rotations: Floats,
    pose: Pose,
    morphology: Morphology,
    leg: Leg,
    turn: tuple[Floats, Floats],
    foot: Foot,
) -> None:
    """Turn the joints of a leg, in the local rotations of all joints."""
    parents, (thigh, shank) = morphology.skeleton.parents, turn
    # Above the hip nothing turns, and what is between two joints of a leg turns with the first.
    still = np.broadcast_to((0.0, 0.0, 0.0, 1.0), thigh.shape)
    links = [
        (leg.hip, still, multiply(thigh, pose.rotations[:, leg.hip])),
        (leg.knee, thigh, multiply(shank, pose.rotations[:, leg.knee])),
        (leg.ankle, shank, foot.turn),
    ]
    if leg.ball is not None:
        held = multiply(foot.turn, conjugate(pose.rotations[:, leg.ankle]))
        links.append((leg.ball, held, multiply(foot.toes, pose.rotations[:, leg.ball])))
    for joint, above, world in links:
        carrier = multiply(above, pose.rotations[:, int(parents[joint])])
        rotations[:, joint] = multiply(conjugate(carrier), world)

"""One motion on bodies with other joints, proportions, rest poses and axes."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.demos.body import Proportions
from usdmotion.demos.people import person
from usdmotion.humanoid import PartMap
from usdmotion.humanoid.parts import finger
from usdmotion.kernels import conjugate, forward, from_vector, multiply, to_vector
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology, NormalizedMotion

from .conftest import moving, put, steps, taken

OTHER = Proportions(legs=1.15, arms=0.85, trunk=0.9, width=1.2, feet=1.1)


def somebody(**shape: object) -> Morphology:
    made = person(**shape)  # type: ignore[arg-type]
    return Morphology.of(made.skeleton, PartMap(made.parts))


def turned(body: Morphology, motion: Motion, part: str) -> Floats:
    """Return how a part is turned away from a T-pose, (F, 4)."""
    _, orientations = forward(body.skeleton.parents, motion.translations, motion.rotations)
    return multiply(orientations[:, body.joint(part)], body.canonical(part))


def place(body: Morphology, motion: Motion, part: str) -> Floats:
    places, _ = forward(body.skeleton.parents, motion.translations, motion.rotations)
    return np.asarray(places[:, body.joint(part)])


def between(a: Floats, b: Floats) -> float:
    return float(np.degrees(np.linalg.norm(to_vector(multiply(conjugate(a), b)), axis=-1).max()))


@pytest.mark.parametrize(("own", "other"), [*product((1, 3, 5), repeat=2)])
def test_a_back_of_other_vertebrae_carries_the_arms_alike(own: int, other: int) -> None:
    """The chest is turned exactly as it was, and the shoulders are nearly where they were.

    A back that bends at one place only cannot have both, and has the chest.
    """
    mine, theirs = somebody(vertebrae=own), somebody(vertebrae=other)
    motion = moving(mine, size=0.25)
    copied = put(taken(motion, mine), theirs)
    chests = (
        turned(body, moved, body.parts.parts[body.parts.spine[-1]])
        for body, moved in ((mine, motion), (theirs, copied))
    )
    assert between(*chests) < 1e-6
    for part in ("skullbase", "l_radiocarpal"):
        assert between(turned(mine, motion, part), turned(theirs, copied, part)) < 1e-6
    away = place(theirs, copied, "l_shoulder") - place(mine, motion, "l_shoulder")
    assert np.linalg.norm(away, axis=-1).max() < (
        1e-9 if own == other else 0.2 if other == 1 else 0.03
    )


def test_a_bend_is_shared_by_more_vertebrae() -> None:
    """None of five turns further than the one of three that turned most."""
    mine, theirs = somebody(vertebrae=3), somebody(vertebrae=5)
    turns = np.zeros((2, len(mine.skeleton.joints), 3))
    turns[1, mine.parts.spine, 0] = 0.4
    rest = np.broadcast_to(mine.skeleton.rest_translations, turns.shape)
    bent = put(taken(Motion(np.array((0.0, 1.0)), rest, from_vector(turns)), mine), theirs)
    each = steps(bent.rotations)[0, list(theirs.parts.spine)]
    assert each.max() < np.degrees(0.4) + 0.1
    assert each.min() > 3.0


@pytest.mark.parametrize(("own", "other"), [(3, 0), (0, 3), (3, 1), (1, 3), (2, 3)])
def test_fingers_of_other_joints_close_alike(own: int, other: int) -> None:
    mine, theirs = somebody(finger_joints=own), somebody(finger_joints=other)
    turns = np.zeros((2, len(mine.skeleton.joints), 3))
    for joint, part in enumerate(mine.parts.parts):
        if "interphalangeal" in part or "carpophalangeal" in part:
            turns[1, joint, 2] = -1.2 / own if part.startswith("l") else 1.2 / own
    rest = np.broadcast_to(mine.skeleton.rest_translations, turns.shape)
    motion = Motion(np.array((0.0, 1.0)), rest, from_vector(turns))
    closed = put(taken(motion, mine), theirs)
    if other:
        row = [part for part in map("l_{}".format, finger(3)) if part in theirs.parts.parts]
        hand = conjugate(turned(theirs, closed, "l_radiocarpal"))
        bend = np.degrees(to_vector(multiply(hand, turned(theirs, closed, row[-1])))[1, 2])
        assert bend == 0.0 if own == 0 else -70.0 < bend < -20.0
    wrists = (
        turned(body, each, "l_radiocarpal") for body, each in ((mine, motion), (theirs, closed))
    )
    assert between(*wrists) < 1e-6


def test_a_finger_that_a_motion_does_not_know_closes_with_its_neighbour() -> None:
    mine, theirs = somebody(finger_joints=2), somebody(finger_joints=2)
    known = tuple("" if part.endswith(("_4", "_5")) else part for part in mine.parts.parts)
    mine = Morphology.of(mine.skeleton, PartMap(known))
    motion = moving(mine, size=0.3)
    normalized = taken(motion, mine)
    nameless = NormalizedMotion(
        **{
            name: getattr(normalized, name)
            for name in normalized.__dataclass_fields__
            if not name.startswith("extra")
        }
    )
    copied = put(nameless, theirs)
    ring, middle = (turned(theirs, copied, f"l_metacarpophalangeal_{n}") for n in (4, 3))
    assert between(ring, middle) < 1e-6


POSES = {"any": 0.5, "wild": 1.2}


@pytest.mark.parametrize("size", POSES.values(), ids=POSES)
def test_a_body_of_other_proportions_moves_as_smoothly(body: Morphology, size: float) -> None:
    motion = moving(body, size=size, frames=121)
    theirs = somebody(
        height=1.2, proportions=OTHER, rest="A", axes=3, vertebrae=5, finger_joints=2, twists=True
    )
    copied = put(taken(motion, body), theirs)
    assert steps(copied.rotations).max() < 1.5 * steps(motion.rotations).max()
    for part in ("l_radiocarpal", "r_radiocarpal", "l_talocrural", "r_talocrural", "skullbase"):
        assert between(turned(body, motion, part), turned(theirs, copied, part)) < 1e-6


@pytest.mark.parametrize("bend", [0.0, 1e-7, 1e-3, -1e-3, -0.1])
def test_straight_and_overstretched_limbs_come_back_and_go_over(
    body: Morphology, bend: float
) -> None:
    """Knees and elbows that are straight, nearly, or bent the other way, while legs swing."""
    turns = np.zeros((31, len(body.skeleton.joints), 3))
    swing = 0.5 * np.sin(np.linspace(0.0, 3.0, 31))
    for side in "lr":
        turns[:, body.joint(f"{side}_hip"), 0] = swing
        turns[:, body.joint(f"{side}_shoulder"), 1] = swing
        turns[:, body.joint(f"{side}_knee"), 0] = bend * np.cos(np.linspace(0.0, 9.0, 31))
        turns[:, body.joint(f"{side}_elbow"), 1] = -bend * np.cos(np.linspace(0.0, 9.0, 31))
    rest = np.broadcast_to(body.skeleton.rest_translations, turns.shape)
    motion = Motion(np.arange(31) / 30.0, rest, from_vector(turns))
    normalized = taken(motion, body)
    assert between(put(normalized, body).rotations, motion.rotations) < 1e-4
    theirs = somebody(proportions=OTHER)
    copied = put(normalized, theirs)
    assert steps(copied.rotations).max() < 1.2 * steps(motion.rotations).max()
    knee = turned(theirs, copied, "l_knee")
    assert between(turned(body, motion, "l_knee"), knee) < np.degrees(0.2 * abs(bend)) + 1e-4


def test_a_leg_too_bent_for_another_is_bent_as_far_as_that_one_goes(body: Morphology) -> None:
    """A thigh that is longer than its shank cannot fold up to nothing."""
    turns = np.zeros((2, len(body.skeleton.joints), 3))
    turns[:, body.joint("l_knee"), 0] = 3.1
    rest = np.broadcast_to(body.skeleton.rest_translations, turns.shape)
    motion = Motion(np.array((0.0, 1.0)), rest, from_vector(turns))
    shape = body.skeleton
    longer = np.array(shape.rest_translations)
    longer[body.joint("l_knee")] *= 1.5
    longer[body.joint("r_knee")] *= 1.5
    theirs = Morphology.of(
        type(shape)(shape.joints, shape.parents, longer, shape.rest_rotations), body.parts
    )
    copied = put(taken(motion, body), theirs)
    assert np.isfinite(copied.rotations).all()
    folded = place(theirs, copied, "l_talocrural") - place(theirs, copied, "l_hip")
    limb = theirs.limbs[1]
    assert np.allclose(np.linalg.norm(folded, axis=-1), limb.upper - limb.lower, atol=1e-6)


@pytest.mark.parametrize("kind", ["metacarpophalangeal", "metatarsophalangeal", "vertebra"])
def test_joints_that_lie_on_each_other_lose_nothing(kind: str) -> None:
    """Knuckles in the wrist, balls in the ankles, vertebrae in one place."""
    mine = somebody(finger_joints=2)
    places = np.array(mine.skeleton.rest_translations)
    for joint, part in enumerate(mine.parts.parts):
        if kind in part or (kind == "vertebra" and joint in mine.parts.spine):
            places[joint] = 0.0
    other = Morphology.of(replace(mine.skeleton, rest_translations=places), mine.parts)
    motion = moving(other)
    normalized = taken(motion, other)
    assert between(put(normalized, other).rotations, motion.rotations) < 1e-4
    for body in (mine, somebody(vertebrae=5)):
        assert np.isfinite(put(normalized, body).rotations).all()
    assert np.isfinite(put(taken(moving(mine), mine), other).rotations).all()

"""What a normalized motion does not depend on."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap
from usdmotion.kernels import conjugate, from_vector, multiply, rotate
from usdmotion.motion import Motion, Placement, Skeleton
from usdmotion.s4d import Morphology, NormalizedMotion, normalize, restore
from usdmotion.s4d.turns import IDENTITY

from .conftest import UP, apart, moving, put, taken

ROTATIONS = ("limb_frames", "segment_rotations", "root_heading", "root_orientation")
NUMBERS = ("limb_lengths", "limb_twists", "spine", "root_position")
PLACES = {
    "where it stands": (np.array((3.0, 0.0, -40.0)), np.array((0.0, 2.0, 0.0))),
    "under a tilted Xform": (np.array((1.0, 2.0, 3.0)), np.array((0.4, -1.0, 0.7))),
}


def turned_apart(a: Floats, b: Floats) -> float:
    """Return how much rotations differ at most [degrees]."""
    cosine = np.abs(np.sum(a * b, axis=-1))
    return float(np.degrees(2.0 * np.arccos(np.clip(cosine, 0.0, 1.0))).max())


def assert_same(one: NormalizedMotion, other: NormalizedMotion, *, degrees: float = 1e-4) -> None:
    assert one.segments == other.segments
    assert one.limbs == other.limbs
    for name in ROTATIONS:
        assert turned_apart(getattr(one, name), getattr(other, name)) < degrees, name
    for name in NUMBERS:
        apart = np.abs(getattr(one, name) - getattr(other, name)).max()
        assert apart < 2.0 * np.radians(degrees) + 1e-9, name


@pytest.mark.parametrize("where", PLACES)
def test_it_does_not_matter_what_carries_the_skeleton(body: Morphology, where: str) -> None:
    """The motion in a space that is somewhere else, where the body is in the world as before."""
    motion = moving(body)
    place, turn = PLACES[where]
    rotations = np.tile(from_vector(turn), (motion.frame_count, 1))
    space = Placement(np.tile(place, (motion.frame_count, 1)), rotations)
    moved, turned = np.array(motion.translations), np.array(motion.rotations)
    moved[:, 0] = rotate(conjugate(rotations), moved[:, 0] - place)
    turned[:, 0] = multiply(conjugate(rotations), turned[:, 0])
    elsewhere = normalize(Motion(motion.times, moved, turned), space, body, up=UP)
    assert_same(taken(motion, body), elsewhere)


def test_it_does_not_matter_which_axis_is_up(body: Morphology) -> None:
    motion = moving(body)
    to_z_up = np.tile(from_vector(np.array((np.pi / 2.0, 0.0, 0.0))), (motion.frame_count, 1))
    space = Placement(np.zeros((motion.frame_count, 3)), to_z_up)
    z_up = normalize(motion, space, body, up=np.array((0.0, 0.0, 1.0)))
    assert_same(taken(motion, body), z_up)
    metres, degrees = apart(
        body.skeleton, motion, restore(z_up, body, space, up=np.array((0.0, 0.0, 1.0)))
    )
    assert metres < 1e-9
    assert degrees < 1e-6


@pytest.mark.parametrize("scale", [0.01, 0.6, 1.3])
def test_a_body_of_another_size_moves_the_same(body: Morphology, scale: float) -> None:
    motion, shape = moving(body), body.skeleton
    small = replace(shape, rest_translations=scale * shape.rest_translations)
    scaled = Motion(motion.times, scale * motion.translations, motion.rotations)
    other = Morphology.of(small, body.parts)
    assert_same(taken(motion, body), taken(scaled, other))
    metres, degrees = apart(small, scaled, put(taken(motion, body), other))
    assert metres < 1e-9
    assert degrees < 1e-6


def test_it_does_not_matter_how_the_axes_of_joints_lie(body: Morphology) -> None:
    motion, shape = moving(body, size=1.0), body.skeleton
    generator = np.random.default_rng(7)
    axes = from_vector(generator.uniform(-2.0, 2.0, size=(len(shape.joints), 3)))
    above = np.where((shape.parents >= 0)[:, None], axes[shape.parents], IDENTITY)

    def seen(rotations: Floats) -> Floats:
        return multiply(multiply(conjugate(above), rotations), axes)

    strange = Skeleton(
        shape.joints,
        shape.parents,
        rotate(conjugate(above), shape.rest_translations),
        seen(shape.rest_rotations),
    )
    other = Morphology.of(strange, body.parts)
    moved = rotate(conjugate(above), motion.translations)
    assert_same(
        taken(motion, body), taken(Motion(motion.times, moved, seen(motion.rotations)), other)
    )


RESTS = {
    "an A-pose": {"l_shoulder": (0.0, 0.0, -0.8), "r_shoulder": (0.0, 0.0, 0.8)},
    "hanging arms": {"l_shoulder": (0.0, 0.0, -1.5), "r_shoulder": (0.0, 0.0, 1.5)},
    "bent elbows": {"l_elbow": (0.0, -0.5, 0.0), "r_elbow": (0.0, 0.5, 0.0)},
    "feet apart": {
        "l_hip": (0.0, 0.0, 0.3),
        "l_talocrural": (0.0, 0.0, -0.3),
        "r_hip": (0.0, 0.0, -0.3),
        "r_talocrural": (0.0, 0.0, 0.3),
    },
    "legs and feet slanted": {"l_hip": (0.0, 0.0, 0.35), "r_hip": (0.0, 0.0, -0.35)},
    "feet turned out": {"l_talocrural": (0.0, 0.4, 0.0), "r_talocrural": (0.0, -0.4, 0.0)},
    "lying along z": {"humanoid_root": (-np.pi / 2.0, 0.0, 0.0)},
}


@pytest.mark.parametrize("pose", RESTS)
def test_it_does_not_matter_in_which_pose_the_body_rests(body: Morphology, pose: str) -> None:
    motion, shape = moving(body), body.skeleton
    rotations = np.array(shape.rest_rotations)
    for part, turn in RESTS[pose].items():
        joint = body.joint(part)
        rotations[joint] = multiply(rotations[joint], from_vector(np.array(turn)))
    other = Morphology.of(replace(shape, rest_rotations=rotations), body.parts)
    assert_same(taken(motion, body), taken(motion, other))


def test_a_rest_of_lengths_only_is_told_by_the_motion(body: Morphology) -> None:
    """Every joint's axes lie along its segment, and the rest pose is a row of segments.

    Which way up the trunk and the feet are is then told to some degrees by how they usually are;
    a motion still comes back exactly, and knees and elbows bend as they did.
    """
    motion, shape = walking(body), body.skeleton
    flat, along = rowed(body)
    above = np.where((shape.parents >= 0)[:, None], along[shape.parents], IDENTITY)
    seen = multiply(multiply(conjugate(above), motion.rotations), along)
    told = Motion(motion.times, rotate(conjugate(above), motion.translations), seen)
    other = Morphology.of(flat, body.parts, poses=told)
    one, two = taken(motion, body), taken(told, other)
    assert np.abs(one.limb_lengths - two.limb_lengths).max() < 1e-9
    assert turned_apart(one.root_orientation, two.root_orientation) < 1.0
    knees = [one.limbs.index(f"{side}_hip") for side in "lr"]
    assert np.degrees(np.abs(one.limb_twists - two.limb_twists)[:, knees]).max() < 5.0
    assert turned_apart(one.segment_rotations, two.segment_rotations) < 1e-4
    metres, degrees = apart(flat, told, put(two, other))
    assert metres < 1e-9
    assert degrees < 1e-6


def test_one_posture_that_stands_tells_as_much_as_a_rest_pose(body: Morphology) -> None:
    flat, along = rowed(body)
    above = np.where((flat.parents >= 0)[:, None], along[flat.parents], IDENTITY)
    standing = multiply(conjugate(above), along)[None]
    poses = Motion(np.zeros(1), flat.rest_translations[None], standing)
    other = Morphology.of(flat, body.parts, poses=poses)
    expected = multiply(conjugate(along), body.part_frames)
    assert turned_apart(other.part_frames, expected) < 1e-3


def walking(body: Morphology) -> Motion:
    """Return something like a walk: legs swing, knees and elbows bend, feet stand flat."""
    times = np.arange(120) / 30.0
    turns = np.zeros((120, len(body.skeleton.joints), 3))
    for side, phase, sign in (("l", 0.0, 1.0), ("r", np.pi, -1.0)):
        swing = 0.4 * np.sin(2.0 * np.pi * times + phase)
        bend = 0.5 + 0.4 * np.cos(2.0 * np.pi * times + phase)
        turns[:, body.joint(f"{side}_hip"), 0] = -swing - 0.5 * bend
        turns[:, body.joint(f"{side}_knee"), 0] = bend
        turns[:, body.joint(f"{side}_talocrural"), 0] = swing - 0.5 * bend
        turns[:, body.joint(f"{side}_shoulder"), 2] = -sign * 1.3
        turns[:, body.joint(f"{side}_elbow"), 1] = -sign * (0.4 + 0.2 * bend)
    places = np.array(np.broadcast_to(body.skeleton.rest_translations, turns.shape))
    places[:, 0, 2] += 1.2 * times
    return Motion(times, places, from_vector(turns))


def rowed(body: Morphology) -> tuple[Skeleton, Floats]:
    """Return a skeleton whose segments all lie along x at rest, and the axes of its joints."""
    shape = body.skeleton
    right = np.pi / 2.0
    upright, hanging = (
        from_vector(np.array((0.0, 0.0, right))),
        from_vector(np.array((0, 0, -right))),
    )
    backwards = from_vector(np.array((0.0, np.pi, 0.0)))
    ahead = from_vector(np.array((0.0, -right, 0.0)))
    along = np.tile(IDENTITY, (len(shape.joints), 1))
    for joint, part in enumerate(body.parts.parts):
        own = part.partition("_")[2]
        if part in ("skullbase",) or part.startswith("v"):
            along[joint] = upright
        elif own in ("hip", "knee"):
            along[joint] = hanging
        elif own in ("talocrural", "metatarsophalangeal"):
            along[joint] = ahead
        elif part.startswith("r_"):
            along[joint] = backwards
    above = np.where((shape.parents >= 0)[:, None], along[shape.parents], IDENTITY)
    row = rotate(conjugate(above), shape.rest_translations)
    identity = np.tile(IDENTITY, (len(shape.joints), 1))
    return Skeleton(shape.joints, shape.parents, row, identity), along


def test_names_of_parts_say_what_is_missing(body: Morphology) -> None:
    headless = tuple("" if part == "skullbase" else part for part in body.parts.parts)
    with pytest.raises(SceneError, match="skullbase"):
        Morphology.of(body.skeleton, PartMap(headless))
    flat, _ = rowed(body)
    with pytest.raises(SceneError, match="no posture of a body at rest"):
        Morphology.of(flat, body.parts)


def test_a_motion_that_is_not_whole_is_refused(body: Morphology) -> None:
    whole = taken(moving(body), body)
    armless = replace(
        whole,
        limbs=whole.limbs[1:],
        limb_frames=whole.limb_frames[:, 1:],
        limb_lengths=whole.limb_lengths[:, 1:],
        limb_twists=whole.limb_twists[:, 1:],
    )
    with pytest.raises(
        SceneError, match="no l_shoulder among its limbs; normalize the motion again"
    ):
        put(armless, body)
    with pytest.raises(SceneError, match="4 points in its spine for 3 vertebrae"):
        put(replace(whole, spine=whole.spine[:, 1:]), body)
    on_his_head = {"carriers": ("skullbase",), "carrier_shares": np.ones((61, 1))}
    with pytest.raises(SceneError, match="'skullbase' carries nobody; name some of l_talocrural"):
        put(replace(whole, **on_his_head), body)


def test_what_does_not_hang_on_the_pelvis_is_refused(body: Morphology) -> None:
    swapped = list(body.parts.parts)
    root, chest = body.joint("humanoid_root"), body.joint("vt6")
    swapped[root], swapped[chest] = swapped[chest], swapped[root]
    with pytest.raises(SceneError, match="not below its humanoid_root"):
        Morphology.of(body.skeleton, PartMap(tuple(swapped)))

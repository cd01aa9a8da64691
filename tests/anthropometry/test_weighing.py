"""Masses of a body: where they are from, and the laws that they keep."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from usdmotion_bvh import BvhReader

from usdmotion.anthropometry import with_masses
from usdmotion.arrays import Floats
from usdmotion.demos.body import humanoid
from usdmotion.humanoid import PartMap, guess
from usdmotion.kernels import forward, from_vector, world_points
from usdmotion.motion import Body, Motion, Skeleton

HEIGHT = 1.7
UPRIGHT = np.array([0.0, 0.0, 0.0, 1.0])


def weighed(skeleton: Skeleton, parts: PartMap | None) -> tuple[Body, str]:
    return with_masses(skeleton, Body.unknown(len(skeleton.joints)), parts)


def center(skeleton: Skeleton, body: Body, motion: Motion | None = None) -> Floats:
    """Return the centre of mass at rest, or in the first frame of a motion."""
    offsets = skeleton.rest_translations if motion is None else motion.translations[0]
    turns = skeleton.rest_rotations if motion is None else motion.rotations[0]
    positions, orientations = forward(skeleton.parents, offsets[None], turns[None])
    points = world_points(positions[0], orientations[0], body.mass_centers)
    return body.masses @ points / body.masses.sum()


def still(skeleton: Skeleton, turns: dict[str, tuple[float, float, float]]) -> Motion:
    """Return one frame at rest but for some joints, turned by a rotation vector [degrees]."""
    rotations = skeleton.rest_rotations.copy()
    for name, vector in turns.items():
        joint = next(j for j, token in enumerate(skeleton.joints) if token.endswith(f"/{name}"))
        rotations[joint] = from_vector(np.radians(vector))
    return Motion(np.zeros(1), skeleton.rest_translations[None], rotations[None])


@pytest.fixture
def demo() -> tuple[Skeleton, Body, PartMap]:
    skeleton, body, parts = humanoid(HEIGHT)
    return skeleton, body, PartMap(parts)


def test_what_is_authored_is_kept(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, body, parts = demo
    kept, source = with_masses(skeleton, body, parts)
    assert kept is body
    assert source == "authored"


def test_the_table_weighs_a_body_that_is_known(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, _, parts = demo
    body, source = weighed(skeleton, parts)
    assert source == "anthropometric table"
    assert body.masses.sum() == pytest.approx(1.0)
    assert (body.masses >= 0.0).all()
    thigh = parts.joint("l_hip")
    assert body.masses[thigh] == pytest.approx(0.1416, abs=1e-4)
    to_the_knee = skeleton.rest_translations[parts.joint("l_knee")]
    np.testing.assert_allclose(body.mass_centers[thigh], 0.4095 * to_the_knee)
    vertebrae = list(parts.spine)
    assert body.masses[vertebrae].sum() == pytest.approx(0.1633 + 0.1596, abs=1e-4)
    assert (body.masses[vertebrae] > 0.0).all()


def test_all_else_that_is_known_of_a_body_is_kept(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, body, parts = demo
    bare = replace(body, masses=np.zeros_like(body.masses))
    found, _ = with_masses(skeleton, bare, parts)
    np.testing.assert_array_equal(found.limits_min, body.limits_min)
    np.testing.assert_array_equal(found.stiffness, body.stiffness)


def test_a_standing_body_has_its_centre_at_the_pelvis(demo: tuple[Skeleton, Body, PartMap]) -> None:
    """Winter, "Biomechanics", 4.1: about 0.56 of the height; arms that are held out add 0.02."""
    skeleton, _, parts = demo
    body, _ = weighed(skeleton, parts)
    hanging = still(skeleton, {"LeftArm": (0, 0, -90), "RightArm": (0, 0, 90)})
    x, y, z = center(skeleton, body, hanging) / HEIGHT
    assert 0.53 < y < 0.57
    assert abs(x) < 1e-9 and abs(z) < 0.01
    assert 0.01 < center(skeleton, body)[1] / HEIGHT - y < 0.03


def test_left_weighs_what_right_does(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, _, parts = demo
    for known in (parts, None):
        body, _ = weighed(skeleton, known)
        for left, part in enumerate(parts.parts):
            if part.startswith("l_"):
                right = parts.joint(f"r_{part[2:]}")
                assert body.masses[left] == pytest.approx(body.masses[right])
                mirrored = body.mass_centers[right] * (-1.0, 1.0, 1.0)
                np.testing.assert_allclose(body.mass_centers[left], mirrored, atol=1e-12)


@pytest.mark.parametrize("is_known", [True, False])
def test_size_and_names_change_no_ratio(
    demo: tuple[Skeleton, Body, PartMap], is_known: bool
) -> None:
    skeleton, _, parts = demo
    known = parts if is_known else None
    body, source = weighed(skeleton, known)
    strange = tuple(f"j{joint}" for joint in range(len(skeleton.joints)))
    large = replace(skeleton, joints=strange, rest_translations=100 * skeleton.rest_translations)
    other, its_source = weighed(large, known)
    assert its_source == source
    np.testing.assert_allclose(other.masses, body.masses)
    np.testing.assert_allclose(other.mass_centers, 100 * body.mass_centers, atol=1e-12)


def test_the_frames_of_the_joints_change_nothing(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, _, parts = demo
    turn = from_vector(np.array([0.4, -1.1, 0.7]))
    back = turn * (-1.0, -1.0, -1.0, 1.0)
    top = skeleton.parents < 0
    offsets = skeleton.rest_translations.copy()
    offsets[~top] = world_points(np.zeros(3), back, offsets[~top])
    turns = np.where(top[:, None], turn, UPRIGHT)
    other = Skeleton(skeleton.joints, skeleton.parents, offsets, turns)
    found, wanted = (center(each, weighed(each, parts)[0]) for each in (other, skeleton))
    np.testing.assert_allclose(found, wanted, atol=1e-12)


def test_a_twist_joint_shares_the_segment_it_is_in(demo: tuple[Skeleton, Body, PartMap]) -> None:
    """Both on the way to the knee, as MakeHuman has it, and beside it, as iClone has it."""
    skeleton, _, parts = demo
    hip, knee = parts.joint("l_hip"), parts.joint("l_knee")
    count = len(skeleton.joints)
    for between in (False, True):
        order = [*range(knee), count, *range(knee, count)]
        offsets = np.vstack([skeleton.rest_translations, 0.3 * skeleton.rest_translations[knee]])
        offsets[knee] *= 0.7 if between else 1.0
        above = np.append(skeleton.parents, hip)
        above[knee] = count if between else hip
        twisted = Skeleton(
            tuple([*skeleton.joints, "twist"][joint] for joint in order),
            np.array([order.index(above[joint]) if above[joint] >= 0 else -1 for joint in order]),
            offsets[order],
            np.tile(UPRIGHT, (count + 1, 1)),
        )
        known = PartMap(tuple([*parts.parts, ""][joint] for joint in order))
        body, _ = weighed(twisted, known)
        assert (body.masses[order.index(count)] > 0.0) == between
        wanted = center(skeleton, weighed(skeleton, parts)[0])
        np.testing.assert_allclose(center(twisted, body), wanted, atol=1e-12)


def test_lengths_weigh_what_nobody_knows(demo: tuple[Skeleton, Body, PartMap]) -> None:
    skeleton, _, _ = demo
    strangers = PartMap(("",) * len(skeleton.joints))
    for known in (None, strangers):
        body, source = weighed(skeleton, known)
        assert source == "segment lengths"
        assert body.masses.sum() == pytest.approx(1.0)
    arm = Skeleton(
        ("a", "a/b", "a/b/c"),
        np.array([-1, 0, 1]),
        np.array([(5.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 1.0, 0.0)]),
        np.tile(UPRIGHT, (3, 1)),
    )
    body, _ = weighed(arm, None)
    np.testing.assert_allclose(body.masses, (0.75, 0.25, 0.0))
    np.testing.assert_allclose(body.mass_centers, [(0, 1.5, 0), (0, 0.5, 0), (0, 0, 0)])


def test_a_single_joint_weighs_all() -> None:
    stone = Skeleton(("stone",), np.array([-1]), np.ones((1, 3)), UPRIGHT[None])
    body, _ = weighed(stone, None)
    np.testing.assert_array_equal(body.masses, [1.0])
    np.testing.assert_array_equal(body.mass_centers, np.zeros((1, 3)))


T_POSES = [
    *("cmu/daz/135_03", "cmu/daz/60_10", "cmu/daz/61_10", "cmu/daz/94_07", "cmu/daz_hands/05_01"),
    *("cmu/mb/01_01", "cmu/mb/01_03", "cmu/mb/12_01", "cmu/iclone/007_04", "cmu/iclone/007_12"),
    *("other/fair_dab", "other/fair_zombie"),
]
STANDING = ["cmu/iclone/002_04", "other/mixamorig_turns", "other/rokoko_jesse_dance"]


@pytest.mark.parametrize("name", T_POSES + STANDING)
def test_a_captured_body_has_its_centre_above_its_hips(mocap: Path, name: str) -> None:
    """The height is told from the base of the skull, since few skeletons have a crown."""
    recording = BvhReader().read(mocap / f"{name}.bvh")
    skeleton, motion = recording.skeleton, recording.motion
    parts = guess(skeleton)
    body, source = weighed(skeleton, parts)
    assert source == "anthropometric table"
    assert body.masses.sum() == pytest.approx(1.0)
    positions, orientations = forward(
        skeleton.parents, motion.translations[:1], motion.rotations[:1]
    )
    tips = recording.tip_joints
    ends = world_points(positions[0, tips], orientations[0, tips], recording.tip_points)
    up = "XYZ".index(recording.up)
    floor = min(positions[0, :, up].min(), ends[:, up].min())
    height = (positions[0, parts.joint("skullbase"), up] - floor) / 0.905
    hips = positions[0, [parts.joint("l_hip"), parts.joint("r_hip")]].mean(axis=0)
    found = center(skeleton, body, motion)
    assert 0.54 < (found[up] - floor) / height < (0.58 if name in STANDING else 0.60)
    assert 0.0 < (found - hips)[up] / height < 0.07
    assert np.linalg.norm(np.delete(found - hips, up)) / height < 0.03

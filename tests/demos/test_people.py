import numpy as np
import pytest

from usdmotion.demos.body import Proportions, humanoid
from usdmotion.demos.people import NAMINGS, RESTS, person
from usdmotion.humanoid import NEEDED, guess
from usdmotion.kernels import forward, world_points

ALL_BUT_NUMBERS = [name for name in NAMINGS if name != "numbers"]


def at_rest(made):
    skeleton = made.skeleton
    places, turns = forward(
        skeleton.parents, skeleton.rest_translations[None], skeleton.rest_rotations[None]
    )
    return places[0], turns[0]


def in_world(made, joints, points):
    places, turns = at_rest(made)
    return world_points(places[joints], turns[joints], points)


def centre_of_mass(made):
    every = np.arange(len(made.parts))
    return np.average(
        in_world(made, every, made.body.mass_centers), axis=0, weights=made.body.masses
    )


def test_the_usual_person_is_the_humanoid():
    skeleton, body, parts = humanoid(1.7)
    made = person(1.7)
    assert (made.skeleton.joints, made.parts) == (skeleton.joints, parts)
    np.testing.assert_array_equal(made.skeleton.rest_translations, skeleton.rest_translations)
    np.testing.assert_array_equal(made.body.mass_centers, body.mass_centers)
    np.testing.assert_array_equal(made.body.limits_max, body.limits_max)


@pytest.mark.parametrize("rest", RESTS)
@pytest.mark.parametrize("z_up", [False, True])
def test_whatever_its_axes_are_it_stands_as_it_stood(rest, z_up):
    straight = person(rest=rest, finger_joints=2, z_up=z_up)
    turned = person(rest=rest, finger_joints=2, z_up=z_up, axes=7)
    np.testing.assert_allclose(at_rest(turned)[0], at_rest(straight)[0], atol=1e-12)
    for joints, points in (("tip_joints", "tip_points"), ("sole_joints", "sole_points")):
        there = [in_world(m, getattr(m, joints), getattr(m, points)) for m in (straight, turned)]
        np.testing.assert_allclose(there[1], there[0], atol=1e-12)
    np.testing.assert_allclose(centre_of_mass(turned), centre_of_mass(straight), atol=1e-12)


@pytest.mark.parametrize("proportions", [Proportions(), Proportions(legs=0.8, arms=1.3, feet=1.4)])
def test_it_stands_on_the_ground_and_is_as_high_as_is_said(proportions):
    made = person(1.9, proportions=proportions, rest="A", axes=3, vertebrae=5, z_up=True)
    soles = in_world(made, made.sole_joints, made.sole_points)
    np.testing.assert_allclose(soles[:, 2], 0.0, atol=1e-12)
    head = made.parts.index("skullbase")
    # The capsule of the head ends in half a sphere.
    assert 1.7 < in_world(made, [head], made.tip_points[[head]])[0, 2] < 1.9


def test_only_what_is_said_to_differ_does():
    usual, long = person(), person(proportions=Proportions(arms=1.2))
    for side in "lr":
        for upper, lower, ratio in (("shoulder", "elbow", 1.2), ("hip", "knee", 1.0)):
            assert span(long, side, upper, lower) == pytest.approx(
                ratio * span(usual, side, upper, lower), rel=1e-12
            )


def span(made, side, upper, lower):
    places, _ = at_rest(made)
    ends = (places[made.parts.index(f"{side}_{part}")] for part in (upper, lower))
    return np.linalg.norm(np.subtract(*ends))


def test_longer_legs_leave_less_to_the_trunk():
    usual, long = person(), person(proportions=Proportions(legs=1.3))
    hips, head = (usual.parts.index(part) for part in ("humanoid_root", "skullbase"))
    heights = [at_rest(made)[0][[hips, head], 1] for made in (usual, long)]
    assert heights[1][0] > 1.05 * heights[0][0]
    assert np.diff(heights[1]) < np.diff(heights[0])


@pytest.mark.parametrize("vertebrae", [1, 3, 5, 9])
def test_vertebrae_cut_one_back_and_carry_one_weight(vertebrae):
    made, usual = person(vertebrae=vertebrae), person()
    back = [part for part in made.parts if part.startswith(("vl", "vt"))]
    assert len(back) == vertebrae
    assert made.body.masses.sum() == pytest.approx(usual.body.masses.sum(), rel=1e-12)
    np.testing.assert_allclose(centre_of_mass(made), centre_of_mass(usual), atol=1e-12)
    for part in ("l_shoulder", "skullbase", "r_talocrural"):
        np.testing.assert_allclose(
            at_rest(made)[0][made.parts.index(part)],
            at_rest(usual)[0][usual.parts.index(part)],
            atol=1e-12,
        )


@pytest.mark.parametrize("naming", ALL_BUT_NUMBERS)
@pytest.mark.parametrize(("vertebrae", "finger_joints"), [(1, 0), (3, 3), (5, 2)])
def test_names_say_what_is_what(naming, vertebrae, finger_joints):
    made = person(naming=naming, vertebrae=vertebrae, finger_joints=finger_joints, twists=True)
    found = guess(made.skeleton)
    own = [part for part in made.parts if part in NEEDED or part.endswith("_interphalangeal_2")]
    assert len(own) == len(NEEDED) + 2 * max(finger_joints - 1, 0)
    for part in own:
        assert found.joint(part) == made.parts.index(part), part
    assert len(found.spine) == vertebrae


def test_numbers_say_nothing():
    assert person(naming="numbers").skeleton.joints[-1].rsplit("/", 1)[-1] == "joint021"


def test_arms_hang_where_the_rest_pose_has_them():
    for rest, (lowered, _) in RESTS.items():
        made = person(rest=rest, axes=1)
        places, _ = at_rest(made)
        way = places[made.parts.index("l_elbow")] - places[made.parts.index("l_shoulder")]
        angle = np.degrees(np.arctan2(-way[1], way[0]))
        assert angle == pytest.approx(lowered, abs=1e-9)


def test_the_limits_of_a_bent_elbow_are_those_of_a_straight_one():
    made, straight = person(rest="down"), person()
    for side in "lr":
        elbow = made.parts.index(f"{side}_elbow")
        _, bent = RESTS["down"]
        turned = np.degrees(2.0 * np.arcsin(made.skeleton.rest_rotations[elbow, 1]))
        assert abs(turned) == pytest.approx(bent)
        for limits in ("limits_min", "limits_max"):
            own = getattr(made.body, limits)[elbow, 1] + turned
            assert own == pytest.approx(getattr(straight.body, limits)[elbow, 1])

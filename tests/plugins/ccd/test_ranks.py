"""What ranks lower disturbs nothing above: on one limb, in the balance, out of reach."""

from dataclasses import replace

import numpy as np

from usdmotion.kernels import from_vector, rotate

from .conftest import arm, at, balance, feet, orientation, position, within_reach

FAR = (1.0, 1.0, 2.0)
MET = 1e-5


def test_two_ranks_on_one_limb_turn_it_about_its_axis(solve):
    shoulder, elbow, wrist = arm("left")
    both_joints = (shoulder, elbow)
    first = at(wrist, within_reach("left"), recruits=both_joints)
    second = position(elbow, 2, way=(0.0, 0.3, -0.2), recruits=both_joints)
    alone, both = solve(first), solve(first, second)
    assert both.errors[:, 0].max() <= MET
    start, end = both.places(shoulder), both.places(wrist)
    axis = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    cast = both.problem.cast
    goal = cast.positions[:, both.node(elbow)] + (0.0, 0.3, -0.2)
    angles = np.linspace(0.0, 2.0 * np.pi, 3600)[:, None, None]
    circle = start + rotate(from_vector(angles * axis), alone.places(elbow) - start)
    nearest = np.linalg.norm(circle - goal, axis=2).min(axis=0)
    np.testing.assert_allclose(both.errors[:, 1], nearest, atol=1e-5)


def test_a_hand_that_may_not_turn_is_reached_with_too(solve):
    wrist = arm("left")[2]
    solved = solve(at(wrist, within_reach("left")), orientation(wrist, 2))
    assert solved.errors[:, 0].max() <= MET
    assert solved.errors[:, 1].max() <= 1e-3


def test_feet_and_balance_are_kept_while_an_arm_is_stretched_in_vain(solve):
    wrist = arm("left")[2]
    kept = [*feet(1), balance(2)]
    solved = solve(*kept, position(wrist, 3, way=FAR))
    assert solved.errors[:, :3].max() <= 2e-5
    before = np.linalg.norm(FAR)
    assert solved.errors[:, 3].max() < before - 0.3


def test_without_the_balance_the_centre_of_mass_goes_along(solve):
    wrist, off = arm("left")[2], replace(balance(2), activity=0.0)
    solved = solve(*feet(1), off, position(wrist, 3, way=FAR))
    assert solved.errors[:, :2].max() <= 2e-5
    assert solved.errors[:, 2].min() > 0.05


def test_only_the_other_arm_can_keep_the_balance_and_does(solve):
    left, right = arm("left"), arm("right")
    goal = at(left[2], within_reach("left"), recruits=left[:2])
    alone = solve(goal, balance(2, recruits=right[:1], axes="x"))
    assert alone.errors[:, 0].max() <= MET
    assert alone.errors[:, 1].max() <= 1e-4
    assert alone.moved(right[0])
    assert not alone.moved("pelvis", "pelvis/spine")


def test_the_balance_above_a_hand_is_kept_by_the_other_arm(solve):
    left, right = arm("left"), arm("right")
    goal = at(left[2], within_reach("left"), 2, recruits=left[:2])
    solved = solve(balance(1, recruits=right[:1], axes="x"), goal)
    assert solved.errors[:, 0].max() <= 2e-5


def test_ranks_that_recruit_too_little_are_not_broken_either(solve):
    wrist = arm("left")[2]
    held = position(wrist, 1, recruits=(arm("left")[1],))
    solved = solve(held, position("pelvis", 2, way=(0.2, 0.0, 0.0)))
    assert solved.errors[:, 0].max() <= 2e-5

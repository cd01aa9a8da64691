"""2005, section 9: limbs first, the trunk by what they could not do, the root last."""

import numpy as np

from .conftest import CHEST, HEAD, arm, at, balance, feet, leg, position, within_reach

TRUNK = ("pelvis", "pelvis/spine", CHEST)
FAR = (0.3, 0.3, 0.5)
"""Out of an arm's reach [m]."""


def test_within_an_arms_reach_not_one_joint_of_the_trunk_moves(solve):
    wrist = arm("left")[2]
    solved = solve(at(wrist, within_reach("left")))
    assert solved.errors.max() <= 1e-5
    assert solved.moved(*arm("left")[:2])
    assert not solved.moved(*TRUNK, HEAD, *arm("right"), *leg("left"))


def test_beyond_it_the_arm_is_stretched_and_the_trunk_does_the_rest(solve):
    shoulder, elbow, wrist = arm("left")
    solved = solve(position(wrist, way=FAR))
    assert solved.errors.max() <= 1e-5
    assert solved.moved("pelvis/spine", CHEST)
    stretched = np.linalg.norm(solved.places(wrist) - solved.places(shoulder), axis=1)
    whole = np.linalg.norm(solved.places(wrist) - solved.places(elbow), axis=1)
    whole += np.linalg.norm(solved.places(elbow) - solved.places(shoulder), axis=1)
    assert (stretched >= 0.99 * whole).all()


def test_two_arms_do_what_each_can_and_share_the_trunk(solve):
    asked = [position(arm(side)[2], way=(0.0, 0.3, 0.4)) for side in ("left", "right")]
    solved = solve(*asked)
    assert solved.errors.max() <= 1e-5


def test_the_centre_of_mass_is_put_back_by_the_root_alone(solve):
    solved = solve(*feet(), balance(2, way=(0.03, -0.02, 0.04)))
    assert solved.errors.max() <= 1e-5
    assert solved.moved("pelvis", *leg("left"), *leg("right"))
    assert not solved.moved("pelvis/spine", CHEST, HEAD, *arm("left"), *arm("right"))
    assert solved.turned("pelvis").max() == 0.0


def test_feet_that_stay_keep_how_they_are_turned(solve):
    solved = solve(*feet(), balance(2, way=(0.0, -0.05, 0.0)))
    hip, knee, ankle = leg("left")
    whole = sum(solved.turned(joint) for joint in (hip, knee))
    assert solved.turned(ankle).min() > 1.0
    assert whole.min() > 1.0


def test_whoever_is_held_by_nothing_is_carried_where_he_is_wanted(solve):
    solved = solve(position(arm("left")[2], way=(1.0, 0.5, 2.0)))
    assert solved.errors.max() <= 1e-5


def test_a_body_without_a_trunk_to_tell_moves_like_any(solve):
    solved = solve(position(HEAD, way=(0.1, -0.05, 0.1)))
    assert solved.errors.max() <= 1e-5
    assert not solved.moved(*arm("left"), *arm("right"))

"""Stiffness, limits, priorities inside a chain, and whom nobody recruits (2005, section 11)."""

import numpy as np

from usdmotion.kernels import from_vector

from .conftest import CHEST, HEAD, arm, at, leg, orientation, position, within_reach

FAR = (0.2, 0.1, 0.3)
SPINE = "pelvis/spine"


def test_a_joint_of_stiffness_1_does_not_move(solve):
    solved = solve(position(arm("left")[2], way=FAR), stiffness={CHEST: 1.0})
    assert solved.errors.max() <= 1e-5
    assert not solved.moved(CHEST)
    assert solved.moved(SPINE)


def test_the_stiffer_a_joint_is_the_less_it_moves(solve):
    turns = [
        solve(position(arm("left")[2], way=FAR), stiffness={CHEST: each}).turned(CHEST).mean()
        for each in (0.0, 0.5, 0.9)
    ]
    assert turns[0] > turns[1] > turns[2] > 0.0


def test_a_stiff_elbow_leaves_it_to_the_others(solve):
    _, elbow, wrist = arm("left")
    goal = at(wrist, within_reach("left"))
    solved = solve(goal, stiffness={elbow: 1.0})
    assert not solved.moved(elbow)
    assert solved.errors.max() <= 1e-5


def test_from_the_extremity_to_the_root_but_the_lower_number_first(solve):
    turn = from_vector(np.array([0.3, 0.0, 0.0]))
    goal = orientation(HEAD, turn=turn, recruits=(SPINE, CHEST))
    plain = solve(goal, options={"damping": 3.0})
    assert plain.errors.max() <= 1e-3
    assert plain.moved(CHEST) and not plain.moved(SPINE)
    told = solve(goal, options={"damping": 3.0}, priorities={SPINE: -1})
    assert told.errors.max() <= 1e-3
    assert told.moved(SPINE) and not told.moved(CHEST)


def test_the_trunk_moves_first_where_it_is_told_to(solve):
    goal = at(arm("left")[2], within_reach("left"))
    assert not solve(goal).moved(SPINE)
    assert solve(goal, priorities={SPINE: -1}).moved(SPINE)


def test_limits_stand_above_every_rank(solve):
    _, elbow, wrist = arm("left")
    low, high = (-180.0, -45.0, -180.0), (180.0, 0.0, 180.0)
    solved = solve(
        position(wrist, way=(-0.3, 0.3, 0.1)), limits_min={elbow: low}, limits_max={elbow: high}
    )
    assert solved.problem.cast.beyond_limits(solved.solution.rotations).max() <= 1e-6


def test_only_what_is_recruited_moves_and_only_the_root_is_translated(solve):
    shoulder, elbow, wrist = arm("left")
    solved = solve(position(wrist, way=(1.0, 1.0, 1.0), recruits=(elbow,)))
    assert solved.moved(elbow)
    assert not solved.moved("pelvis", SPINE, CHEST, shoulder, wrist, *arm("right"), *leg("left"))


def test_damping_shares_a_turn_more_evenly(solve):
    goal = position(arm("left")[2], way=FAR)
    shares = []
    for damping in (0.02, 3.0):
        solved = solve(goal, options={"damping": damping, "iterations": 200, "shift_after": 100})
        one, other = solved.turned(CHEST), solved.turned(SPINE)
        shares.append(np.abs(one - other).mean() / (one + other).mean())
    assert shares[0] <= shares[1]


def test_a_knee_bends_about_its_hinge_and_forward(solve):
    hip, knee, ankle = leg("left")
    solved = solve(position(ankle, way=(0.0, 0.2, 0.05), recruits=(hip, knee)))
    assert solved.errors.max() <= 1e-5
    middle = 0.5 * (solved.places(hip) + solved.places(ankle))
    assert ((solved.places(knee) - middle)[:, 2] > 0.0).all()

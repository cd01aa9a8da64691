"""Every kind of task is met by groups, and lets go without a jump."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import AimConstraint, DistanceConstraint, Goal
from usdmotion.kernels import from_vector
from usdmotion.testing import HUMANOID

from .conftest import HEAD, arm, at, balance, feet, orientation, position, within_reach

TURN = from_vector(np.array([0.2, 0.4, -0.1]))
LEFT, RIGHT = arm("left"), arm("right")


def apart(distance: float, **fields) -> DistanceConstraint:
    """Return wrists that are to be so far from each other [m]."""
    return DistanceConstraint(
        path=f"{HUMANOID}/Edit/Apart",
        skeleton=HUMANOID,
        joint=LEFT[2],
        other_joint=RIGHT[2],
        distance=distance,
        recruits=(*LEFT[:2], *RIGHT[:2]),
        **fields,
    )


def aim() -> AimConstraint:
    """Return a head that is to look at a point."""
    return AimConstraint(
        path=f"{HUMANOID}/Edit/Look",
        skeleton=HUMANOID,
        joint=HEAD,
        recruits=(HEAD,),
        goals=(Goal(translation=np.array([1.0, 1.2, 3.0])),),
    )


KINDS = {
    "position": lambda: [at(LEFT[2], within_reach("left"))],
    "position along an axis": lambda: [position(LEFT[2], way=(0.0, 0.1, 0.0), axes="y")],
    "orientation": lambda: [orientation(HEAD, turn=TURN, recruits=(HEAD,))],
    "position and orientation": lambda: [
        position(LEFT[2], way=(-0.05, 0.05, 0.05)),
        orientation(LEFT[2], turn=TURN),
    ],
    "distance": lambda: [apart(0.3)],
    "aim": lambda: [aim()],
    "centre of mass": lambda: [*feet(), balance(2, way=(0.02, -0.02, 0.03))],
}


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_met(solve, kind):
    assert solve(*KINDS[kind]()).errors.max() <= 1e-3


@pytest.mark.parametrize("kind", KINDS)
def test_it_comes_and_goes_without_a_jump(solve, kind):
    *others, it = KINDS[kind]()

    def posed(activity: float):
        return solve(*others, replace(it, activity=activity)).solution.rotations

    for end, near in ((0.0, 1e-6), (1.0, 1.0 - 1e-6)):
        assert np.abs(posed(end) - posed(near)).max() <= 1e-4
    # Half of it is somewhere between.
    assert np.abs(posed(0.5) - posed(0.0)).max() > 1e-3


def test_hands_share_the_way_to_each_other(solve):
    solved = solve(apart(0.2))
    moved = [solved.turned(side[0]).mean() for side in (LEFT, RIGHT)]
    assert max(moved) <= 1.5 * min(moved)


def test_a_bound_asks_for_nothing_until_it_is_touched(solve):
    solved = solve(apart(0.01, bound="atLeast"))
    assert not solved.moved(*LEFT, *RIGHT)

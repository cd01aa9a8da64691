"""2005, figure 12, on captured motion: a far thing is taken on feet and balance that are kept."""

import numpy as np
import pytest

from usdmotion.constraints import CenterOfMassConstraint, Goal, PositionConstraint

WRIST, SHOULDER = "l_radiocarpal", "l_shoulder"
FARTHER = 0.25
"""How far beyond the arm's reach the wrist is to be, over the length of the arm."""


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(clip.calm(WRIST))


@pytest.fixture(scope="module")
def place(clip):
    """Return a place ahead of the shoulder and below it, farther than the arm is long [m]."""
    frame = clip.calm(WRIST)
    shoulder = clip.take.point(clip.token(SHOULDER))
    way = clip.ahead(frame) - 0.5 * clip.up
    return shoulder + (1.0 + FARTHER) * clip.arm * way / np.linalg.norm(way)


def asked(clip, keys, place, balanced):
    feet = clip.feet(priority=1)
    supports = [sole for side in "lr" for sole in clip.soles(side)]
    balance = CenterOfMassConstraint(
        path="Balance",
        skeleton=clip.skeleton,
        priority=2,
        supports=tuple(joint for joint, _ in supports),
        support_points=np.array([point for _, point in supports]),
        axes=clip.ground_axes,
    )
    wrist = PositionConstraint(
        path="Wrist",
        skeleton=clip.skeleton,
        joint=clip.token(WRIST),
        priority=3,
        goals=(Goal(path="Thing", translation=place, times=keys),),
    )
    return [*feet, *([balance] if balanced else []), wrist]


@pytest.fixture(scope="module", params=[True, False], ids=["balanced", "unbalanced"])
def solved(request, clip, ask, keys, place):
    constraints = asked(clip, keys, place, request.param)
    return request.param, ask(clip, constraints, knees="", solver="ccd")


def test_feet_and_balance_are_kept_and_the_thing_is_taken(clip, solved, keys, place):
    balanced, solved = solved
    for side in "lr":
        for joint, point in clip.soles(side):
            assert solved.moved(joint, point) <= 1.0
        # A knee that the body sinks or rises for turns faster than one that only walks.
        assert solved.pops(clip.token(f"{side}_knee")) <= 5.0
    there = clip.within(keys)
    missed = solved.after.point(clip.token(WRIST)) - place
    assert solved.millimetres(missed[there]) <= 2.0
    moved = solved.after.center_of_mass(clip.body) - solved.before.center_of_mass(clip.body)
    moved = moved - np.outer(moved @ clip.up, clip.up)
    if balanced:
        assert solved.millimetres(moved) <= 5.0
    else:
        assert solved.millimetres(moved[there]) >= 10.0

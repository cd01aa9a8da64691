"""2005, figure 12: who takes a far thing keeps his feet, and his balance if that is asked."""

import numpy as np
import pytest

from usdmotion.demos.grasp import FAR, FRAMES, TOO_FAR
from usdmotion.demos.performances import reach

ALL = pytest.mark.parametrize("asked", ["balanced", "unbalanced", "unreachable"])


@pytest.fixture
def solved(shown, asked):
    return shown("grasp", asked=asked)


def balance_lost(solved):
    """Return how far the centre of mass ever is from where it was, along the ground [mm]."""
    body = reach().body
    moved = solved.after.center_of_mass(body) - solved.before.center_of_mass(body)
    return solved.millimetres(moved[:, [0, 2]])


@ALL
def test_the_feet_stand(solved, asked):
    reaching = reach()
    for side in ("Left", "Right"):
        assert solved.moved(f"{side}Foot", reaching.heel_point) <= 1.0
        assert solved.moved(f"{side}ToeBase", reaching.toe_point) <= 1.0


@pytest.mark.parametrize("asked", ["balanced", "unbalanced"])
def test_the_thing_is_taken(solved, asked):
    assert solved.millimetres((solved.after.point("RightHand") - FAR)[solved.on(FRAMES)]) <= 2.0


@pytest.mark.parametrize("asked", ["balanced", "unreachable"])
def test_the_balance_is_kept(solved, asked):
    assert balance_lost(solved) <= 5.0


def test_without_being_asked_it_is_not(shown):
    assert balance_lost(shown("grasp", asked="unbalanced")) >= 20.0


def test_the_pelvis_goes_back_for_it(shown):
    kept, lost = (shown("grasp", asked=name) for name in ("balanced", "unbalanced"))
    there = kept.on(FRAMES)
    assert (
        kept.after.point("Hips")[there, 2].max() < lost.after.point("Hips")[there, 2].min() - 0.02
    )


def test_an_arm_stretches_at_what_it_cannot_reach(shown):
    solved = shown("grasp", asked="unreachable")
    there = solved.on(FRAMES)
    shoulder, elbow, wrist = (
        solved.after.point(name)[there] for name in ("RightArm", "RightForeArm", "RightHand")
    )
    assert np.linalg.norm(TOO_FAR - wrist, axis=1).min() > 0.1
    assert angle(elbow - shoulder, wrist - elbow).max() <= 5.0
    assert angle(wrist - shoulder, TOO_FAR - shoulder).max() <= 3.0


def angle(a, b):
    """(F, 3), (F, 3) to (F,) [degrees]."""
    cosines = np.sum(a * b, axis=1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))


@pytest.mark.parametrize("asked", ["balanced", "unbalanced"])
def test_nothing_pops_and_it_comes_and_goes_without_a_jolt(solved, asked):
    for name in ("LeftLeg", "RightLeg"):
        assert solved.pops(name) <= 2.0
    for name in ("LeftForeArm", "RightForeArm"):
        assert solved.pops(name) <= 5.0
    assert solved.jolted() <= 5.0
    assert solved.apart(solved.away(FRAMES)) <= 0.1


def test_who_strains_for_what_he_cannot_reach_does_not_fling_about(shown):
    solved = shown("grasp", asked="unreachable")
    # Each frame is solved from its input: where the thing gets out of reach, that shows.
    assert solved.jolted() <= 16.0
    assert solved.apart(solved.away(FRAMES)) <= 0.1

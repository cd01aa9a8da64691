"""2005, figures 11 and 13: the elbow turns about the wrist's place to what it can of its own."""

import numpy as np
import pytest

from usdmotion.demos.wrist_and_elbow import ELBOWS, FRAMES, WRIST

BOTH = pytest.mark.parametrize("asked", ELBOWS)
ARM = ("RightArm", "RightForeArm", "RightHand")


@pytest.fixture
def solved(shown, asked):
    return shown("wrist_and_elbow", asked=asked)


def nearest_on_circle(shoulder, wrist, upper, lower, goal):
    """Return the place an elbow can have that is nearest to a goal, with both ends held."""
    way = wrist - shoulder
    distance = np.linalg.norm(way)
    along = way / distance
    ahead = (upper**2 - lower**2 + distance**2) / (2.0 * distance)
    radius = np.sqrt(upper**2 - ahead**2)
    aside = goal - shoulder - ((goal - shoulder) @ along) * along
    return shoulder + ahead * along + radius * aside / np.linalg.norm(aside)


@BOTH
def test_the_wrist_is_at_its_place(solved, asked):
    assert solved.millimetres((solved.after.point("RightHand") - WRIST)[solved.on(FRAMES)]) <= 1.0


def test_where_it_can_the_elbow_is_at_its_place_too(shown):
    solved = shown("wrist_and_elbow", asked="reachable")
    missed = solved.after.point("RightForeArm") - ELBOWS["reachable"]
    assert solved.millimetres(missed[solved.on(FRAMES)]) <= 1.0


def test_where_it_cannot_the_elbow_is_as_near_as_its_circle_allows(shown):
    solved = shown("wrist_and_elbow", asked="unreachable")
    shoulder, elbow, wrist = (solved.before.point(name) for name in ARM)
    lengths = [np.linalg.norm(b - a, axis=1) for a, b in ((shoulder, elbow), (elbow, wrist))]
    there = np.flatnonzero(solved.on(FRAMES))
    nearest = np.array(
        [
            nearest_on_circle(
                shoulder[f], WRIST, lengths[0][f], lengths[1][f], ELBOWS["unreachable"]
            )
            for f in there
        ]
    )
    assert np.linalg.norm(nearest - ELBOWS["unreachable"], axis=1).min() > 0.1
    assert solved.millimetres(solved.after.point("RightForeArm")[there] - nearest) <= 1.0


@BOTH
def test_the_shoulder_stays_where_it_is_and_the_arm_comes_and_goes_without_a_jolt(solved, asked):
    assert solved.moved("RightArm") <= 0.001
    assert solved.apart(solved.away(FRAMES)) <= 0.01
    assert solved.jolted(*ARM) <= 5.0

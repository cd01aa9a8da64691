"""2003, figure 1: a dancer's elbow has its place, and the forearm points where it cannot go."""

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

RAISED, BENT = np.radians((15.0, 40.0))
"""How far upper arm and forearm are to turn, ahead and up."""
BEYOND = 2.0
"""How far the wrist is to be from the elbow, as a share of the forearm's length."""
ARM = ("l_sternoclavicular", "l_shoulder", "l_elbow")
WRIST = "l_radiocarpal"

DANCES = pytest.mark.parametrize(
    "clip",
    [
        *("walk", "kicks"),
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("dance", "dance-turning", "rokoko-dance", "dab")
        ),
    ],
    indirect=True,
    scope="session",
)


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(clip.calm(WRIST))


@pytest.fixture(scope="module")
def moves(clip):
    """Return how far elbow and wrist are to be from where they would have been [m]."""
    frame = clip.calm(WRIST)
    shoulder, elbow, wrist = (
        clip.take.point(clip.token(part))[frame] for part in (*ARM[1:], WRIST)
    )
    toward = clip.ahead(frame) + clip.up
    raised = shoulder + towards(elbow - shoulder, toward, RAISED)
    return raised - elbow, raised + BEYOND * towards(wrist - elbow, toward, BENT) - wrist


def towards(vector, other, angle):
    """Return a vector turned by an angle to where another one points."""
    length = np.linalg.norm(vector)
    across = other - (other @ vector) * vector / length**2
    return np.cos(angle) * vector + np.sin(angle) * length * across / np.linalg.norm(across)


@pytest.fixture(scope="module")
def solved(clip, ask, keys, moves):
    constraints = [
        PositionConstraint(
            path=part,
            skeleton=clip.skeleton,
            joint=clip.token(part),
            priority=priority,
            recruits=tuple(clip.token(each) for each in ARM),
            goals=(Goal(path="Moved", mode="offset", translation=offset, times=keys),),
        )
        for priority, (part, offset) in enumerate(zip((ARM[2], WRIST), moves, strict=True), 1)
    ]
    return ask(clip, constraints)


@DANCES
def test_the_elbow_is_at_its_goal_on_the_plateau(clip, solved, keys, moves):
    elbow = clip.token(ARM[2])
    moved = solved.after.point(elbow) - solved.before.point(elbow)
    assert solved.millimetres((moved - moves[0])[clip.within(keys)]) <= 1.0


@DANCES
def test_the_forearm_points_at_the_goal_that_it_cannot_reach(clip, solved, keys, moves):
    there = clip.within(keys)
    elbow, wrist = (solved.after.point(clip.token(part))[there] for part in (ARM[2], WRIST))
    goal = solved.before.point(clip.token(WRIST))[there] + moves[1]
    assert np.linalg.norm(goal - wrist, axis=1).min() >= 0.02 * clip.height
    apart = [np.linalg.norm(each - elbow, axis=1) for each in (wrist, goal)]
    along = np.sum((wrist - elbow) * (goal - elbow), axis=1) / apart[0] / apart[1]
    assert np.degrees(np.arccos(np.minimum(along, 1.0))).max() <= 2.0


@DANCES
def test_no_joint_of_the_arm_jumps(clip, solved):
    arm = [clip.token(part) for part in ARM]
    fastest = max(solved.before.speed(joint).max() for joint in arm)
    assert max(solved.after.speed(joint).max() for joint in arm) <= fastest + 5.0

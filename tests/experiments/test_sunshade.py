"""2003, figure 8: a hand stays above the eyes while the head turns."""

import numpy as np

from usdmotion.demos import sunshade
from usdmotion.demos.walker import SKELETON


def in_head(take, name):
    """Return the trajectory of a joint in the frame of the head [m]."""
    head = np.linalg.inv(take.world[:, take.index("Head")])
    places = np.concatenate([take.point(name), np.ones((len(take.times), 1))], axis=1)
    return np.einsum("fi,fij->fj", places, head)[:, :3]


def test_the_hand_is_above_the_eyes_on_the_plateau(demo, solve):
    solved = solve(demo("sunshade"), SKELETON)
    _, start, end, _ = sunshade.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    apart = in_head(solved.after, "RightHand") - sunshade.ABOVE_EYES
    assert solved.millimetres(apart[there]) <= 0.02


def test_the_head_turns_as_in_the_input(demo, solve):
    solved = solve(demo("sunshade"), SKELETON)
    assert solved.turned("Head") == 0.0
    assert np.ptp(solved.before.turn("Head").as_rotvec()[:, 1]) > 1.0


def test_only_the_arm_moves(demo, solve):
    solved = solve(demo("sunshade"), SKELETON)
    for index, token in enumerate(solved.before.joints):
        if token.rsplit("/", 1)[-1] not in sunshade.ARM:
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])


def test_no_joint_jumps(demo, solve):
    solved = solve(demo("sunshade"), SKELETON)
    for name in sunshade.ARM:
        turn = solved.after.turn(name)
        speed = np.degrees((turn[:-1].inv() * turn[1:]).magnitude())
        assert np.abs(np.diff(speed)).max() < 8.0

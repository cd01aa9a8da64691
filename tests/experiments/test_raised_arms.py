"""2003, figure 7: arms that stay raised against the thorax, while the body walks on."""

import numpy as np
import pytest

from usdmotion.demos import raised_arms
from usdmotion.demos.walker import SKELETON


@pytest.fixture
def solved(demo, solve):
    return solve(demo("raised_arms"), SKELETON)


def in_thorax(take, name):
    """Return the trajectory of a joint in the frame of the upper thorax [m]."""
    thorax = np.linalg.inv(take.world[:, take.index("Spine2")])
    places = np.concatenate([take.point(name), np.ones((len(take.times), 1))], axis=1)
    return np.einsum("fi,fij->fj", places, thorax)[:, :3]


@pytest.mark.parametrize(("side", "mirror"), [("Left", 1.0), ("Right", -1.0)])
def test_wrists_and_elbows_are_at_their_places_on_the_plateau(solved, side, mirror):
    _, start, end, _ = raised_arms.FRAMES
    there = (solved.after.times >= start) & (solved.after.times <= end)
    assert there.sum() == end - start + 1
    for joint, place in (("ForeArm", raised_arms.ELBOW), ("Hand", raised_arms.WRIST)):
        apart = in_thorax(solved.after, f"{side}{joint}") - place * (mirror, 1.0, 1.0)
        assert solved.millimetres(apart[there]) <= 0.1


def test_the_body_walks_meanwhile(solved):
    thorax = solved.after.point("Spine2")
    assert np.ptp(thorax[:, 2]) > 6.0
    assert solved.moved("Spine2") == 0.0


def test_only_the_arms_move(solved):
    for index, token in enumerate(solved.before.joints):
        if not token.endswith(raised_arms.ARM):
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index])


def test_no_joint_jumps(solved):
    for side in ("Left", "Right"):
        for name in raised_arms.ARM:
            speed = solved.after.speed(f"{side}{name}")
            assert speed.max() < 22.0
            assert np.abs(np.diff(speed)).max() < 8.0

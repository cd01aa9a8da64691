"""2005, section 9, on captured motion: what the arm can reach it reaches alone."""

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

ARM = ("l_shoulder", "l_elbow", "l_radiocarpal")
STRETCH = 0.85
"""How far the wrist is to be from the shoulder, over the length of the arm."""
SWING = np.radians(30.0)
"""How far it swings about the shoulder, ahead and up."""


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(clip.calm(ARM[2]))


@pytest.fixture(scope="module")
def place(clip):
    shoulder, wrist = (clip.take.point(clip.token(part)) for part in (ARM[0], ARM[2]))
    way = (wrist - shoulder) / np.linalg.norm(wrist - shoulder, axis=1, keepdims=True)
    toward = clip.ahead(clip.calm(ARM[2])) + clip.up
    toward = toward - np.sum(toward * way, axis=1, keepdims=True) * way
    toward /= np.linalg.norm(toward, axis=1, keepdims=True)
    return shoulder + STRETCH * clip.arm * (np.cos(SWING) * way + np.sin(SWING) * toward)


@pytest.fixture(scope="module")
def solved(clip, ask, keys, place):
    wrist = PositionConstraint(
        path="Wrist",
        skeleton=clip.skeleton,
        joint=clip.token(ARM[2]),
        goals=(Goal(path="Place", translation=place, times=keys),),
    )
    return ask(clip, [wrist], solver="ccd")


def test_the_wrist_is_at_its_place(clip, solved, keys, place):
    missed = solved.after.point(clip.token(ARM[2])) - place
    assert solved.millimetres(missed[clip.within(keys)]) <= 1.0


def test_not_one_joint_of_the_trunk_moves(clip, solved):
    arm = clip.chain(ARM[2], ARM[0])
    for index, joint in enumerate(solved.before.joints):
        if joint not in arm:
            assert np.array_equal(solved.after.local[:, index], solved.before.local[:, index]), (
                joint
            )
    root = clip.token("humanoid_root")
    assert np.array_equal(solved.after.point(root), solved.before.point(root))

"""What a captured motion already does costs it nothing."""

import numpy as np

from usdmotion.constraints import OrientationConstraint, PositionConstraint


def test_constraints_that_the_clip_meets_give_the_clip_back(clip, ask):
    wrist = PositionConstraint(
        path="Wrist", skeleton=clip.skeleton, joint=clip.token("l_radiocarpal"), priority=2
    )
    head = OrientationConstraint(
        path="Head", skeleton=clip.skeleton, joint=clip.token("skullbase"), priority=3
    )
    solved = ask(clip, [*clip.feet(priority=1), wrist, head])
    apart = solved.after.world[:, :, 3, :3] - solved.before.world[:, :, 3, :3]
    assert solved.millimetres(apart) <= 0.1
    assert max(map(solved.turned, solved.before.joints)) <= 0.05


def test_no_constraints_give_the_clip_back_to_the_bit(clip, ask):
    solved = ask(clip, [])
    assert np.array_equal(solved.after.local, solved.before.local)
    assert np.array_equal(solved.after.world, solved.before.world)

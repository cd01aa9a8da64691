"""2003, figure 8: a hand stays above the eyes, wherever the head goes."""

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

ARM = ("r_sternoclavicular", "r_shoulder", "r_elbow")
WRIST = "r_radiocarpal"
ABOVE_EYES = (-0.045, 0.065, 0.09)
"""Where the wrist is to be from the skull's base: to the left, up, ahead, shares of the height."""


@pytest.fixture(scope="module")
def keys(clip):
    return clip.keys(len(clip.take.times) // 2)


@pytest.fixture(scope="module")
def place(clip):
    """Return where the wrist is to be in the frame of the head [m]."""
    above = clip.at_rest("skullbase") + clip.height * clip.rest_way(*ABOVE_EYES)
    return clip.in_rest_of(clip.token("skullbase"), above)


@pytest.fixture(scope="module")
def solved(clip, ask, keys, place):
    head = (clip.skeleton, clip.token("skullbase"))
    wrist = PositionConstraint(
        path="Hand",
        skeleton=clip.skeleton,
        joint=clip.token(WRIST),
        recruits=tuple(clip.token(part) for part in ARM),
        goals=(Goal(path="AboveEyes", translation=place, joint=head, times=keys),),
    )
    return ask(clip, [wrist])


def test_the_hand_is_above_the_eyes_on_the_plateau(clip, solved, keys, place):
    seen = solved.after.seen_from(clip.token("skullbase"), clip.token(WRIST))
    assert solved.millimetres((seen - place)[clip.within(keys)]) <= 2.0


def test_the_head_turns_as_in_the_input(clip, solved):
    head = solved.before.index(clip.token("skullbase"))
    assert np.array_equal(solved.after.world[:, head], solved.before.world[:, head])

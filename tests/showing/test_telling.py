"""A motion is told by its ends, by what is missed most, and by what is wanted for a while."""

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.showing import shown
from usdmotion.showing.telling import USUAL, telling_frames
from usdmotion.testing import HUMANOID


def reach(outcome, offset, name="left_wrist", times=()):
    return PositionConstraint(
        path=f"{HUMANOID}/Edit/{name}",
        skeleton=HUMANOID,
        joint=outcome.token(name),
        goals=(Goal(mode="offset", translation=np.asarray(offset), times=times),),
    )


def told_of(given):
    seen = shown(given)
    return telling_frames(seen.edits[0], len(seen.scene.times)), seen.scene.times


@pytest.mark.parametrize("frame_count", [1, 2, 5, 90])
def test_a_motion_is_told_from_its_first_to_its_last_frame(outcome, frame_count):
    told, _ = told_of(outcome([reach(outcome, (0.0, 0.1, 0.0))], frame_count=frame_count))
    assert told == sorted(set(told)) and len(told) == min(frame_count, USUAL)
    assert (told[0], told[-1]) == (0, frame_count - 1)


def test_what_is_worst_and_what_is_wanted_for_a_while_is_told(outcome):
    offset = np.zeros((96, 3))
    offset[:, 1] = np.where(np.arange(96) == 50, 0.1, 0.0)
    wrists = [
        reach(outcome, offset),
        reach(outcome, np.zeros(3), "right_wrist", times=(0.5, 0.6, 1.0, 1.1)),
    ]
    told, times = told_of(outcome(wrists, frame_count=96))
    assert 50 in told
    assert np.abs(times[told] - 0.8).min() < 0.05

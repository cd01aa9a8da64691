"""Threads of a performance: they end with it, and it is all the same how many they are."""

import gc
import threading

import numpy as np
import pytest
from usdmotion_ccd import CyclicDescent

from usdmotion import Goal, PositionConstraint, Problem, cue
from usdmotion.testing import crowd_scene, member

WRIST = "pelvis/spine/chest/right_shoulder/right_elbow/right_wrist"


def raising(count, frames=3):
    """Return a problem in which everybody raises a hand."""
    asked = [
        PositionConstraint(
            path=f"{member(index)}/Edit/Up",
            skeleton=member(index),
            joint=WRIST,
            goals=(Goal(mode="offset", translation=np.array([0.0, 0.2, 0.1])),),
        )
        for index in range(count)
    ]
    return Problem.of(crowd_scene(asked, count=count, frame_count=frames))


def test_threads_end_with_the_performance_that_they_work_for():
    before = set(threading.enumerate())
    performance = CyclicDescent(threads=3).start(raising(9))
    performance.step()
    own = set(threading.enumerate()) - before
    assert len(own) == 3
    del performance
    gc.collect()
    for each in own:
        each.join(10.0)
    assert not any(each.is_alive() for each in own)


def test_who_is_alone_needs_no_threads():
    before = threading.active_count()
    CyclicDescent(threads=8).start(raising(1)).step()
    assert threading.active_count() == before


@pytest.mark.parametrize("count", [1, 2, 5, 40])
def test_everybody_is_stepped_however_the_work_is_shared_out(count):
    problem = raising(count)
    found = []
    for threads in (1, 2, 7):
        performance = CyclicDescent(threads=threads).start(problem)
        cue(performance, problem, 2)
        performance.step()
        found.append(np.array(performance.output.rotations))
    assert np.array_equal(found[0], found[1])
    assert np.array_equal(found[0], found[2])
    moved = np.abs(found[0] - problem.cast.rotations[2]).reshape(count, -1).max(axis=1)
    assert (moved > 1e-3).all()

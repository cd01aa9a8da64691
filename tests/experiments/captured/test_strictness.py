"""2004, section 3: on captured bodies too, what ranks lower does not disturb what ranks higher."""

from itertools import pairwise

import numpy as np
import pytest

from usdmotion.cast import Character
from usdmotion.constraints import Goal, PositionConstraint
from usdmotion.measuring import measure
from usdmotion.motion import Motion, Placement
from usdmotion.plugins import host
from usdmotion.scene import Edit, Scene
from usdmotion.solving import Problem

LEVELS = 5
FEASIBLE = 1e-7


@pytest.fixture
def character(clip):
    """Return three frames of the clip as a character, from somewhere in its three seconds."""

    def of(seed):
        start = (
            int(clip.frames[0]) - 1 + np.random.default_rng(seed).integers(len(clip.seconds) - 3)
        )
        motion, frames = clip.recording.motion, slice(start, start + 3)
        times = motion.times[frames] - motion.times[start]
        part = Motion(times, motion.translations[frames], motion.rotations[frames])
        here = Placement.identity(3)
        return Character(clip.skeleton, clip.recording.skeleton, clip.body, part, here, 0)

    return of


def stack(clip, seed, reach):
    """Return a constraint a level, on joints of the map, as far from the input as `reach` says."""
    random = np.random.default_rng(seed)
    joints = [joint for joint, part in enumerate(clip.parts.parts) if part]
    return [
        PositionConstraint(
            path=f"Level{level}",
            skeleton=clip.skeleton,
            joint=clip.recording.skeleton.joints[random.choice(joints[1:])],
            point=0.06 * clip.height * random.normal(size=3),
            priority=level,
            goals=(Goal(mode="offset", translation=reach * clip.height * random.normal(size=3)),),
        )
        for level in range(1, LEVELS + 1)
    ]


def left_of(character, constraints, up):
    """Return what is left of each constraint on each frame [m]."""
    edit = Edit(f"{character.path}/Edit", character.path, tuple(constraints))
    scene = Scene((character,), (edit,), np.arange(3), up)
    problem = Problem.of(scene)
    return measure(problem, host().solver("prioritized_ik")().solve(problem), scene.constraints)


@pytest.mark.parametrize("reach", [0.05, 0.2])
def test_a_lower_level_added_disturbs_no_higher_one(clip, character, reach):
    within, beyond = [np.zeros(1)], [np.zeros(1)]
    for seed in range(10):
        constraints = stack(clip, seed, reach)
        lefts = [
            left_of(character(seed), constraints[:count], clip.up) for count in range(1, LEVELS + 1)
        ]
        for before, after in pairwise(lefts):
            change = np.abs(after[:, : before.shape[1]] - before)
            within.append(change[before <= FEASIBLE])
            beyond.append(change[before > FEASIBLE])
    within, beyond = np.concatenate(within), np.concatenate(beyond)
    assert len(within) > 10 if reach < 0.1 else len(beyond) > 10
    assert within.max() < 1e-6
    assert beyond.max() <= 1e-4

"""2004, figure 4: an ankle rises against a footplant that was found in the clip."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import Goal, PositionConstraint

HIGHER = 0.08
"""How far the ankle is to be above where it would have been, as a share of the height."""


@pytest.fixture(scope="module")
def step(clip):
    """Return a side that stands, and four key times within its longest stance."""
    longest = {side: max(clip.stances(side), key=lambda s: s[1] - s[0]) for side in "lr"}
    side = max("lr", key=lambda side: longest[side][1] - longest[side][0])
    return side, clip.keys(int(np.mean(longest[side])))


def asked(clip, step):
    side, keys = step
    higher = Goal(
        path="Higher",
        mode="offset",
        translation=HIGHER * clip.height * clip.up,
        times=keys,
    )
    ankle = PositionConstraint(
        path="Ankle",
        skeleton=clip.skeleton,
        joint=clip.token(f"{side}_talocrural"),
        goals=(higher,),
    )
    return [*clip.feet(priority=2), ankle]


@pytest.fixture(scope="module")
def ranked(clip, ask, step):
    return ask(clip, asked(clip, step))


@pytest.fixture(scope="module")
def weighted(clip, ask, step):
    return ask(clip, [replace(each, priority=1) for each in asked(clip, step)])


def short(clip, solved, step):
    """Return how far the ankle is from where it has to be on the plateau [m], a row a frame."""
    side, keys = step
    ankle = clip.token(f"{side}_talocrural")
    lifted = solved.after.point(ankle) - solved.before.point(ankle)
    return (lifted - HIGHER * clip.height * clip.up)[clip.within(keys)]


def test_with_priorities_the_ankle_rises(clip, ranked, step):
    assert ranked.millimetres(short(clip, ranked, step)) <= 1.0


def test_with_one_priority_it_ends_between(clip, weighted, step):
    share = np.linalg.norm(short(clip, weighted, step), axis=1) / (HIGHER * clip.height)
    assert share.min() >= 0.2
    assert share.max() <= 0.8


def test_the_other_foot_keeps_its_trajectory(clip, ranked, step):
    (other,) = set("lr") - {step[0]}
    for sole in clip.soles(other):
        assert ranked.moved(*sole) <= 1.0

"""2004, figures 5 and 6: captured kicks, higher than they were and than they can be."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import (
    CenterOfMassConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
)

UNREACHABLE = 1.0
"""How far above its highest place the ankle is to be, as a share of the height."""
REACHABLE = (-0.06, 0.02, 0.04, 0.06)
KICKS = pytest.mark.parametrize(
    "clip",
    ["kicks", *(pytest.param(name, marks=pytest.mark.slow) for name in ("kata", "rokoko-dance"))],
    indirect=True,
    scope="session",
)


@pytest.fixture(scope="module")
def kick(clip):
    """Return the side that kicks, the one that stands, and the frame of the kick."""
    heights = {s: clip.take.point(clip.token(f"{s}_talocrural")) @ clip.up for s in "lr"}
    side = max("lr", key=lambda side: heights[side].max())
    (other,) = set("lr") - {side}
    return side, other, int(heights[side].argmax())


def asked(clip, kick, higher):
    """Return the planted foot (1), the balance (2) and the kicking ankle (3)."""
    side, other, _ = kick
    soles = clip.soles(other)
    goal = Goal(
        path="High",
        mode="offset",
        translation=higher * clip.height * clip.up,
        times=times(clip, kick),
    )
    roll = OrientationConstraint(path="Foot", skeleton=clip.skeleton, joint=soles[0][0])
    balance = CenterOfMassConstraint(
        path="Balance",
        skeleton=clip.skeleton,
        priority=2,
        supports=tuple(joint for joint, _ in soles),
        support_points=np.array([point for _, point in soles]),
        axes=clip.ground_axes,
    )
    ankle = PositionConstraint(
        path="Ankle",
        skeleton=clip.skeleton,
        joint=clip.token(f"{side}_talocrural"),
        priority=3,
        recruits=clip.recording.skeleton.joints,
        goals=(goal,),
    )
    return [*clip.feet(priority=1, sides=other), roll, balance, ankle]


def times(clip, kick):
    return clip.keys(kick[2], there=1)


@pytest.fixture(scope="module")
def ranked(clip, ask, kick):
    return ask(clip, asked(clip, kick, UNREACHABLE), knees="")


@pytest.fixture(scope="module")
def weighted(clip, ask, kick):
    alike = [replace(each, priority=1) for each in asked(clip, kick, UNREACHABLE)]
    return ask(clip, alike, knees="")


def planted_moved(clip, solved, kick):
    return max(solved.moved(*sole) for sole in clip.soles(kick[1]))


def balance_moved(clip, solved):
    takes = solved.after, solved.before
    after, before = (each.center_of_mass(clip.body) for each in takes)
    return solved.millimetres((after - before) * (1.0 - clip.up))


def ankle_missed(clip, solved, kick, higher):
    ankle = clip.token(f"{kick[0]}_talocrural")
    lifted = solved.after.point(ankle) - solved.before.point(ankle)
    there = clip.within(times(clip, kick))
    return solved.millimetres((lifted - higher * clip.height * clip.up)[there])


@KICKS
def test_the_planted_foot_stands_and_the_balance_holds_although_the_ankle_misses(
    clip, ranked, kick
):
    assert ankle_missed(clip, ranked, kick, UNREACHABLE) >= 100.0
    assert planted_moved(clip, ranked, kick) <= 1.0
    assert balance_moved(clip, ranked) <= 5.0


@KICKS
def test_with_one_priority_the_planted_foot_moves(clip, weighted, kick):
    assert planted_moved(clip, weighted, kick) >= 20.0


@KICKS
@pytest.mark.parametrize("higher", REACHABLE)
def test_heights_within_reach_are_reached(clip, ask, kick, higher):
    solved = ask(clip, asked(clip, kick, higher), knees=kick[1])
    assert ankle_missed(clip, solved, kick, higher) <= 2.0
    assert planted_moved(clip, solved, kick) <= 1.0
    assert balance_moved(clip, solved) <= 5.0
    knee = clip.token(f"{kick[0]}_knee")
    # The leg that goes higher in the same time has to be faster.
    assert solved.pops(knee) <= 2.0 + 0.1 * solved.before.speed(knee).max()

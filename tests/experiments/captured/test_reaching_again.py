"""2004, section 6, on whoever was captured: a moved goal ends where a solve from scratch does."""

from dataclasses import replace

import numpy as np
import pytest
from pxr import Sdf, Usd

from usdmotion import Session
from usdmotion.constraints import Goal, PositionConstraint

WRIST = "l_radiocarpal"
HERE, THERE = np.array([0.0, 0.05, 0.0]), np.array([0.05, 0.1, 0.05])
"""Where the goal is from the wrist's own way, as shares of the height."""


@pytest.fixture(scope="module")
def reach(clip):
    """Return the constraint that takes the wrist to an offset, for as long as the paper does."""
    keys = clip.keys(clip.calm("l_shoulder"))

    def run(offset):
        goal = Goal(path="Reach", mode="offset", translation=offset * clip.height, times=keys)
        return PositionConstraint(
            path="Wrist",
            skeleton=clip.skeleton,
            joint=clip.token(WRIST),
            priority=2,
            goals=(goal,),
        )

    return run


@pytest.fixture(scope="module")
def opened(clip, asked, reach):
    """Return what opens a session on feet that stay and a wrist that reaches."""

    def run(offset):
        constraints = [*clip.feet(priority=1), reach(offset)]
        return Session.open(asked(clip.shot, clip.skeleton, constraints, clip.take.times))

    return run


@pytest.fixture(scope="module")
def look(clip, taken, tmp_path_factory):
    """Return what writes an answer: its samples, and the composed stage through UsdSkel."""

    def run(session):
        folder = tmp_path_factory.mktemp("written")
        session.write(folder / "edit.usda", compose=folder / "shot.usda")
        layer = Sdf.Layer.FindOrOpen(str(folder / "edit.usda"))
        path = Sdf.Path(f"{clip.skeleton}/Edit_result.rotations")
        times = clip.take.times
        samples = [np.array(layer.QueryTimeSample(path, time)).tobytes() for time in times]
        return samples, taken(Usd.Stage.Open(str(folder / "shot.usda")), clip.skeleton, times)

    return run


def test_a_moved_goal_ends_where_a_solve_from_scratch_does(clip, opened, look, tell):
    session, scratch = opened(HERE), opened(THERE)
    (wrist,) = (each for each in scratch.constraints if each.goals)
    first, _ = look(session)
    change = session.set(wrist)
    again, found = look(session)
    _, wanted = look(scratch)
    apart = np.linalg.norm(found.world[:, :, 3, :3] - wanted.world[:, :, 3, :3], axis=-1)
    turned = max(
        float(np.degrees((found.turn(joint).inv() * wanted.turn(joint)).magnitude().max()))
        for joint in found.joints
    )
    count = change.frames.stop - change.frames.start
    tell(
        f"{clip.shot.stem}, reaching again: {count} of {len(first)} frames, "
        f"{1e3 * apart.max():.1e} mm and {turned:.1e} degrees from scratch"
    )
    assert 1e3 * apart.max() * 1.7 / clip.height <= 0.01 and turned <= 0.1
    kept = [*range(change.frames.start), *range(change.frames.stop, len(first))]
    assert all(again[frame] == first[frame] for frame in kept)
    assert change.frames.start > 0


def test_a_moved_goal_and_back_ends_where_it_began(opened, look):
    session = opened(HERE)
    (wrist,) = (each for each in session.constraints if each.goals)
    _, before = look(session)
    (goal,) = wrist.goals
    for share in np.linspace(0.0, 1.0, 7):
        moved = goal.translation + share * (THERE - HERE)
        session.set(replace(wrist, goals=(replace(goal, translation=moved),)))
    session.set(wrist)
    _, after = look(session)
    apart = np.linalg.norm(after.world[:, :, 3, :3] - before.world[:, :, 3, :3], axis=-1)
    assert 1e3 * apart.max() <= 0.01

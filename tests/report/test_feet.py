"""When feet stand is told by the input; how far they slide there, by either motion."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import PositionConstraint
from usdmotion.constraints import ContactConstraint
from usdmotion.kernels import forward
from usdmotion.report.feet import footings
from usdmotion.testing import HUMANOID, humanoid_scene


def feet_of(outcome):
    solution, cast = outcome.solution, outcome.scene.cast
    solved = forward(cast.parents, solution.translations, solution.rotations)
    return footings(outcome.scene, outcome.scene.edits[0], solved)


def slowed(outcome):
    """Return an outcome four times as slow, so that the swaying feet stand."""
    scene = outcome.scene
    characters = tuple(
        replace(each, motion=replace(each.motion, times=20.0 * each.motion.times))
        for each in scene.characters
    )
    return replace(outcome, scene=replace(scene, characters=characters))


def at(outcome, name, kind=PositionConstraint, **fields):
    path = f"{HUMANOID}/Edit/{fields.pop('path', name)}"
    return kind(path=path, skeleton=HUMANOID, joint=outcome.token(name), **fields)


def test_ankles_are_watched_where_nothing_holds_a_foot(outcome):
    assert [each.name for each in feet_of(slowed(outcome()))] == ["left ankle", "right ankle"]


def test_a_point_that_is_held_stands_for_its_foot(outcome):
    heel = at(outcome, "left_ankle", path="Heel", point=np.array((0.0, -0.08, -0.05)))
    wrist = at(outcome, "left_wrist")
    given = slowed(outcome([heel, wrist]))
    first, second = feet_of(given)
    assert (first.name, second.name) == ("Heel", "right ankle")
    node = given.scene.cast.index[HUMANOID, heel.joint]
    ankle = given.scene.cast.positions[:, node]
    assert np.linalg.norm(first.before - ankle, axis=1) == pytest.approx(np.hypot(0.08, 0.05))


def test_the_output_does_not_tell_when_a_foot_stands(outcome):
    flying = slowed(outcome(lift=0.5))
    kicking = slowed(outcome(turns={"left_hip": (-1.5, 0.0, 0.0)}))
    still = feet_of(slowed(outcome()))
    for other in (feet_of(flying), feet_of(kicking)):
        assert all(np.array_equal(a.stands, b.stands) for a, b in zip(still, other, strict=True))


def test_lifting_everything_slides_nothing(outcome):
    for foot in feet_of(slowed(outcome(lift=0.5))):
        assert np.allclose(foot.slid_before, foot.slid_after)
        assert np.allclose(foot.after - foot.before, (0.0, 0.5, 0.0))


def test_contacts_say_themselves_when_they_hold(outcome):
    times = humanoid_scene().cast.times
    contacts = [
        at(outcome, "left_ankle", ContactConstraint, path=name, times=(times[a], times[b]))
        for name, a, b in (("One", 2, 5), ("Two", 9, 14))
    ]
    foot = feet_of(outcome(contacts))[0]
    assert foot.name == "left_ankle"
    assert foot.stances == [(2, 6), (9, 15)]


def test_a_leg_is_as_long_as_its_bones_and_else_half_a_body(outcome):
    (whole,) = outcome().scene.characters
    assert whole.leg_length == pytest.approx(0.84)
    unknown = replace(whole, parts=None).leg_length
    assert 0.3 < unknown < 0.9

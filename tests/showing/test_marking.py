"""Marks over a pose: where things are then, what was and will be, and what is missed."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import Goal, PositionConstraint
from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.drawing.strips import Curve, Patch, Spot
from usdmotion.drawing.style import COURSE, MISSED
from usdmotion.showing import shown, shown_before
from usdmotion.showing.marking import marks
from usdmotion.testing import HUMANOID

FRAME = 9
RAISED = np.array((0.0, 0.3, 0.0))


@pytest.fixture
def reaching(outcome):
    """Return what makes an outcome whose wrist goes up with the root, or misses its goal there."""

    def make(lift):
        goals = (Goal(mode="offset", translation=RAISED, times=(0.1, 0.3, 0.6, 0.9)),)
        fields = {"skeleton": HUMANOID, "goals": goals}
        wrist, ankle = (outcome.token(name) for name in ("left_wrist", "left_ankle"))
        path = f"{HUMANOID}/Edit/"
        asked = PositionConstraint(path=f"{path}Wrist", joint=wrist, **fields)
        beside = PositionConstraint(
            path=f"{path}Beside", skeleton=HUMANOID, joint=wrist, point=0.1 * RAISED
        )
        balance = CenterOfMassConstraint(
            path=f"{path}Balance", skeleton=HUMANOID, priority=2, supports=(ankle,)
        )
        return outcome([asked, beside, balance], lift=lift)

    return make


def of_kind(kind, marked, **fields):
    same = [mark for mark in marked if isinstance(mark, kind)]
    return [m for m in same if all(getattr(m, name) == held for name, held in fields.items())]


def test_what_was_is_strong_and_what_will_be_is_pale(reaching):
    given = shown(reaching(0.3))
    course = given.edits[0].courses[0]
    # One that goes along it is not drawn.
    will_be, was = of_kind(Curve, marks(given, FRAME, after=True), color=COURSE)
    assert will_be.opacity < was.opacity == 1.0
    assert np.array_equal(was.points, course.after[: FRAME + 1])
    assert np.array_equal(will_be.points, course.after[FRAME:])
    inputs = [mark.points for mark in of_kind(Curve, marks(given, FRAME, after=False))]
    assert any(np.array_equal(each, course.before[: FRAME + 1]) for each in inputs)


def test_of_a_long_way_only_what_is_near_in_time_is_drawn(outcome):
    wrist = PositionConstraint(
        path=f"{HUMANOID}/Edit/Wrist", skeleton=HUMANOID, joint=outcome.token("left_wrist")
    )
    given = shown(outcome([wrist], frame_count=400))
    times, course = given.scene.times, given.edits[0].courses[0]
    for frame in (0, 200, 399):
        near = np.flatnonzero(np.abs(times - times[frame]) < 1.99)
        will_be, was = of_kind(Curve, marks(given, frame, after=True), color=COURSE)
        assert len(near) <= len(will_be.points) + len(was.points) - 1 <= len(near) + 2
        assert any((each == course.after[near[0]]).all() for each in was.points)
        assert any((each == course.after[near[-1]]).all() for each in will_be.points)


def test_a_goal_is_as_strong_as_it_is_on(reaching):
    given = shown(reaching(0.3))
    (goal,) = given.edits[0].goals
    strengths = []
    for frame, activity in enumerate(goal.activity):
        found = of_kind(Spot, marks(given, frame, after=True), sign="goal")
        assert len(found) == (activity > 0.0)
        if found:
            assert np.array_equal(found[0].point, goal.translations[frame])
            strengths.append((activity, found[0].opacity))
    ordered = sorted(strengths)
    assert [strong for _, strong in ordered] == sorted(strong for _, strong in strengths)
    assert ordered[-1] == (1.0, 1.0) and ordered[0][1] < 0.6


def test_only_what_is_missed_is_red_and_named(reaching):
    met, missed = (shown(reaching(lift)) for lift in (0.3, 0.0))
    for frame in range(len(met.scene.times)):
        assert not of_kind(Spot, marks(met, frame, after=True), text="Wrist")
    (miss,) = missed.edits[0].misses
    frame = int(miss.missed.argmax())
    marked = marks(missed, frame, after=True)
    (spot,) = of_kind(Spot, marked, sign="missed")
    assert (spot.text, spot.color) == ("Wrist", MISSED)
    assert not of_kind(Spot, marked, sign="goal")
    (line,) = of_kind(Curve, marked, color=MISSED)
    np.testing.assert_allclose(line.points[1] - line.points[0], RAISED, atol=1e-9)
    before = marks(missed, frame, after=False)
    assert of_kind(Spot, before, sign="goal") and not of_kind(Spot, before, sign="missed")


def test_the_centre_of_mass_is_plumb_over_the_level_of_its_supports(reaching):
    given = shown(reaching(0.3))
    balance = given.edits[0].balance
    marked = marks(given, FRAME, after=True)
    (spot,) = of_kind(Spot, marked, sign="mass")
    assert np.array_equal(spot.point, balance.after[FRAME])
    (plumb,) = of_kind(Curve, marked, dashed=True)
    (area,) = of_kind(Patch, marked)
    np.testing.assert_allclose(plumb.points[0, [0, 2]], plumb.points[1, [0, 2]])
    np.testing.assert_allclose(area.points[:, 1], plumb.points[1, 1])


def test_a_row_before_shows_the_supports_of_the_input(reaching):
    given = shown(reaching(0.3))
    balance = given.edits[0].balance
    for after, supports in ((False, balance.supports_before), (True, balance.supports)):
        (area,) = of_kind(Patch, marks(given, FRAME, after=after))
        np.testing.assert_allclose(area.points[:, 1], supports[FRAME, 0, 1])
    assert balance.supports[FRAME, 0, 1] - balance.supports_before[FRAME, 0, 1] == pytest.approx(
        0.3
    )


def test_what_is_drawn_of_a_body_grows_with_it(reaching):
    given = shown(reaching(0.3))
    actors = tuple(replace(each, character=_shorter(each.character, 1e-3)) for each in given.actors)
    (usual,), (small,) = (
        of_kind(Patch, marks(each, FRAME, after=True))
        for each in (given, replace(given, actors=actors))
    )
    np.testing.assert_allclose(np.ptp(small.points, axis=0), 1e-3 * np.ptp(usual.points, axis=0))


def _shorter(character, scale):
    skeleton = character.skeleton
    shorter = replace(skeleton, rest_translations=scale * skeleton.rest_translations)
    return replace(character, skeleton=shorter)


def test_a_scene_that_nobody_solved_shows_what_it_asks(reaching):
    given = shown_before(reaching(0.0).scene)
    assert of_kind(Spot, marks(given, 12, after=True), sign="goal")
    assert not of_kind(Spot, marks(given, 12, after=True), sign="missed")

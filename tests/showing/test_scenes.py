"""What there is to see of a scene: where things are, where they are wanted, and when."""

import numpy as np
import pytest

from usdmotion import Goal, OrientationConstraint, PositionConstraint
from usdmotion.constraints import (
    AimConstraint,
    CenterOfMassConstraint,
    ContactConstraint,
    DistanceConstraint,
)
from usdmotion.drawing.strips import Curve
from usdmotion.drawing.style import GOAL
from usdmotion.kernels import multiply, rotate, world_points
from usdmotion.report.findings import findings_of
from usdmotion.showing import shown, shown_before
from usdmotion.showing.marking import marks
from usdmotion.testing import HUMANOID

OFFSET = np.array((0.02, 0.05, 0.01))
BENT = {"spine": (0.3, 0.1, 0.0), "left_elbow": (0.0, 0.2, 0.0)}


def ask(outcome, kind=PositionConstraint, name="left_wrist", path="Asked", **fields):
    path = f"{HUMANOID}/Edit/{path}"
    return kind(path=path, skeleton=HUMANOID, joint=outcome.token(name), **fields)


def offset(**fields):
    return Goal(path=f"{HUMANOID}/Edit/Asked/Up", mode="offset", translation=OFFSET, **fields)


def edit_of(given):
    (edit,) = shown(given).edits
    return edit


def place(given, name, poses="positions"):
    cast = given.scene.cast
    return getattr(cast, poses)[:, cast.index[HUMANOID, given_token(given, name)]]


def given_token(given, name):
    joints = given.scene.characters[0].skeleton.joints
    return next(token for token in joints if token.rsplit("/", 1)[-1] == name)


def test_where_the_result_is_the_input_nothing_is_moved_and_nothing_missed(outcome):
    held = [ask(outcome), ask(outcome, OrientationConstraint, "head", "Head")]
    edit = edit_of(outcome(held))
    assert [course.name for course in edit.courses] == ["Asked", "Head"]
    for course in edit.courses:
        assert np.array_equal(course.before, course.after) and course.on.all()
    assert edit.misses == () and edit.goals == ()
    assert np.array_equal(edit.balance.before, edit.balance.after)


def test_a_point_has_one_course_however_often_something_is_asked_of_it(outcome):
    early = ask(outcome, path="Early", priority=3, times=(0.0, 0.1, 0.2, 0.3))
    late = ask(outcome, path="Late", priority=2, times=(0.6, 0.7, 0.8, 0.9))
    beside = ask(outcome, path="Beside", point=OFFSET)
    given = outcome([early, late, beside], turns=BENT)
    courses = {course.name: course for course in edit_of(given).courses}
    assert list(courses) == ["Beside", "Late"]
    times = given.scene.times
    inside = ((times > 0.0) & (times < 0.3)) | ((times > 0.6) & (times < 0.9))
    assert np.array_equal(courses["Late"].on, inside)
    assert courses["Late"].before == pytest.approx(place(given, "left_wrist"))
    turns = place(given, "left_wrist", "orientations")
    assert courses["Beside"].before == pytest.approx(
        place(given, "left_wrist") + rotate(turns, np.broadcast_to(OFFSET, (len(turns), 3)))
    )


@pytest.mark.parametrize("axes", ["xyz", "y", "xz"])
def test_what_is_missed_is_as_long_as_the_error(outcome, axes):
    times = (0.1, 0.3, 0.6, 0.8)
    given = outcome([ask(outcome, axes=axes, goals=(offset(times=times),))], turns=BENT)
    (miss,) = edit_of(given).misses
    (trace,) = findings_of(given).edits[0].traces
    assert np.array_equal(miss.missed, trace.missed) and miss.missed.any()
    assert np.linalg.norm(miss.wanted - miss.places, axis=1) == pytest.approx(trace.errors)


def test_a_turn_is_missed_where_its_joint_is(outcome):
    turn = ask(outcome, OrientationConstraint, "left_elbow")
    (miss,) = edit_of(outcome([turn], turns=BENT)).misses
    assert miss.wanted is None and miss.missed.all()


def test_an_offset_is_wanted_that_far_from_the_input(outcome):
    given = outcome([ask(outcome, goals=(offset(),))], turns=BENT)
    (goal,) = edit_of(given).goals
    assert goal.translations == pytest.approx(place(given, "left_wrist") + OFFSET)
    assert goal.name == "Asked/Up" and goal.rotations is None


def test_a_goal_is_as_active_as_it_and_its_constraint_are(outcome):
    fade = np.linspace(0.0, 1.0, 24)
    goal = offset(times=(0.1, 0.3, 0.6, 0.8), activity=0.5)
    given = outcome([ask(outcome, goals=(goal,), activity=fade)])
    (mark,) = edit_of(given).goals
    times = given.scene.times
    assert not mark.activity[(times <= 0.1) | (times >= 0.8)].any()
    assert mark.activity[12] == pytest.approx(0.5 * fade[12])


@pytest.mark.parametrize("mode", ["position", "offset"])
def test_a_goal_in_the_frame_of_a_joint_is_where_that_is_in_the_result(outcome, mode):
    head = (HUMANOID, outcome.token("head"))
    goal = Goal(path="Goal", mode=mode, translation=OFFSET, joint=head)
    given = outcome([ask(outcome, goals=(goal,))], turns=BENT)
    (mark,) = edit_of(given).goals
    positions, orientations = findings_of(given).after
    node = given.scene.cast.index[head]
    along = rotate(orientations[:, node], np.broadcast_to(OFFSET, (24, 3)))
    origin = positions[:, node] if mode == "position" else place(given, "left_wrist")
    assert mark.translations == pytest.approx(origin + along)


def test_several_goals_are_each_where_they_want_the_effector(outcome):
    there = Goal(path="There", translation=np.array((0.1, 1.2, 0.3)), activity=0.3)
    given = outcome([ask(outcome, goals=(there, offset()))])
    place_of, offset_of = edit_of(given).goals
    assert place_of.translations == pytest.approx(np.broadcast_to((0.1, 1.2, 0.3), (24, 3)))
    assert offset_of.translations == pytest.approx(place(given, "left_wrist") + OFFSET)


@pytest.mark.parametrize("carried", [False, True])
def test_a_turn_is_wanted_at_its_joint(outcome, carried):
    turned = np.array((0.0, 0.6, 0.0, 0.8))
    head = (HUMANOID, outcome.token("head"))
    goal = Goal(path="Goal", rotation=turned, joint=head if carried else None)
    given = outcome([ask(outcome, OrientationConstraint, goals=(goal,))], turns=BENT)
    (mark,) = edit_of(given).goals
    positions, orientations = findings_of(given).after
    frame = orientations[:, given.scene.cast.index[head]] if carried else (0.0, 0.0, 0.0, 1.0)
    wanted = multiply(np.broadcast_to(frame, (24, 4)), np.broadcast_to(turned, (24, 4)))
    assert mark.rotations == pytest.approx(wanted)
    wrist = given.scene.cast.index[HUMANOID, outcome.token("left_wrist")]
    assert mark.translations == pytest.approx(positions[:, wrist])


@pytest.mark.parametrize(("kind", "fields"), [(AimConstraint, {}), (DistanceConstraint, {})])
def test_what_is_aimed_at_or_kept_away_from_is_where_it_is(outcome, kind, fields):
    lamp = np.array((0.5, 1.5, 2.0))
    more = {"distance": 0.4, "bound": "atLeast"} if kind is DistanceConstraint else {}
    asked = ask(outcome, kind, goals=(Goal(path="Lamp", translation=lamp),), **more)
    (mark,) = edit_of(outcome([asked], turns=BENT)).goals
    assert mark.translations == pytest.approx(np.broadcast_to(lamp, (24, 3)))


def test_a_distance_is_between_the_points_of_its_joints(outcome):
    other, point = outcome.token("right_wrist"), np.array((0.0, 0.1, 0.0))
    asked = ask(outcome, DistanceConstraint, other_joint=other, other_point=point, distance=0.3)
    given = outcome([asked], lift=0.2, turns=BENT)
    (link,) = edit_of(given).links
    found = findings_of(given)
    for ends, (positions, orientations) in zip(
        (link.before, link.after), (found.before, found.after), strict=True
    ):
        for end, token, beside in zip(
            (0, 1), (asked.joint, other), (np.zeros(3), point), strict=True
        ):
            node = given.scene.cast.index[HUMANOID, token]
            wanted = world_points(positions[:, node], orientations[:, node], beside)
            assert ends[:, end] == pytest.approx(wanted)
    drawn = [
        m for m in marks(shown(given), 5, after=True) if isinstance(m, Curve) and m.color == GOAL
    ]
    assert [np.array_equal(each.points, link.after[5]) for each in drawn] == [True]


def test_the_centre_of_mass_is_shown_over_what_a_constraint_names(outcome):
    ankles = tuple(outcome.token(f"{side}_ankle") for side in ("left", "right"))
    balance = CenterOfMassConstraint(
        path=f"{HUMANOID}/Edit/Balance", skeleton=HUMANOID, supports=ankles
    )
    held = ask(outcome, ContactConstraint, "left_ankle", "Held", times=(0.0, 0.0, 0.5, 0.5))
    given = outcome([balance, held], turns=BENT)
    found = edit_of(given).balance
    assert found.path == balance.path and found.supports.shape == (24, 2, 3)
    on = held.plateau(given.scene.cast)
    assert np.array_equal(found.bearing[:, 0][on], on[on])
    assert found.bearing.any(axis=1).all()
    assert found.after == pytest.approx(findings_of(given).edits[0].balance.after)


def test_what_nobody_solved_has_no_result(outcome):
    scene = outcome([ask(outcome, goals=(offset(),))]).scene
    found = shown_before(scene)
    (edit,), (actor,) = found.edits, found.actors
    (course,), (goal,) = edit.courses, edit.goals
    assert not edit.solved and edit.misses == ()
    assert course.after is None and actor.after is None and edit.balance.after is None
    assert goal.translations == pytest.approx(course.before + OFFSET)


def test_actors_are_where_the_motions_have_them(outcome):
    given = outcome(turns=BENT, lift=0.2)
    (actor,) = shown(given).actors
    assert np.array_equal(actor.before[0], given.scene.cast.positions[:, 1:])
    assert actor.after[0][:, 0] == pytest.approx(actor.before[0][:, 0] + (0.0, 0.2, 0.0))

"""Contacts hold a frame, a line or a point, or let it slide along a plane or a line."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import ContactConstraint, Goal, PositionConstraint, Space
from usdmotion.detecting import KINDS
from usdmotion.errors import SceneError
from usdmotion.kernels import (
    conjugate,
    from_vector,
    multiply,
    residuals,
    rotate,
    to_vector,
    world_points,
)
from usdmotion.measuring import measure
from usdmotion.plugins import host
from usdmotion.solving import Problem
from usdmotion.testing import humanoid_scene

SCENE = humanoid_scene()
PATH = SCENE.characters[0].path
CAST = SCENE.cast
FOOT = next(token for path, token in CAST.joints if token.endswith("left_ankle"))
NODE = CAST.index[(PATH, FOOT)]
WHERE = CAST.positions[0, NODE] + (0.0, 0.03, 0.05)
TURN = multiply(CAST.orientations[0, NODE], from_vector(np.array([0.1, 0.2, 0.0])))


CHEST = next(token for path, token in CAST.joints if token.endswith("chest"))
AXIS = np.array([0.3, 0.8, -0.2]) / np.linalg.norm([0.3, 0.8, -0.2])


def contact(kind, **fields):
    given = {"location": WHERE, "orientation": TURN, "axis": np.array([1.0, 0.0, 0.0])} | fields
    return ContactConstraint(path="/Contact", skeleton=PATH, joint=FOOT, kind=kind, **given)


def solved(*constraints):
    scene = humanoid_scene(constraints)
    problem = Problem.of(scene)
    solution = host().solver("prioritized_ik")().solve(problem)
    cast = replace(problem.cast, translations=solution.translations, rotations=solution.rotations)
    return cast, measure(problem, solution, scene.constraints)


def held(kind, **fields):
    cast, left = solved(contact(kind, **fields))
    return cast.positions[:, NODE], cast.orientations[:, NODE], left


def left_of(constraint):
    """Return what is left of a contact in the motion as it is [m], shape (frame_count,)."""
    table = Problem.of(humanoid_scene([constraint])).table
    return residuals(table, CAST.positions, CAST.orientations)[:, 0]


def reaching(place):
    """Return a constraint of a lower rank that wants the foot at a place."""
    goals = (Goal(translation=place),)
    return PositionConstraint(path="/Reach", skeleton=PATH, joint=FOOT, priority=2, goals=goals)


def angle(turns):
    return np.linalg.norm(to_vector(turns), axis=-1).max()


def test_a_space_contact_holds_the_whole_frame():
    positions, turns, left = held("space")
    assert np.abs(positions - WHERE).max() < 1e-6
    assert angle(multiply(turns, TURN * (-1, -1, -1, 1))) < 1e-6
    assert left.max() < 1e-6


def test_a_line_contact_holds_all_but_the_turn_about_its_axis():
    positions, turns, _ = held("line")
    axis = np.array([1.0, 0.0, 0.0])
    within = rotate(TURN * (-1, -1, -1, 1), axis)
    assert np.abs(positions - WHERE).max() < 1e-6
    assert np.abs(rotate(turns, within) - axis).max() < 1e-5


def test_a_point_contact_holds_the_point_alone():
    positions, turns, _ = held("point")
    assert np.abs(positions - WHERE).max() < 1e-6
    assert angle(multiply(turns, TURN * (-1, -1, -1, 1))) > 0.01


def test_a_contact_in_a_space_is_held_there():
    space = Space(translation=np.array([0.1, 0.0, -0.2]))
    positions, _, _ = held("point", space=space)
    assert np.abs(positions - WHERE - space.translation).max() < 1e-6


def test_a_point_that_is_held_on_a_plane_or_a_line_is_on_it_and_goes_where_it_wants_there():
    aside = np.cross(AXIS, (0.0, 0.0, 1.0))
    wanted = {"plane": WHERE + 0.05 * aside, "slide": WHERE + 0.05 * AXIS}
    for kind, there in wanted.items():
        cast, left = solved(contact(kind, axis=AXIS), reaching(there))
        assert left.max() < 1e-5, kind
        assert np.abs(cast.positions[:, NODE] - there).max() < 1e-5


@pytest.mark.parametrize("kind", ["plane", "slide"])
def test_what_leaves_a_plane_or_a_line_is_kept_from_it_and_the_rest_is_given(kind):
    off = np.array([0.03, 0.05, 0.04])
    positions = solved(contact(kind, axis=AXIS), reaching(WHERE + off))[0].positions[:, NODE]
    along = (off @ AXIS) * AXIS
    given = along if kind == "slide" else off - along
    assert np.abs(positions - WHERE - given).max() < 1e-5


@pytest.mark.parametrize(
    ("kind", "distance"),
    [
        ("plane", lambda away: np.abs(away @ AXIS)),
        ("slide", lambda away: np.linalg.norm(np.cross(away, AXIS), axis=1)),
        ("point", lambda away: np.linalg.norm(away, axis=1)),
    ],
)
def test_what_is_left_is_the_distance_whatever_the_axis_is_called_and_the_place_on_it(
    kind, distance
):
    aside = np.cross(AXIS, (1.0, 0.0, 0.0))
    wanted = distance(CAST.positions[:, NODE] - WHERE)
    same = {"plane": aside, "slide": AXIS, "point": np.zeros(3)}[kind]
    for scale in (1.0, 7.0, -2.0):
        found = left_of(contact(kind, axis=scale * AXIS, location=WHERE + scale * same))
        np.testing.assert_allclose(found, wanted, atol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_a_contact_given_in_a_turned_space_is_the_same_contact(kind):
    space = Space(np.array([0.4, -0.1, 2.0]), from_vector(np.array([0.3, -0.8, 0.5])))
    back = conjugate(space.rotation)
    inside = contact(
        kind,
        space=space,
        location=rotate(back, WHERE - space.translation),
        orientation=multiply(back, TURN),
        axis=rotate(back, AXIS),
    )
    np.testing.assert_allclose(left_of(inside), left_of(contact(kind, axis=AXIS)), atol=1e-9)
    _, left = solved(inside)
    assert left.max() < 1e-5
    assert left_of(inside).max() > 0.01


@pytest.mark.parametrize("kind", KINDS)
def test_in_the_frame_of_a_joint_it_goes_along_with_the_joint(kind):
    node = CAST.index[(PATH, CHEST)]
    at, turn = CAST.positions[0, node], conjugate(CAST.orientations[0, node])
    inside = contact(
        kind,
        space=Space(joint=(PATH, CHEST)),
        location=rotate(turn, WHERE - at),
        orientation=multiply(turn, TURN),
        axis=rotate(turn, AXIS),
    )
    cast, left = solved(inside)
    assert left.max() < 1e-5
    place = world_points(cast.positions[:, node], cast.orientations[:, node], inside.location)
    away = cast.positions[:, NODE] - place
    axis = rotate(cast.orientations[:, node], np.broadcast_to(inside.axis, away.shape))
    apart = {
        "plane": np.sum(away * axis, axis=1),
        "slide": np.linalg.norm(np.cross(away, axis), axis=1),
    }
    assert np.abs(apart.get(kind, away)).max() < 1e-5


@pytest.mark.parametrize("kind", KINDS)
def test_what_moves_its_space_counts_as_moving_it(kind):
    inside = contact(kind, space=Space(joint=(PATH, CHEST)), recruits=(FOOT,))
    moving = set(CAST.ancestors(CAST.index[PATH, CHEST])) | set(CAST.ancestors(NODE))
    assert inside.demand(CAST).moves == moving


def test_every_kind_that_can_be_detected_can_be_enforced():
    for kind in KINDS:
        assert held(kind)[2].max() < 1e-5


def test_another_kind_is_refused_with_those_there_are():
    with pytest.raises(SceneError, match="use space, line, point, plane or slide"):
        held("sphere")


@pytest.mark.parametrize("kind", ["line", "plane", "slide"])
def test_a_kind_with_an_axis_is_refused_without_one(kind):
    with pytest.raises(SceneError, match="has an axis of zero; give usdmotion:axis a direction"):
        held(kind, axis=np.zeros(3))

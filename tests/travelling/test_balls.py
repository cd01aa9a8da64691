"""On a body whose balls of feet are no joints they are held where they would be if they were."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.constraints import ContactConstraint, Space
from usdmotion.demos.people import person
from usdmotion.humanoid import PartMap
from usdmotion.s4d import Morphology
from usdmotion.travelling import (
    Meanings,
    Traveller,
    Way,
    carried,
    with_own_feet,
    with_points_for_balls,
)

UP, AWAY, THERE = np.array([0.0, 1.0, 0.0]), "/Walk", "/Body/Skeleton"
BALL, ANKLE = "l_metatarsophalangeal", "l_talocrural"
TIMES = np.linspace(0.0, 2.0, 49)
# As feet are turned while they stand: about the up axis, and the ankle a little more.
TURNED = Rotation.from_euler("yx", [40, 10], degrees=True).as_quat()


@pytest.fixture(scope="module", params=[None, 5], ids=["plain axes", "other axes"])
def bodies(request):
    """Return a body, and the same one without balls of its feet."""
    somebody = person(height=1.5, axes=request.param)
    parts = tuple("" if part.endswith(BALL[2:]) else part for part in somebody.parts)
    return tuple(
        Morphology.of(somebody.skeleton, PartMap(each)) for each in (somebody.parts, parts)
    )


def held(joint, **changes):
    given = {
        "path": "",
        "skeleton": AWAY,
        "joint": joint,
        "times": (0.2, 0.3, 1.0, 1.2),
        "location": np.array([0.3, 0.0, 1.1]),
        "orientation": TURNED,
    }
    return Traveller(f"{joint}/Contact", ContactConstraint(**given | changes))


def on(body, *travellers):
    """Return constraints without a body as they are on one."""
    meanings = Meanings.of(THERE, body, UP)
    ways = {AWAY: Way(meanings, True, THERE, meanings.parts)}
    there = tuple(carried(each, ways) for each in with_points_for_balls(travellers, body))
    return [each.constraint for each in with_own_feet(there, meanings, body, TIMES)]


@pytest.mark.parametrize("kind", ["space", "point", "slide"])
def test_the_ball_is_held_where_it_would_be_as_a_point_of_its_ankle(bodies, kind):
    whole, without = bodies
    (ball,), (point,) = (on(body, held(BALL, kind=kind)) for body in bodies)
    assert point.joint == without.skeleton.joints[without.joint(ANKLE)]
    assert point.kind == ("slide" if kind == "slide" else "point")
    np.testing.assert_allclose(point.location, ball.location, atol=1e-3)
    rest, ankle, toe = whole.rest_positions, whole.joint(ANKLE), whole.joint(BALL)
    away = np.linalg.norm(rest[toe] - rest[ankle])
    assert np.linalg.norm(point.point) == pytest.approx(away, abs=2e-3)
    assert point.times == ball.times


def test_an_ankle_stands_a_foot_away_from_the_ball_that_is_held_with_it(bodies):
    ankle = held(ANKLE, location=np.array([0.3, 0.0, 0.8]))
    (_, one), (_, other) = (on(body, held(BALL), ankle) for body in bodies)
    assert one.kind == other.kind == "space"
    np.testing.assert_allclose(other.location, one.location, atol=2e-3)


def test_a_ball_in_the_frame_of_a_joint_keeps_its_place_there(bodies):
    whole, without = bodies
    space = Space(joint=(AWAY, "humanoid_root"))
    one, other = (on(body, held(BALL, space=space))[0] for body in (whole, without))
    np.testing.assert_allclose(other.location, one.location, atol=1e-9)


def test_what_holds_anything_else_and_bodies_with_balls_are_left_alone(bodies):
    whole, without = bodies
    ball, ankle = held(BALL), held(ANKLE)
    assert with_points_for_balls([ball, ankle], whole) == (ball, ankle)
    assert with_points_for_balls([ankle], without) == (ankle,)
    moving = replace(ball, constraint=replace(ball.constraint, point=np.zeros((49, 3))))
    assert with_points_for_balls([moving], without) == (moving,)

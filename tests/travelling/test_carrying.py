"""There and back is what it was; on another body it means the same."""

from dataclasses import dataclass, fields, replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from usdmotion.constraints import (
    AimConstraint,
    CenterOfMassConstraint,
    Constraint,
    ContactConstraint,
    DistanceConstraint,
    Goal,
    OrientationConstraint,
    PositionConstraint,
    Space,
    TrajectoryConstraint,
    attribute,
)
from usdmotion.travelling import Meanings, StaysBehind, Traveller, Way, carried

HERE, AWAY = "/World/Walker/Skeleton", "/Walk"
Z_UP = Rotation.from_euler("x", -90, degrees=True).as_quat()
PARTS = ("humanoid_root", "vl5", "vt6", "skullbase", "l_talocrural", "r_radiocarpal", "")
JOINTS = ("Hips", "Hips/Spine", "Hips/Spine/Chest", "Head", "Hips/Foot", "Hips/Hand", "Hips/Tail")


def body(leg=0.9, standing=0.1, seed=1, path=HERE, **changes):
    given = {
        "path": path,
        "joints": JOINTS,
        "parts": PARTS,
        "frames": Rotation.random(len(JOINTS), random_state=seed).as_quat(),
        "leg": leg,
        "standing": {"l_talocrural": standing},
    }
    return Meanings(**given | changes)


def out(traveller, meanings=None, there=AWAY):
    meanings = meanings or body()
    return carried(traveller, {meanings.path: Way(meanings, False, there)})


def onto(traveller, meanings, known=PARTS, at=AWAY):
    return carried(traveller, {at: Way(meanings, True, meanings.path, known)})


def turns(seed):
    return Rotation.random(random_state=seed).as_quat()


PLACED = Goal(path="A", translation=np.array([1.0, 2.0, 3.0]), rotation=turns(5))
MOVED = Goal(path="B", mode="offset", translation=np.array([0.1, 0.2, 0.3]), rotation=turns(6))
WITH_HEAD = Goal(path="C", translation=np.ones(3), rotation=turns(7), joint=(HERE, "Head"))


@dataclass(frozen=True, eq=False, kw_only=True)
class StrangersConstraint(Constraint):
    """A kind of a third party."""

    schema = "MotionStrangersConstraint"
    ends: tuple[str, ...] = attribute(())
    reach: float = attribute(0.0, unit="length")
    points: tuple[float, ...] = attribute((), unit="length")


def a(kind, **fields):
    return kind(path="", skeleton=HERE, **{"joint": "Hips/Hand", "point": np.ones(3), **fields})


KINDS = [
    a(PositionConstraint, goals=(PLACED, MOVED), recruits=("Hips/Hand", "Hips/Tail")),
    a(PositionConstraint, goals=(PLACED,), axes="y", point=np.ones((4, 3))),
    a(OrientationConstraint, goals=(WITH_HEAD,), rotation=turns(8), free_axis=np.array([1, 0, 0])),
    a(AimConstraint, goals=(WITH_HEAD, PLACED), aim=np.array([0.0, 1.0, 0.0])),
    a(DistanceConstraint, other_joint="Head", other_point=np.ones(3), distance=np.arange(4.0)),
    a(
        CenterOfMassConstraint,
        joint="",
        point=np.zeros(3),
        supports=("Hips/Foot", "Hips/Hand"),
        support_points=np.arange(6.0).reshape(2, 3),
        displacement=np.array([0.1, 0.0, 0.2]),
    ),
    a(
        TrajectoryConstraint,
        joint="Hips/Foot",
        keys=(1.0, 2.0),
        points=np.arange(6.0).reshape(2, 3),
        space=Space(joint=(HERE, "Head")),
    ),
    a(
        ContactConstraint,
        joint="Hips/Foot",
        location=np.array([1.0, 0.1, 2.0]),
        orientation=turns(9),
        axis=np.array([0.0, 1.0, 0.0]),
        residual=0.01,
    ),
    a(StrangersConstraint, ends=("Head", "Hips/Foot"), reach=2.0, points=(1.0, 2.0)),
]


def assert_same(one, other):
    for field in fields(one):
        found, wanted = getattr(one, field.name), getattr(other, field.name)
        if field.name in ("goals", "space"):
            pairs = zip(found, wanted, strict=True) if field.name == "goals" else [(found, wanted)]
            for each, same in pairs:
                assert_same(each, same)
        elif isinstance(wanted, str | tuple) and not isinstance(wanted[:1], tuple):
            assert found == wanted
        elif wanted is None or isinstance(wanted, tuple):
            assert found == wanted
        else:
            np.testing.assert_allclose(found, wanted, atol=1e-12, err_msg=field.name)


@pytest.mark.parametrize("constraint", KINDS, ids=lambda each: type(each).__name__)
@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0, 1.0), Z_UP], ids="YZ")
def test_there_and_back_is_what_it_was(constraint, turn):
    meanings = body(turn=np.array(turn))
    away = out(Traveller("Any", constraint), meanings)
    assert away.constraint.skeleton == AWAY
    assert_same(onto(away, meanings).constraint, constraint)


@pytest.mark.parametrize("constraint", KINDS, ids=lambda each: type(each).__name__)
def test_nothing_of_it_depends_on_the_size_of_the_body(constraint):
    def grown(value):
        if isinstance(value, Goal) or hasattr(value, "schema"):
            names = [each.name for each in fields(value)]
            given = {name: larger(value, name) for name in names}
            return replace(value, **given)
        return value

    def larger(value, name):
        held = getattr(value, name)
        if name == "goals":
            return tuple(grown(goal) for goal in held)
        lengths = ("point", "translation", "other_point", "distance", "support_points", "reach")
        places = ("displacement", "points", "location", "residual")
        if isinstance(held, tuple) and name in (*lengths, *places):
            return tuple(2.0 * each for each in held)
        return held * 2.0 if name in (*lengths, *places) else held

    small, large = body(leg=0.5, standing=0.1), body(leg=1.0, standing=0.2)
    assert_same(
        out(Traveller("Any", grown(constraint)), large).constraint,
        out(Traveller("Any", constraint), small).constraint,
    )


def test_joints_are_called_by_their_part_and_others_keep_their_token():
    away = out(Traveller("Any", KINDS[0])).constraint
    assert away.joint == "r_radiocarpal"
    assert away.recruits == ("r_radiocarpal", "Hips/Tail")


def test_a_foot_that_stands_on_the_ground_stands_on_it_on_another_body():
    low, high = body(leg=0.9, standing=0.08), body(leg=0.6, standing=0.11, seed=2)
    held = a(ContactConstraint, joint="Hips/Foot", location=np.array([0.9, 0.08, 1.8]))
    found = onto(out(Traveller("Any", held), low), high).constraint
    np.testing.assert_allclose(found.location, [0.6, 0.11, 1.2])


def test_a_hand_at_a_height_is_at_as_many_legs():
    small = body(leg=0.45)
    held = a(ContactConstraint, joint="Hips/Hand", location=np.array([0.0, 1.8, 0.0]))
    assert onto(out(Traveller("Any", held)), small).constraint.location[1] == pytest.approx(0.9)


def test_a_part_is_turned_in_the_world_as_it_was_whatever_the_axes_of_its_joint():
    one, other = body(seed=1), body(seed=2)
    held = a(ContactConstraint, joint="Hips/Foot", orientation=turns(9))
    found = onto(out(Traveller("Any", held), one), other).constraint

    def part(meanings, orientation):
        return Rotation.from_quat(orientation) * Rotation.from_quat(meanings.frames[4])

    apart = part(one, held.orientation).inv() * part(other, found.orientation)
    assert apart.magnitude() == pytest.approx(0.0, abs=1e-12)


def test_heights_are_held_along_the_up_axis_of_either_world():
    held = a(PositionConstraint, axes="z", goals=(PLACED,))
    away = out(Traveller("Any", held), body(turn=Z_UP)).constraint
    assert away.axes == "y"
    assert away.goals[0].translation[1] * 0.9 == pytest.approx(3.0)


def test_what_is_given_in_a_prop_stays_in_metres():
    held = a(ContactConstraint, joint="Hips/Foot", location=np.ones(3))
    away = out(Traveller("Any", held, {"": "/World/Box"})).constraint
    np.testing.assert_array_equal(away.location, np.ones(3))
    placed = a(PositionConstraint, goals=(PLACED,), axes="x")
    assert out(Traveller("Any", placed, {"A": "/World/Box"})).constraint.goals == (PLACED,)


def test_axes_of_a_prop_and_of_the_world_stay_behind_where_the_up_axis_changes():
    both = a(PositionConstraint, goals=(PLACED, replace(PLACED, path="B")), axes="xy")
    with_prop = Traveller("Any", both, {"A": "/World/Box"})
    assert out(with_prop).constraint.axes == "xy"
    with pytest.raises(StaysBehind, match="axes 'xy' of a prop and of the world"):
        out(with_prop, body(turn=Z_UP))
    assert out(Traveller("Any", both), body(turn=Z_UP)).constraint.axes == "xz"


def test_recruited_vertebrae_go_with_the_nearest_that_were_there():
    spine = ("humanoid_root", "vl5", "vl3", "vt12", "vt6", "skullbase", "l_talocrural")
    other = body(parts=spine, joints=tuple("abcdefg"), frames=np.tile((0, 0, 0, 1.0), (7, 1)))
    asked = a(PositionConstraint, joint="Head", recruits=("Hips/Spine", "Hips/Foot"))
    away = out(Traveller("Any", asked))
    assert onto(away, other).constraint.recruits == ("b", "c", "d", "g")


def test_an_effector_on_a_vertebra_that_is_not_there_is_on_the_nearest():
    other = body(parts=("humanoid_root", "vl5", "vt10", "", "", "", ""), joints=tuple("abcdefg"))
    asked = a(PositionConstraint, joint="Hips/Spine/Chest")
    assert onto(out(Traveller("Any", asked)), other).constraint.joint == "c"


def test_supports_that_are_not_there_leave_with_their_points():
    other = body(parts=(*PARTS[:4], "", *PARTS[5:]), joints=tuple("abcdefg"))
    found = onto(out(Traveller("Any", KINDS[5])), other).constraint
    assert found.supports == ("f",)
    assert len(found.support_points) == 1


@pytest.mark.parametrize(
    ("constraint", "why"),
    [
        (a(PositionConstraint, joint="Hips/Tail"), "no joint 'Hips/Tail'"),
        (a(PositionConstraint, recruits=("Hips/Tail",)), "may move 'Hips/Tail' alone"),
        (a(PositionConstraint, goals=(replace(WITH_HEAD, joint=("/B", "x")),)), "it is about </B>"),
        (a(PositionConstraint, goals=(WITH_HEAD,), axes="x"), "holds the axes 'x' of a frame"),
    ],
)
def test_what_has_no_place_on_another_body_says_why_it_stays(constraint, why):
    other = body(joints=tuple("abcdefg"))
    with pytest.raises(StaysBehind, match=why):
        onto(out(Traveller("Any", constraint)), other)

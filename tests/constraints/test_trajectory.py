"""The shape constraint: a curve that leaves the input trajectory and rejoins it."""

import numpy as np
import pytest

from usdmotion.constraints import Space, TrajectoryConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import rotate
from usdmotion.testing import arm_scene

SCENE = arm_scene(frame_count=49)
CAST = SCENE.cast
PATH = SCENE.characters[0].path
WRIST = "base/shoulder/elbow/wrist"
NODE = CAST.index[(PATH, WRIST)]
ORIGINAL = CAST.positions[:, NODE]
TIMES = CAST.times
POINTS = ORIGINAL[[15, 30]] + (0.1, 0.2, 0.3)


def trajectory(**fields):
    defaults = {
        "times": (TIMES[5], TIMES[45]),
        "keys": (TIMES[15], TIMES[30]),
        "points": POINTS,
    }
    return TrajectoryConstraint(path="/It", skeleton=PATH, joint=WRIST, **(defaults | fields))


def asked(constraint):
    (task,) = constraint.tasks(CAST)
    return task.target


def test_it_passes_its_points_at_their_keys():
    assert np.allclose(asked(trajectory())[[15, 30]], POINTS)


def test_outside_its_times_it_is_the_input_and_not_asked_for():
    target, demand = asked(trajectory()), trajectory().demand(CAST)
    away = (TIMES < TIMES[5]) | (TIMES > TIMES[45])
    assert np.array_equal(demand.activity, np.where(away, 0.0, 1.0))
    assert np.allclose(target[away], ORIGINAL[away])


def test_it_leaves_and_rejoins_with_the_velocity_of_the_input():
    target = asked(trajectory())
    speed = np.diff(target, axis=0)
    own = np.diff(ORIGINAL, axis=0)
    assert np.allclose(target[[5, 45]], ORIGINAL[[5, 45]], atol=1e-9)
    assert np.abs(speed[5] - own[4]).max() < 0.02
    assert np.abs(speed[44] - own[45]).max() < 0.02


def test_it_stays_from_a_key_to_its_release():
    target = asked(trajectory(releases=(TIMES[20], TIMES[30])))
    assert np.allclose(target[15:21], POINTS[0])
    assert np.linalg.norm(target[21] - POINTS[0]) < 0.05


def test_points_in_a_turned_space_are_the_same_curve_turned():
    rotation = np.array([0.0, np.sin(0.4), 0.0, np.cos(0.4)])
    space = Space(translation=np.array([1.0, 2.0, 3.0]), rotation=rotation)
    back = rotate(rotation * (-1, -1, -1, 1), POINTS - space.translation)
    assert np.allclose(asked(trajectory(space=space, points=back)), asked(trajectory()))


def test_in_the_frame_of_a_joint_it_moves_with_the_joint():
    space = Space(joint=(PATH, "base/shoulder"))
    (task,) = trajectory(space=space).tasks(CAST)
    effector, frame = task.terms
    assert (effector.node, frame.node) == (NODE, CAST.index[(PATH, "base/shoulder")])
    assert np.allclose(frame.point[[15, 30]], POINTS)
    assert np.all(task.target == 0.0)


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"times": ()}, "does not say when it leaves and rejoins"),
        ({"keys": (1.0,)}, "other counts of keys"),
        ({"bias": (0.5,)}, "other counts of keys"),
        ({"keys": (TIMES[30], TIMES[15])}, "not in order"),
        ({"releases": (TIMES[40], TIMES[30])}, "not in order"),
        ({"keys": (TIMES[2], TIMES[15])}, "not in order"),
    ],
)
def test_what_makes_no_curve_is_refused_in_a_sentence(fields, sentence):
    with pytest.raises(SceneError, match=sentence):
        asked(trajectory(**fields))

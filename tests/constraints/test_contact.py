"""Contacts hold a frame, a line or a point."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.constraints import ContactConstraint, Space
from usdmotion.errors import SceneError
from usdmotion.kernels import from_vector, multiply, rotate, to_vector
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


def held(kind, **fields):
    contact = ContactConstraint(
        path="/Contact",
        skeleton=PATH,
        joint=FOOT,
        kind=kind,
        location=WHERE,
        orientation=TURN,
        axis=np.array([1.0, 0.0, 0.0]),
        **fields,
    )
    scene = humanoid_scene([contact])
    problem = Problem.of(scene)
    solution = host().solver("prioritized_ik")().solve(problem)
    cast = replace(problem.cast, translations=solution.translations, rotations=solution.rotations)
    return (
        cast.positions[:, NODE],
        cast.orientations[:, NODE],
        measure(problem, solution, scene.constraints),
    )


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


def test_another_kind_is_refused_with_those_there_are():
    with pytest.raises(SceneError, match="use space, line or point"):
        held("plane")

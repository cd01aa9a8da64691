"""Skeleton, body and motion: plain values that cannot be wrong in shape."""

import numpy as np
import pytest

from usdmotion.arrays import ShapeError
from usdmotion.errors import SceneError
from usdmotion.motion import Body, Motion, Placement, Skeleton


def skeleton(joints: tuple[str, ...], parents: tuple[int, ...]) -> Skeleton:
    count = len(joints)
    rest = np.tile((0.0, 0.0, 0.0, 1.0), (count, 1))
    return Skeleton(joints, np.array(parents), np.zeros((count, 3)), rest)


def test_a_chain_goes_from_the_joint_up() -> None:
    tree = skeleton(("hip", "knee", "ankle", "spine"), (-1, 0, 1, 0))
    assert tree.chain(2) == (2, 1, 0)
    assert tree.chain(3) == (3, 0)
    assert tree.index["spine"] == 3


def test_a_token_that_stands_twice_is_refused_by_name() -> None:
    with pytest.raises(SceneError, match="joint 'knee' stands twice"):
        skeleton(("hip", "knee", "knee"), (-1, 0, 0))


@pytest.mark.parametrize("parents", [(1, -1), (0, 0), (-2, 0)])
def test_parents_come_first(parents: tuple[int, int]) -> None:
    with pytest.raises(SceneError, match="parents must come first"):
        skeleton(("hip", "knee"), parents)


def test_a_motion_has_one_shape() -> None:
    with pytest.raises(ShapeError, match="translations"):
        Motion(np.zeros(2), np.zeros((2, 4, 3)), np.zeros((2, 5, 4)))
    with pytest.raises(ShapeError, match="rotations"):
        Motion(np.zeros(2), np.zeros((2, 5, 3)), np.zeros((3, 5, 4)))
    assert Motion(np.zeros(2), np.zeros((2, 5, 3)), np.zeros((2, 5, 4))).frame_count == 2


def test_an_unknown_body_weighs_nothing_and_is_free() -> None:
    body = Body.unknown(3)
    assert not body.masses.any()
    assert np.isneginf(body.limits_min).all() and np.isposinf(body.limits_max).all()


def test_the_identity_placement_is_the_world_itself() -> None:
    place = Placement.identity(2)
    assert not place.translations.any()
    np.testing.assert_array_equal(place.rotations, [(0, 0, 0, 1), (0, 0, 0, 1)])

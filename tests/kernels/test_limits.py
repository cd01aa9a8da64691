"""Boxes of rotation vectors: what is inside stays, what is outside comes to the border."""

import numpy as np
import pytest

from usdmotion.kernels import (
    beyond_limits,
    conjugate,
    from_vector,
    limit_boxes,
    multiply,
    to_vector,
    within_limits,
)

RANDOM = np.random.default_rng(0)
REST = from_vector(RANDOM.normal(size=(200, 3)))
BOXES = limit_boxes(-RANDOM.uniform(0, 120, (200, 3)), RANDOM.uniform(0, 120, (200, 3)))


def turned(vectors, rest=REST):
    return multiply(rest, from_vector(vectors))


def test_what_is_inside_is_given_back_as_it_is():
    low, high = BOXES
    vectors = low + (high - low) * RANDOM.uniform(0, 1, (200, 3))
    vectors *= np.minimum(1.0, 3.0 / np.linalg.norm(vectors, axis=1, keepdims=True))
    rotations = turned(vectors)
    assert np.array_equal(within_limits(rotations, REST, *BOXES), rotations)
    assert beyond_limits(rotations, REST, *BOXES).max() == 0.0


def test_what_is_outside_comes_to_the_border_and_stays_there():
    rotations = turned(RANDOM.normal(size=(200, 3)) * 1.5)
    assert (beyond_limits(rotations, REST, *BOXES) > 0.1).sum() > 50
    clamped = within_limits(rotations, REST, *BOXES)
    assert beyond_limits(clamped, REST, *BOXES).max() < 1e-12
    again = within_limits(clamped, REST, *BOXES)
    assert np.abs(again - clamped).max() < 1e-12


def test_one_component_outside_is_told_in_radians():
    low, high = limit_boxes(np.array((-10.0, -10.0, -10.0)), np.array((20.0, 20.0, 20.0)))
    there = from_vector(np.radians((35.0, 5.0, -5.0)))
    identity = np.array((0.0, 0.0, 0.0, 1.0))
    assert np.isclose(np.degrees(beyond_limits(there, identity, low, high)), 15.0)


@pytest.mark.parametrize("angle", [170.0, 179.9, 180.1, 190.0, 199.0])
def test_a_box_may_go_beyond_half_a_turn(angle):
    low, high = limit_boxes(np.array((0.0, -5.0, -5.0)), np.array((200.0, 5.0, 5.0)))
    identity = np.array((0.0, 0.0, 0.0, 1.0))
    there = from_vector(np.radians((angle, 0.0, 0.0)))
    assert beyond_limits(there, identity, low, high) < 1e-12
    farther = from_vector(np.radians((205.0, 0.0, 0.0)))
    back = within_limits(farther, identity, low, high)
    assert np.allclose(to_vector(multiply(conjugate(back), farther)), np.radians((5.0, 0.0, 0.0)))


def test_a_limit_on_one_side_is_no_way_around_on_the_other():
    identity = np.array((0.0, 0.0, 0.0, 1.0))
    box = limit_boxes(np.full(3, -np.inf), np.array((np.inf, np.inf, 20.0)))
    for angle in (20.1, 60.0, 170.0):
        there = from_vector(np.radians((0.0, 0.0, angle)))
        beyond = np.degrees(beyond_limits(there, identity, *box))
        assert np.isclose(beyond, min(angle - 20.0, 180.0 - angle))


def test_what_may_turn_half_around_either_way_is_free():
    anything = from_vector(RANDOM.normal(size=(200, 3)) * 3.0)
    for free in (180.0, 360.0, np.inf):
        boxes = limit_boxes(np.full(3, -free), np.full(3, free))
        assert beyond_limits(anything, REST, *boxes).max() == 0.0

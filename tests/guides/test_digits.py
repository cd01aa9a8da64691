"""Numbers are one stroke a digit, of one height, apart from each other, and all different."""

from itertools import combinations

import numpy as np
import pytest

from usdmotion.guides.digits import strokes


@pytest.mark.parametrize("number", [0, 7, 10, 42, 123])
def test_a_number_has_a_stroke_for_each_digit(number):
    assert len(strokes(number)) == len(str(number))


@pytest.mark.parametrize("digit", range(10))
def test_every_digit_stands_on_the_line_and_is_as_high_as_the_others(digit):
    (stroke,) = strokes(digit)
    assert stroke[:, 1].min() == 0.0
    assert stroke[:, 1].max() == 1.0


def test_digits_do_not_touch_each_other():
    left, right = strokes(48)
    assert left[:, 0].max() < right[:, 0].min()


def test_a_number_stands_on_the_middle_of_its_foot():
    points = np.concatenate(strokes(8888))[:, 0]
    assert abs(points.min() + points.max()) < 0.05


def dense(digit):
    """Return 200 points along a stroke."""
    (stroke,) = strokes(digit)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(stroke, axis=0), axis=1))])
    places = np.linspace(0.0, lengths[-1], 200)
    return np.stack([np.interp(places, lengths, stroke[:, axis]) for axis in (0, 1)], axis=1)


def test_no_two_digits_look_alike():
    for one, other in combinations(range(10), 2):
        apart = np.linalg.norm(dense(one)[:, None] - dense(other), axis=2)
        assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) > 0.15, (one, other)

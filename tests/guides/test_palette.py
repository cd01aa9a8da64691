"""Colours are far apart, and the one that is given next is the one that is used least."""

from itertools import combinations

import numpy as np

from usdmotion.guides import COLORS, MISSED, another

PROTANOPES = np.array([(0.1124, 0.8876, 0.0), (0.1124, 0.8876, 0.0), (0.004, -0.004, 1.0)])
"""Linear light without the cones for long waves (Viénot, Brettel and Mollon 1999)."""
DEUTERANOPES = np.array([(0.2929, 0.7071, 0.0), (0.2929, 0.7071, 0.0), (-0.0223, 0.0223, 1.0)])


def screen(color):
    return np.clip(color, 0.0, 1.0) ** (1.0 / 2.2)


def closest(seen):
    return min(np.linalg.norm(screen(a) - screen(b)) for a, b in combinations(seen, 2))


def test_the_first_colours_are_apart_for_everybody():
    first = [np.array(color) for color in COLORS[:6]]
    assert closest(first) > 0.25
    for eyes in (PROTANOPES, DEUTERANOPES):
        assert closest([eyes @ color for color in first]) > 0.12


def test_none_can_be_taken_for_the_red_of_what_is_missed():
    for eyes, least in ((np.eye(3), 0.45), (PROTANOPES, 0.3), (DEUTERANOPES, 0.2)):
        for color in COLORS:
            assert np.linalg.norm(screen(eyes @ color) - screen(eyes @ MISSED)) > least


def test_each_is_given_once_before_any_is_given_again():
    used = []
    for _ in COLORS:
        used.append(another(used))
    assert sorted(used) == sorted(COLORS)
    assert another(used) == COLORS[0]


def test_one_that_is_read_from_a_stage_counts_as_used():
    assert another([tuple(np.float32(each) for each in COLORS[0])]) == COLORS[1]

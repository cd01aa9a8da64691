"""What was found serves as examples: a foot is held while it stands, and not while it leaves."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion import NoisePattern, Spline

WIDE = NoisePattern(*(Spline(np.zeros(1), np.array([most]), np.zeros(1)) for most in (0.3, 0.03)))
"""A noise pattern so wide that setting down and rolling off pass for rest."""


@pytest.fixture
def loosely(two_stances):
    """Return two stances that nobody shows an example of, looked at with a wide noise pattern."""
    return two_stances(noise=3e-4, templates=(), pattern=WIDE, merge_distance=0.1)


def test_a_round_leaves_out_how_a_foot_sets_off_and_down(detect, loosely):
    once, again = detect(loosely).contacts, detect(loosely, rounds=1).contacts
    assert len(once) == len(again) == 2
    assert once[0].end > 1.03 and once[1].start < 1.37
    assert again[0].end == pytest.approx(1.0, abs=0.03)
    assert again[1].start == pytest.approx(1.4, abs=0.03)
    assert max(each.residual for each in again) < 0.5 * max(each.residual for each in once)


def test_what_rests_is_as_long_after_any_number_of_rounds(detect, two_stances):
    search = two_stances()
    wanted = [(each.start, each.end) for each in detect(search).contacts]
    for rounds in (1, 2, 5):
        found = detect(search, rounds=rounds).contacts
        assert [(each.start, each.end) for each in found] == wanted


def test_where_nothing_is_found_another_round_finds_nothing(detect, two_stances):
    search = two_stances(templates=())
    moving = np.cumsum(np.full_like(search.translations, 1.0), axis=0)
    flying = replace(search, translations=moving, pattern=WIDE)
    assert detect(flying, rounds=3).contacts == ()

"""A slower clock finds what is quick."""

import numpy as np
import pytest
from usdmotion_contacts.pattern import constant

from usdmotion import Floats, Search

RATE = 120.0


def taps(hold: float) -> tuple[Floats, Floats]:
    """Return five taps of a foot, 0.3 s apart, that last for so long, between two rests."""
    times = np.arange(int(RATE * 2.5) + 1) / RATE
    since = np.mod(times - 0.5, 0.3)
    up = 0.05 * np.sin(np.pi * np.clip((since - hold) / (0.3 - hold), 0.0, 1.0))
    return times, np.where((times > 0.5) & (times < 2.0), up, 0.0)


@pytest.fixture
def tapping():
    def make(hold: float, **fields: object) -> Search:
        times, height = taps(hold)
        return Search(**{
            "name": "foot", "times": times, "pattern": constant(1e-4, 1e-4),
            "translations": np.stack([0.0 * height, height, 0.0 * height], axis=1),
            "rotations": np.tile((0.0, 0.0, 0.0, 1.0), (len(times), 1)), **fields,
        })  # fmt: skip

    return make


def test_taps_that_are_taken_for_one_contact_are_told_apart(detect, tapping) -> None:
    search = tapping(0.05)
    assert len(detect(search).contacts) == 1
    found = detect(search, clock=0.5).contacts
    # The foot rests, taps at 0.8, 1.1, 1.4 and 1.7 s, and rests again.
    assert len(found) == 6
    assert [each.start for each in found[1:-1]] == pytest.approx([0.8, 1.1, 1.4, 1.7], abs=0.01)
    assert all(each.end - each.start == pytest.approx(0.05, abs=0.01) for each in found[1:-1])
    assert all(each.start in search.times and each.end in search.times for each in found)


def test_taps_that_are_shorter_than_a_step_are_found(detect, tapping) -> None:
    search = tapping(0.018, gap=0.0)
    assert len(detect(search).contacts) == 2
    assert len(detect(search, clock=0.25).contacts) == 6


def test_the_pattern_keeps_its_times(detect, two_stances) -> None:
    slow = detect(two_stances(noise=3e-4), clock=0.5)
    assert slow.pattern.sigma.times == pytest.approx([0.1, 0.8], abs=0.01)
    assert len(slow.contacts) == 2

"""The best pair of thresholds: no other pair agrees better with the labels."""

from itertools import product

import numpy as np
import pytest
from usdmotion_contacts import best_thresholds
from usdmotion_contacts.height_and_speed import heights_and_speeds, low_and_slow


def f1(said, held):
    return 2.0 * (said & held).sum() / (said.sum() + held.sum())


@pytest.fixture
def noisy(two_stances):
    """Return a step under noise, and labels that no thresholds fit exactly."""
    search = two_stances(noise=0.004, rate=60.0)
    return search, (search.times < 1.02) | (search.times > 1.38)


def test_labels_that_a_pair_of_thresholds_made_are_met_exactly(two_stances):
    search = two_stances()
    labels = low_and_slow(search, 0.04, 0.5)
    best = best_thresholds([search], [labels])
    assert best.f1 == 1.0
    assert np.array_equal(low_and_slow(search, best.height, best.speed), labels)


def test_no_pair_that_frames_have_is_better(noisy):
    search, labels = noisy
    best = best_thresholds([search], [labels])
    heights, speeds = heights_and_speeds(search)
    others = (
        f1(low_and_slow(search, height, speed), labels)
        for height, speed in product(heights[::3], speeds[::3])
    )
    assert best.f1 >= max(others)


def test_what_it_promises_is_what_the_rule_then_does(noisy):
    search, labels = noisy
    best = best_thresholds([search], [labels])
    assert best.f1 == pytest.approx(f1(low_and_slow(search, best.height, best.speed), labels))
    held = np.zeros(len(labels), dtype=bool)
    for each in best.detector.detect(search).contacts:
        held |= (search.times >= each.start) & (search.times <= each.end)
    assert f1(held, labels) == pytest.approx(best.f1)


def test_frames_that_are_not_judged_do_not_count(noisy):
    search, labels = noisy
    judged = search.times < 1.2
    wrong = np.where(judged, labels, ~labels)
    assert best_thresholds([search], [wrong], [judged]) == best_thresholds(
        [search], [labels], [judged]
    )


def test_one_pair_serves_several_searches_better_than_the_best_pair_of_any(two_stances):
    searches = [two_stances(noise=0.002), two_stances(noise=0.01, seed=1)]
    labels = [(each.times < 1.02) | (each.times > 1.38) for each in searches]
    together = best_thresholds(searches, labels)
    alone = [best_thresholds([s], [held]) for s, held in zip(searches, labels, strict=True)]
    assert together.f1 <= max(each.f1 for each in alone)
    for pair in alone:
        said = [low_and_slow(each, pair.height, pair.speed) for each in searches]
        assert together.f1 >= f1(np.concatenate(said), np.concatenate(labels)) - 1e-12


def test_labels_of_nothing_are_refused(two_stances):
    search = two_stances()
    with pytest.raises(ValueError, match="no judged frame is held"):
        best_thresholds([search], [np.zeros(len(search.times), dtype=bool)])

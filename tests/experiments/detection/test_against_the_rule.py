"""2005, section 3, against 2006: the best thresholds of height and speed, and no threshold at all.

The rule is given the truth, and the one pair of thresholds with which it is most right on these
very frames. The contacts are found with no template, or with the longest stance of each limb.
"""

from dataclasses import dataclass
from functools import cache

import pytest
from usdmotion_contacts import best_thresholds

SEEDS = range(2)
NOISE = (0.0, 0.005, 0.01, 0.02)
"""Added to the points that frames are built from, along each axis [m]."""
OUTLIERS = (0.0, 0.02)
CLIPS = {"flat ground": ("force plates",), "parkour": ("parkour, feet", "parkour, hands")}
"""What one pair of thresholds has to serve."""
PARTS = {"its feet": ("parkour, feet",), "its hands": ("parkour, hands",)}
"""The parkour with a pair for each."""


@dataclass(frozen=True)
class F1:
    """Per frame, under one noise."""

    rule: float
    estimated: float
    """Of the contacts that are found with no template."""
    taught: float
    """Of those with one of each limb that ever stands."""


def measure(judged, names, noise, outliers):
    noisy, scores = (
        [each for part in parts for each in part]
        for parts in zip(*(judged(name, noise, outliers) for name in names), strict=True)
    )
    best = best_thresholds(*zip(*((n.search, n.held, n.known) for n in noisy), strict=True))
    first, *rest = scores
    return F1(best.f1, *(sum(more, one).f1 for one, *more in zip(first, *rest, strict=True)))


@pytest.fixture(scope="module")
def judged(limbs, said):
    """Return what adds noise to limbs, and judges the contacts without and with a template."""

    @cache
    def run(name, noise, outliers):
        seeds = SEEDS if noise or outliers else SEEDS[:1]
        noisy = [limb.noisy(noise, outliers, seed=seed) for seed in seeds for limb in limbs[name]]
        scores = [
            [each.judge(said(each, templates=shown)) for shown in ((), each.longest)]
            for each in noisy
        ]
        return noisy, scores

    return run


@pytest.fixture(scope="module")
def table(judged, tell):
    """Return the figures by clips, noise and outliers."""
    found = {}
    for clips, names in (CLIPS | PARTS).items():
        for noise in NOISE:
            for outliers in OUTLIERS:
                f1 = measure(judged, names, noise, outliers)
                found[clips, noise, outliers] = f1
                tell(
                    f"F1 on {clips}, {noise * 1e3:2.0f} mm, {outliers:.0%} outliers: rule "
                    f"{f1.rule:.3f}, contacts {f1.estimated:.3f}, with templates {f1.taught:.3f}"
                )
    return found


@pytest.mark.parametrize("noise", NOISE)
def test_on_flat_ground_contacts_are_as_right_as_the_best_thresholds(table, noise):
    f1 = table["flat ground", noise, 0.0]
    assert f1.estimated >= f1.rule - 0.02


@pytest.mark.parametrize("noise", NOISE)
def test_where_the_ground_is_not_flat_they_are_more_right(table, noise):
    f1 = table["parkour", noise, 0.0]
    assert f1.estimated > f1.rule


@pytest.mark.parametrize("noise", NOISE)
@pytest.mark.parametrize("clips", CLIPS)
def test_with_outliers_they_are_more_right_everywhere(table, clips, noise):
    f1 = table[clips, noise, 0.02]
    assert f1.estimated > f1.rule


@pytest.mark.parametrize("noise", NOISE)
@pytest.mark.parametrize("outliers", OUTLIERS)
def test_hands_are_more_right_even_if_the_rule_has_a_pair_for_hands(table, noise, outliers):
    f1 = table["its hands", noise, outliers]
    assert f1.estimated > f1.rule


@pytest.mark.parametrize("noise", NOISE)
@pytest.mark.parametrize("outliers", OUTLIERS)
def test_feet_are_nearly_as_right_as_with_a_pair_for_feet(table, noise, outliers):
    """Those stand on one floor, and height tells so at 25 Hz when noise has drowned all speed."""
    f1 = table["its feet", noise, outliers]
    assert f1.estimated >= f1.rule - 0.05


@pytest.mark.parametrize("clips", CLIPS)
def test_outliers_hardly_matter_to_them(table, clips):
    for noise in NOISE:
        with_them, without = table[clips, noise, 0.02], table[clips, noise, 0.0]
        assert with_them.estimated >= without.estimated - 0.01
        assert with_them.taught >= without.taught - 0.01


@pytest.mark.parametrize("outliers", OUTLIERS)
@pytest.mark.parametrize("clips", CLIPS)
def test_a_template_of_noisy_motion_is_as_good_as_the_best_thresholds(table, clips, outliers):
    for noise in NOISE[1:]:
        f1 = table[clips, noise, outliers]
        assert f1.taught >= f1.rule - 0.02


@pytest.mark.parametrize("outliers", OUTLIERS)
@pytest.mark.parametrize("clips", CLIPS)
def test_a_template_of_a_clean_stance_misses_where_it_begins_and_ends(table, clips, outliers):
    """Setting down and rolling off are a few of its steps, and outliers of the flat ones."""
    f1 = table[clips, 0.0, outliers]
    assert f1.rule - 0.05 <= f1.taught < f1.estimated

"""The noise pattern: two knots a template, and who has a say in it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.noise import NUMERICAL_SIGMA
from usdmotion_contacts.pattern import constant
from usdmotion_contacts.projection import project

from usdmotion import Detected, Search, Template


def louder(two_stances) -> Search:
    """Return two rests of which the second is three times as noisy as the first."""
    search, random = two_stances(noise=2e-4), np.random.default_rng(5)
    late = (search.times >= 1.4)[:, None]
    more = random.normal(scale=6e-4, size=search.translations.shape) * late
    return replace(search, translations=search.translations + more)


def unlabelled(found: Detected, search: Search) -> int:
    """Return how many frames of the second rest are in no contact."""
    held = np.zeros(len(search.times), dtype=bool)
    for each in found.contacts:
        held |= (search.times >= each.start) & (search.times <= each.end)
    return int(np.count_nonzero(~held & (search.times >= 1.4)))


def test_a_template_has_two_knots_at_its_ends(detect, two_stances) -> None:
    pattern = detect(two_stances(noise=3e-4)).pattern
    for spline in (pattern.sigma, pattern.epsilon):
        assert spline.times == pytest.approx([0.1, 0.8], abs=1e-6)
        assert spline.values[0] == spline.values[1] > 0.0


def test_a_second_template_refines_the_pattern_where_it_stands(detect, two_stances) -> None:
    search = replace(louder(two_stances), gap=0.0)
    early, late = search.templates[0], Template("space", 1.6, 2.3)
    once = detect(search)
    twice = detect(replace(search, templates=(early, late)))
    assert unlabelled(twice, search) < 0.3 * unlabelled(once, search)
    at = twice.pattern.epsilon.at(np.array([0.5, 2.0]))
    assert at[0] == once.pattern.epsilon.values[0]
    assert at[1] > 2.0 * at[0]


def test_the_order_of_templates_does_not_matter(detect, two_stances) -> None:
    templates = (Template("space", 0.1, 0.8), Template("space", 1.6, 2.3))
    one, other = (
        detect(replace(louder(two_stances), templates=each))
        for each in (templates, templates[::-1])
    )
    assert np.array_equal(one.pattern.sigma.values, other.pattern.sigma.values)
    assert [each.start for each in one.contacts] == [each.start for each in other.contacts]


def test_a_template_with_wrong_ends_is_corrected(detect, two_stances) -> None:
    """2006, section 9: it also detects wrong labeling from the user."""
    right = detect(two_stances(noise=3e-4, templates=(Template("space", 0.0, 0.9),)))
    wrong = detect(two_stances(noise=3e-4, templates=(Template("space", 0.0, 1.3),)))
    assert [each.end for each in wrong.contacts] == pytest.approx(
        [each.end for each in right.contacts], abs=0.02
    )


def test_templates_come_before_a_pattern_and_that_before_an_estimate(detect, two_stances) -> None:
    pattern = constant(0.01, 0.002)
    search = two_stances(pattern=pattern)
    assert detect(search).pattern.epsilon.values[0] != 0.002
    assert detect(replace(search, templates=())).pattern is pattern
    assert detect(replace(search, templates=(), pattern=None)).pattern is not None


def test_a_line_sets_epsilon_alone_and_keeps_sigma_below_its_turns(detect, held) -> None:
    turns = Rotation.from_rotvec(np.outer(np.linspace(0.0, 2.0, 240), (0.0, 0.0, 1.0)))
    search = held(turns, noise=1e-4, templates=(Template("line", 0.5, 2.0),))
    search = replace(search, pattern=constant(0.5, 1.0))
    found = detect(search)
    least = project(displacements(search)).sigma_3.min()
    assert found.pattern.sigma.at(np.array([0.5, 2.0])).max() < 1.2 * least
    assert found.pattern.epsilon.values.max() < 1e-3
    (line,) = found.contacts
    assert line.kind == "line"


def test_a_still_template_leaves_numerical_noise(detect, two_stances) -> None:
    pattern = detect(two_stances()).pattern
    assert 0.0 < pattern.sigma.values.max() <= 3.0 * NUMERICAL_SIGMA


def test_a_template_that_holds_no_step_is_told_of_and_left_out(detect, two_stances) -> None:
    templates = (Template("space", 0.1, 0.8), Template("space", 7.0, 8.0))
    found = detect(two_stances(templates=templates))
    assert len(found.contacts) == 2
    assert found.left_out == {templates[1]: "it holds no step of 0.02 s"}


def test_the_template_that_is_left_out_is_the_one_that_was_given(detect, two_stances) -> None:
    short = Template("space", 0.5, 0.5)
    for options in ({"clock": 0.3}, {"rounds": 2}, {"clock": 0.3, "rounds": 1}):
        found = detect(two_stances(templates=(Template("space", 0.1, 0.8), short)), **options)
        assert list(found.left_out) == [short]

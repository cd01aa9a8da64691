"""The noise pattern that nobody has shown: what it follows, and what it does not depend on."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.calm import LONGEST_STEP, SHORTEST_STEP, Calm
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.estimate import estimate
from usdmotion_contacts.projection import project

from usdmotion import Search
from usdmotion.demos import dice

RATES = (25.0, 30.0, 60.0, 120.0)


def estimated(search):
    pattern = estimate(search, project(displacements(search)))
    return float(pattern.sigma.values[0]), float(pattern.epsilon.values[0])


def calm(search):
    return Calm.of(search.times, search.translations)


def moved(search, translations, rotations=None):
    turns = search.rotations if rotations is None else rotations
    return replace(search, translations=translations, rotations=turns)


@pytest.fixture
def untaught(two_stances):
    """Return what makes steps without a template, on a step that is the same at all rates."""
    return lambda **fields: two_stances(templates=(), **{"step": 0.04, "length": 0.8} | fields)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("noise", [0.0, 0.005, 0.01, 0.02])
def test_both_stances_are_found_at_any_rate_and_noise(detect, untaught, rate, noise):
    search = untaught(rate=rate, noise=noise, step=0.0)
    held = np.zeros(len(search.times), dtype=bool)
    for each in detect(search).contacts:
        held |= (search.times >= each.start) & (search.times <= each.end)
    truth = (search.times <= 1.05) | (search.times >= 1.35)
    assert (held == truth).mean() > 0.95 - 5.0 * noise


@pytest.mark.parametrize("noise", [0.002, 0.01, 0.02])
def test_noise_is_read_from_a_motion_that_rests_now_and_then(untaught, noise):
    assert calm(untaught(noise=noise)).noise == pytest.approx(noise, rel=0.15)


def test_the_pattern_grows_as_the_noise_does(untaught):
    some = np.array([estimated(untaught(noise=noise)) for noise in (0.004, 0.008, 0.016)])
    assert (np.diff(some, axis=0) > 0.0).all()
    assert some[2] / some[1] == pytest.approx(2.0, rel=0.25)


def test_epsilon_is_a_length_and_sigma_is_none(untaught):
    search = untaught(noise=0.004)
    sigma, epsilon = estimated(search)
    larger = estimated(moved(search, search.translations * 1.5))
    assert larger[0] == pytest.approx(sigma, rel=0.1)
    assert larger[1] == pytest.approx(1.5 * epsilon, rel=1e-2)


def test_nothing_depends_on_place_heading_or_clock(untaught):
    search = untaught(noise=0.004)
    turn = Rotation.from_rotvec([0.4, 2.0, 0.1])
    there = replace(
        search,
        times=search.times + 70.0,
        translations=turn.apply(np.array(search.translations)) + np.array([9000.0, -4.0, 100.0]),
        rotations=(turn * Rotation.from_quat(np.array(search.rotations))).as_quat(),
    )
    # Spikes are looked for along the world's axes, so that a turn changes the last few hundredths.
    assert estimated(there) == pytest.approx(estimated(search), rel=0.05)


def test_a_few_outliers_change_little(untaught):
    search = untaught(noise=0.004)
    places, chance = np.array(search.translations), np.random.default_rng(3)
    away = chance.random(len(places)) < 0.02
    places[away] += chance.normal(size=(away.sum(), 3))
    assert estimated(moved(search, places)) == pytest.approx(estimated(search), rel=0.2)


def test_what_rests_to_the_last_bit_leaves_numerical_noise_only(untaught):
    search = untaught()
    jitter = np.random.default_rng(0).uniform(-1.0, 1.0, search.translations.shape) * 2e-7
    for places in (search.translations, search.translations + jitter):
        sigma, epsilon = estimated(moved(search, places))
        assert sigma <= 1e-4
        assert epsilon <= 1e-4


def test_frozen_frames_at_the_end_are_not_taken_for_the_only_rest(untaught):
    search = untaught(noise=0.002)
    count = len(search.times) // 12
    still = np.repeat(search.translations[-1:], count, axis=0)
    late = search.times[-1] + np.arange(1, count + 1) / 120.0
    longer = replace(
        search,
        times=np.concatenate([search.times, late]),
        translations=np.concatenate([search.translations, still]),
        rotations=np.concatenate([search.rotations, np.repeat(search.rotations[-1:], count, 0)]),
    )
    assert calm(longer).rests[20:100].all()
    assert estimated(longer)[1] == pytest.approx(estimated(search)[1], rel=0.3)


def test_what_never_rests_is_not_held(detect, untaught):
    search = untaught(noise=0.001)
    angle = 4.0 * search.times
    circle = np.stack([np.cos(angle), 0.0 * angle, np.sin(angle)], axis=1)
    assert not calm(moved(search, circle)).rests.any()
    assert not detect(moved(search, circle)).contacts


def test_what_stops_now_and_then_in_the_middle_of_all_speeds_is_held_there(detect, untaught):
    times = np.arange(721) / 120.0
    # As often as fast as slow: the logarithms of its speeds have no two modes.
    speeds = 0.5 * np.exp(1.2 * np.sin(2.0 * np.pi * times / 3.0))
    speeds[(times > 2.0) & (times < 2.5)] = 0.0
    way = np.cumsum(speeds)[:, None] / 120.0 * np.array([[1.0, 0.0, 0.0]])
    still = np.tile([0.0, 0.0, 0.0, 1.0], (len(times), 1))
    search = Search(name="foot", times=times, translations=way, rotations=still)
    (only,) = (each for each in detect(search).contacts if each.end - each.start > 0.2)
    assert only.start == pytest.approx(2.0, abs=0.1)
    assert only.end == pytest.approx(2.5, abs=0.1)


def test_what_always_rests_is_held_throughout(detect, untaught):
    search = untaught()
    chance = np.random.default_rng(5)
    places = chance.normal(0.0, 0.002, search.translations.shape)
    still = np.repeat(search.rotations[:1], len(places), axis=0)
    (only,) = detect(moved(search, places, still)).contacts
    assert only.start == pytest.approx(search.times[0], abs=0.05)
    assert only.end == pytest.approx(search.times[-1], abs=0.05)


def test_a_door_that_always_turns_keeps_its_axis_in_spite_of_noise(untaught):
    search = untaught()
    angle = 1.5 * search.times
    turn = Rotation.from_rotvec(np.outer(angle, (0.0, 1.0, 0.0)))
    noise = np.random.default_rng(7).normal(0.0, 0.001, search.translations.shape)
    door = moved(search, turn.apply([1.0, 0.0, 0.0]) + noise, turn.as_quat())
    sigma, epsilon = estimated(door)
    steps = project(displacements(door))
    assert (steps.sigma_3 > sigma).all()
    assert (steps.epsilon_1 <= epsilon).mean() > 0.8
    assert epsilon < 0.005


@pytest.mark.parametrize("frames", [2, 3, 4])
def test_a_motion_of_hardly_any_frames_has_a_pattern(untaught, frames):
    search = untaught(rate=30.0)
    part = replace(
        search,
        times=search.times[:frames],
        translations=search.translations[:frames],
        rotations=search.rotations[:frames],
    )
    assert all(np.isfinite(estimated(part)))


def test_steps_are_short_without_noise_and_longer_with_it(untaught):
    steps = [calm(untaught(noise=noise)).step(1.0 / 120.0) for noise in (0.0, 0.002, 0.01, 0.04)]
    assert steps[0] == SHORTEST_STEP
    assert steps[-1] == LONGEST_STEP
    assert steps == sorted(steps)
    assert calm(untaught()).step(0.5) == 0.5


def test_an_object_goes_far_beyond_noise_in_a_step_that_is_clear(untaught):
    search = untaught(noise=0.004, step=0.0)
    steps = project(displacements(search))
    moves = steps.displacements
    far = np.quantile(steps.epsilon_3, 0.95)
    rests = moves.calm.rests[moves.first] & moves.calm.rests[moves.last]
    assert far > 4.0 * np.median(steps.epsilon_3[rests])


@pytest.mark.parametrize("die", [dice.first, dice.second])
def test_what_is_known_of_dice_is_found_without_a_pattern(detect, die):
    rolled = die()
    places = rolled.translations.astype(np.float32).astype(np.float64)
    search = Search(
        name="die", times=rolled.times, translations=places, rotations=rolled.rotations,
        kinds=("space", "line", "point"),
    )  # fmt: skip
    assert [each.kind for each in detect(search).contacts] == [
        each.kind for each in rolled.contacts
    ]

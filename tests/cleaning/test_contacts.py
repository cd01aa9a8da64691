"""Rests are found under noise, and what holds them asks for no more than they were."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.cleaning.contacts import at_rest, find_rests, holds, places_of
from usdmotion.cleaning.inputs import low_passed

RATES = [24.0, 60.0, 120.0]


def stepping(rate: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, places of a point that rests in 0..1 and 1.4..2.4 s, and when it does."""
    times = np.arange(round(2.4 * rate) + 1) / rate
    way = np.clip((times - 1.0) / 0.4, 0.0, 1.0)
    ahead = 0.8 * way**2 * (3.0 - 2.0 * way)
    lifted = 0.2 * np.sin(np.pi * way) ** 2
    places = np.stack([np.zeros_like(times), lifted, ahead], axis=1)
    return times, places, (way == 0.0) | (way == 1.0)


@pytest.mark.parametrize("rate", RATES)
def test_a_point_is_at_rest_where_it_stands_and_not_where_it_goes(rate) -> None:
    times, places, stands = stepping(rate)
    found = at_rest(times, places)
    assert not (found & ~stands)[np.abs(times - 1.2) < 0.12].any()
    assert np.count_nonzero(found != stands) / rate < 0.2


@pytest.mark.parametrize("sigma", [0.001, 0.003, 0.006])
def test_noise_changes_little_of_when_that_is(sigma) -> None:
    times, places, _ = stepping(120.0)
    noise = np.random.default_rng(0).normal(0.0, sigma, places.shape)
    changed = at_rest(times, places + noise) != at_rest(times, places)
    assert np.count_nonzero(changed) / 120.0 < 0.1


def test_neither_the_place_nor_the_direction_of_time_matters() -> None:
    times, places, _ = stepping(60.0)
    found = at_rest(times, places)
    assert np.array_equal(at_rest(times, places + np.array([1e4, -1e4, 1e4])), found)
    assert np.array_equal(at_rest(times, places[::-1]), found[::-1])


def test_what_drifts_slowly_is_at_rest_and_what_goes_on_is_not() -> None:
    times = np.arange(121) / 60.0
    for speed, rests in ((0.05, True), (0.2, False)):
        places = speed * times[:, None] * (1.0, 0.0, 0.0)
        assert at_rest(times, places)[20:-20].all() == rests
        assert at_rest(times, places)[20:-20].any() == rests


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_few_frames_are_no_rest(count) -> None:
    assert not at_rest(np.arange(count) / 24.0, np.zeros((count, 3))).any()


def test_ankles_and_balls_of_a_walker_rest_and_balls_rank_higher(walker, as_scene) -> None:
    scene = as_scene(walker)
    (character,) = scene.characters
    rests = find_rests(character)
    leaves = [each.joint.rsplit("/", 1)[-1] for each in rests]
    assert sorted(leaves) == ["LeftFoot", "LeftToeBase", "RightFoot", "RightToeBase"]
    held = holds(rests, character, scene.edits[0])
    ranks = {each.joint.rsplit("/", 1)[-1]: each.priority for each in held}
    assert ranks == {"LeftToeBase": 1, "RightToeBase": 1, "LeftFoot": 2, "RightFoot": 2}
    for each in held:
        assert each.joint in each.recruits and "Hips" not in each.recruits


def test_rests_are_where_the_walker_stands(walker, as_scene) -> None:
    scene = as_scene(walker)
    for rests in find_rests(scene.characters[0]):
        if not rests.joint.endswith("ToeBase"):
            continue
        for stance in walker.stances:
            middle = 0.5 * (stance.start + stance.end)
            if stance.joint == rests.joint and stance.end - stance.start > 0.3:
                assert rests.when[np.searchsorted(rests.times, middle)]


def test_a_body_of_which_nobody_knows_the_feet_has_no_rests(walker, as_scene) -> None:
    assert find_rests(replace(as_scene(walker).characters[0], parts=None)) == ()


def test_goals_are_the_filtered_places_away_from_rests_and_do_not_jump(
    walker, as_scene, noisy
) -> None:
    motion = noisy(walker.motion, 0.3)
    given = as_scene(walker, motion)
    filtered = as_scene(walker, low_passed(motion, 10.0)).characters[0]
    rests = find_rests(given.characters[0])
    for each, held in zip(rests, holds(rests, filtered, given.edits[0]), strict=True):
        goal, free = held.goals[0].translation, places_of(filtered, each.joint)
        frames = np.flatnonzero(each.when)
        far = np.abs(np.arange(len(free))[:, None] - frames).min(axis=1) > 0.1 * 120.0
        assert far.any() and np.array_equal(goal[far], free[far])
        away = np.linalg.norm(np.diff(goal - free, axis=0), axis=1)
        quiet = ~(each.when[1:] & each.when[:-1])
        assert away[quiet].max() < 2e-3
        assert each.slide(goal) < 0.2 * each.slide(each.places)


def test_a_point_that_really_stands_is_asked_to_stand(walker, as_scene) -> None:
    scene = as_scene(walker)
    character, edit = scene.characters[0], scene.edits[0]
    filtered = as_scene(walker, low_passed(walker.motion, 6.0)).characters[0]
    rests = find_rests(character)
    for each, held in zip(rests, holds(rests, filtered, edit), strict=True):
        if each.joint.endswith("ToeBase"):
            assert each.slide(held.goals[0].translation) <= each.slide(each.places) + 1e-6

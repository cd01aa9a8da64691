"""Low and slow: what the rule of 2005 says, and what it does not depend on."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from usdmotion_contacts.height_and_speed import HeightAndSpeed, heights_and_speeds, low_and_slow

from usdmotion import OptionError, configured


def spans(detected):
    return [(each.start, each.end) for each in detected.contacts]


def test_both_stances_of_a_step_are_held_where_the_foot_stands(two_stances):
    first, second = HeightAndSpeed().detect(two_stances(length=0.6)).contacts
    assert first.start == 0.0
    assert first.end == pytest.approx(1.0, abs=0.1)
    assert second.end == pytest.approx(2.4)
    assert first.location == pytest.approx((0.0, 0.0, 0.0), abs=0.01)
    assert second.location == pytest.approx((0.6, 0.0, 0.0), abs=0.01)
    assert max(first.residual, second.residual) < 0.05


def test_what_is_slow_but_high_is_not_held(two_stances):
    search = two_stances()
    raised = np.array(search.translations)
    raised[search.times > 1.2] += search.up * 0.3
    (low,) = HeightAndSpeed().detect(replace(search, translations=raised)).contacts
    assert low.end < 1.2


def test_what_is_low_but_fast_is_not_held(two_stances):
    search = two_stances(length=0.8)
    flat = np.array(search.translations) * (1.0, 0.0, 1.0)
    assert len(HeightAndSpeed().detect(replace(search, translations=flat)).contacts) == 2


def test_a_known_ground_counts_and_not_where_the_object_is_lowest(two_stances):
    search = two_stances()
    assert HeightAndSpeed().detect(replace(search, ground=0.0)).contacts
    found = HeightAndSpeed().detect(replace(search, ground=-1.0))
    assert not found.contacts
    assert not found.notes


def test_a_ground_that_is_not_known_is_told_of(two_stances):
    (note,) = HeightAndSpeed().detect(two_stances()).notes
    assert "ground under foot" in note


def test_nothing_is_learnt_from_examples(two_stances):
    search = two_stances()
    assert set(HeightAndSpeed().detect(search).left_out) == set(search.templates) != set()


def test_a_foot_that_rolls_stands_on_the_end_that_rests():
    times = np.arange(60) / 60.0
    turn = Rotation.from_rotvec(np.outer(times, (0.0, 0.0, 1.5)))
    search = _rolling(times, turn)
    heights, speeds = heights_and_speeds(search)
    assert heights == pytest.approx(0.0, abs=1e-9)
    assert speeds == pytest.approx(0.0, abs=1e-9)
    assert low_and_slow(replace(search, points=np.zeros((1, 3))), 0.02, 0.05).sum() < 10


def _rolling(times, turn):
    """Return a foot whose heel rises about the ball, which is 0.2 m ahead."""
    from usdmotion import Search

    ball = np.array([-0.2, 0.0, 0.0])
    points = np.array([[0.0, 0.0, 0.0], ball])
    return Search(
        name="foot", times=times, translations=ball - turn.apply(ball), rotations=turn.as_quat(),
        points=points, ground=0.0,
    )  # fmt: skip


def test_nothing_depends_on_place_heading_or_clock(two_stances):
    search = two_stances(noise=0.001)
    turn = Rotation.from_rotvec(2.0 * np.asarray(search.up))
    there = replace(
        search,
        times=search.times + 7.0,
        translations=turn.apply(np.array(search.translations)) + np.array([800.0, -40.0, 100.0]),
        rotations=(turn * Rotation.from_quat(np.array(search.rotations))).as_quat(),
    )
    before, after = (spans(HeightAndSpeed().detect(each)) for each in (search, there))
    assert np.array(after) == pytest.approx(np.array(before) + 7.0)


@pytest.mark.parametrize("name", ["height", "speed"])
def test_a_larger_threshold_holds_every_frame_that_a_smaller_one_does(two_stances, name):
    search = two_stances(noise=0.002)
    low = {"height": 9.0, "speed": 9.0, name: 0.05}
    fewer, more = low_and_slow(search, **low), low_and_slow(search, **(low | {name: 0.15}))
    assert (more | ~fewer).all()
    assert more.sum() > fewer.sum()


def test_contacts_that_are_too_short_are_dropped(two_stances):
    search = two_stances()
    assert len(HeightAndSpeed().detect(replace(search, minimum=1.1)).contacts) < 2


def test_its_thresholds_are_options():
    assert configured(HeightAndSpeed, {"height": "0.1", "speed": 1}) == HeightAndSpeed(0.1, 1.0)


def test_what_it_cannot_find_is_refused_in_a_sentence(two_stances):
    with pytest.raises(OptionError, match="'line'; it finds: space"):
        HeightAndSpeed().detect(two_stances(kinds=("space", "line")))


@pytest.mark.parametrize("frames", [1, 2])
def test_a_motion_of_hardly_any_frames_is_held_or_not_without_an_error(two_stances, frames):
    search = two_stances()
    part = replace(
        search,
        times=search.times[:frames],
        translations=search.translations[:frames],
        rotations=search.rotations[:frames],
    )
    assert len(HeightAndSpeed().detect(part).contacts) == 1

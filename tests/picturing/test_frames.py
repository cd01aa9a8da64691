"""Frames are those that are asked for, or those at which it is worth looking."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.asking import Span
from usdmotion.errors import OptionError
from usdmotion.picturing.frames import MOST, asked_for, usual
from usdmotion.showing.telling import Clip, telling

CLIP = Clip(1.0, 97.0, 1.0)
codes = st.lists(st.floats(-20.0, 120.0), max_size=12)


def test_a_list_is_in_order_and_each_once():
    np.testing.assert_array_equal(asked_for((48.0, 1.0, 48.0, 24.5), CLIP), (1.0, 24.5, 48.0))


def test_a_span_with_a_step_ends_where_it_may():
    np.testing.assert_array_equal(asked_for(Span(1.0, 50.0, 20.0), CLIP), (1.0, 21.0, 41.0))


def test_a_span_alone_is_spread_evenly_over_whole_frames():
    found = asked_for(Span(10.0, 40.0), CLIP)
    assert (found[0], found[-1]) == (10.0, 40.0)
    np.testing.assert_array_equal(found, np.round(found))
    assert np.ptp(np.diff(found)) <= 1.0


def test_a_short_span_has_each_frame_once():
    np.testing.assert_array_equal(asked_for(Span(3.0, 5.0), CLIP), (3.0, 4.0, 5.0))
    np.testing.assert_array_equal(asked_for(Span(3.0, 3.0), CLIP), (3.0,))


def test_what_is_outside_of_the_clip_is_refused():
    with pytest.raises(OptionError, match="98, which is outside of the clip; it goes from 1 to 97"):
        asked_for((5.0, 98.0), CLIP)


def test_none_at_all_is_refused():
    with pytest.raises(OptionError, match="names no frame"):
        asked_for((), CLIP)


@given(st.integers(MOST + 1, 97))
def test_who_asks_for_too_many_is_told_what_fits(count):
    with pytest.raises(OptionError, match=f"{count} frames, of which {MOST} fit") as caught:
        asked_for(Span(1.0, float(count), 1.0), CLIP)
    first, last, step = str(caught.value).rsplit(" ", 1)[1].split(":")
    assert len(asked_for(Span(float(first), float(last), float(step)), CLIP)) <= MOST


@pytest.mark.parametrize("step", [1e-9, 1e-300])
def test_too_many_are_counted_before_they_are_made(step):
    with pytest.raises(OptionError):
        asked_for(Span(1.0, 97.0, step), CLIP)


@given(st.lists(codes, max_size=3))
def test_telling_frames_are_few_apart_and_have_both_ends(tiers):
    found = telling(tiers, CLIP)
    assert (found[0], found[-1]) == (CLIP.first, CLIP.last)
    assert len(found) == usual(1)
    assert np.diff(found).min() >= 1.0


def test_what_is_told_first_is_drawn_first():
    found = telling([[50.0], [10.0, 20.0, 30.0, 40.0, 52.0, 60.0, 70.0, 80.0, 90.0]], CLIP)
    assert 50.0 in found
    assert 52.0 not in found


def test_a_clip_of_one_frame_has_one():
    np.testing.assert_array_equal(telling([[4.0]], Clip(4.0, 4.0, 1.0)), (4.0,))


def test_a_crowd_is_drawn_less_often():
    counts = [usual(bodies) for bodies in (1, 3, 4, 8, 50)]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] >= 3

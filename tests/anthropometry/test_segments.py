"""The table, and slices of its segments."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdmotion.anthropometry import segments as table
from usdmotion.anthropometry.segments import Segment

SEGMENTS = (table.LOWER_TRUNK, table.MIDDLE_TRUNK, table.UPPER_TRUNK, *table.LIMBS.values())


def test_the_segments_are_a_whole_body() -> None:
    trunk = sum(segment.mass for segment in SEGMENTS[:3])
    sides = sum(segment.mass for segment in table.LIMBS.values())
    assert trunk == pytest.approx(0.4346, abs=1e-4)
    total = trunk + table.HEAD_MASS + 2 * (sides + table.HAND_MASS + table.FOOT_MASS)
    assert total == pytest.approx(1.0, abs=1e-3)


@given(
    segment=st.sampled_from(SEGMENTS),
    places=st.lists(st.floats(0.0, 1.0), max_size=5).map(sorted),
)
def test_slices_add_up_to_the_segment(segment: Segment, places: list[float]) -> None:
    edges = [0.0, *places, 1.0]
    slices = [segment.cut(*pair) for pair in pairwise(edges)]
    assert sum(mass for mass, _ in slices) == pytest.approx(segment.mass)
    assert sum(moment for _, moment in slices) == pytest.approx(segment.mass * segment.center)
    assert all(mass >= -1e-12 for mass, _ in slices)


@given(segment=st.sampled_from(SEGMENTS), low=st.floats(0.0, 1.0), high=st.floats(0.0, 1.0))
def test_a_slice_has_its_centre_in_itself(segment: Segment, low: float, high: float) -> None:
    mass, moment = segment.cut(min(low, high), max(low, high))
    if mass > 1e-6:
        assert min(low, high) - 1e-6 <= moment / mass <= max(low, high) + 1e-6

"""ftol, by the conditions of the paper's appendix B."""

import math

import pytest
from usdmotion_contacts.tolerance import frame_tolerance

tolerance = frame_tolerance.py_func


@pytest.mark.parametrize("frames", [2, 7, 10, 48, 1000])
@pytest.mark.parametrize("farthest", [0.01, 0.1, 3.0])
def test_it_is_the_most_at_one_place_one_frame_at_the_farthest_and_none_beyond(
    frames: int, farthest: float
) -> None:
    assert tolerance(0.0, frames, farthest) == frames
    assert tolerance(farthest, frames, farthest) == 1
    assert tolerance(farthest * (1.0 + 1e-9), frames, farthest) == 0
    steps = [tolerance(farthest * i / 50.0, frames, farthest) for i in range(51)]
    assert steps == sorted(steps, reverse=True)


def test_it_is_that_of_figure_10() -> None:
    for millimetres in range(101):
        expected = math.floor(10.0 * math.exp(-millimetres * math.log(10.0) / 100.0) + 1e-9)
        assert tolerance(millimetres / 1000.0, 10, 0.1) == expected


@pytest.mark.parametrize("frames", [0, 1])
def test_with_one_frame_or_none_it_is_that_up_to_the_farthest(frames: int) -> None:
    assert tolerance(0.05, frames, 0.1) == frames
    assert tolerance(0.11, frames, 0.1) == 0
    assert tolerance(math.inf, frames, 0.1) == 0


def test_where_nothing_is_bridged_only_one_place_is() -> None:
    assert tolerance(0.0, 10, 0.0) == 10
    assert tolerance(1e-9, 10, 0.0) == 0

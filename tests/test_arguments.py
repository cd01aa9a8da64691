"""Words of a command line as values, or one sentence about what would do."""

import pytest

from usdmotion.arguments import cutoff_of, frames_of, options_of
from usdmotion.errors import OptionError


def test_nothing_said_is_nothing_asked() -> None:
    assert (options_of(None), frames_of(None), cutoff_of(None)) == ({}, None, None)


def test_options_are_names_and_values() -> None:
    assert options_of(["a=1", "b=x=y", "c="]) == {"a": "1", "b": "x=y", "c": ""}
    with pytest.raises(OptionError, match="--option a says no value; write --option a=VALUE"):
        options_of(["b=1", "a"])


def test_frames_are_two_times_of_which_the_first_is_not_later() -> None:
    assert frames_of("1:48") == (1.0, 48.0)
    assert frames_of("-5:-5") == (-5.0, -5.0)
    for text, sentence in (("5", "is no range"), ("a:b", "is no range"), ("9:3", "ends before")):
        with pytest.raises(OptionError, match=f"--frames {text} {sentence}"):
            frames_of(text)


def test_a_cutoff_is_a_frequency_or_none() -> None:
    assert (cutoff_of(0.0), cutoff_of(12.5)) == (0.0, 12.5)
    for cutoff in (-1.0, float("nan"), float("inf")):
        with pytest.raises(OptionError, match=f"--clean {cutoff:g} is no cutoff"):
            cutoff_of(cutoff)

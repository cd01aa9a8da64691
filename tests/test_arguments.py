"""Words of a command line as values, or one sentence about what would do."""

import pytest

from usdmotion.arguments import (
    cutoff_of,
    duration_of,
    frames_of,
    moments_of,
    names_of,
    options_of,
    template_of,
)
from usdmotion.asking import Example, Span
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


def test_a_length_of_time_is_not_below_zero() -> None:
    assert (duration_of(None, "--minimum"), duration_of(0.0, "--minimum")) == (None, 0.0)
    for seconds in (-0.1, float("nan"), float("inf")):
        with pytest.raises(OptionError, match=f"--minimum {seconds:g} is no length of time"):
            duration_of(seconds, "--minimum")


@pytest.mark.parametrize(
    ("text", "example"),
    [
        ("LeftFoot:10:24", Example("LeftFoot", 10.0, 24.0, "space")),
        ("LeftFoot:10:24:line", Example("LeftFoot", 10.0, 24.0, "line")),
        ("rig:left:foot:-1.5:24", Example("rig:left:foot", -1.5, 24.0, "space")),
        ("foot:2:10:24", Example("foot:2", 10.0, 24.0, "space")),
        ("/World/Box:1:2:point", Example("/World/Box", 1.0, 2.0, "point")),
    ],
)
def test_an_example_is_read_from_the_right(text: str, example: Example) -> None:
    assert template_of(text) == example


@pytest.mark.parametrize("text", ["", "foot", "foot:1", "1:2", ":1:2", "foot:a:2", "foot:1:nan"])
def test_what_is_no_example_says_how_one_is_written(text: str) -> None:
    with pytest.raises(OptionError, match="write --template JOINT:START:END"):
        template_of(text)


def test_names_are_separated_by_commas_or_said_one_after_another() -> None:
    assert names_of(["a, b", "c", ""]) == ("a", "b", "c")
    assert names_of(None) == ()
    assert names_of([""]) == names_of([" , "]) == ("",)


def test_frames_of_a_picture_are_a_span_or_a_list():
    assert moments_of(None) is None
    assert moments_of("3") == (3.0,)
    assert moments_of("1,24.5,48") == (1.0, 24.5, 48.0)
    assert moments_of("1:48") == Span(1.0, 48.0)
    assert moments_of("-4:48:8") == Span(-4.0, 48.0, 8.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "names no frames"),
        ("a,b", "names no frames"),
        ("1:2:3:4", "names no frames"),
        ("1:nan", "names no frames"),
        ("1:4,5", "a range and a list"),
        ("48:1", "ends before it starts"),
        ("1:48:0", "does not get on"),
    ],
)
def test_frames_of_a_picture_that_are_none_are_refused(text, said):
    with pytest.raises(OptionError, match=said):
        moments_of(text)

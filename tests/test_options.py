"""Options: fields that carry their own words, types and limits."""

from dataclasses import dataclass
from typing import ClassVar

import pytest

from usdmotion.errors import OptionError
from usdmotion.options import Option, configured, option, options


@dataclass(frozen=True)
class Machine:
    name: ClassVar[str] = "machine"
    size: int = 0
    rounds: int = option(40, "How often.", minimum=1, maximum=100)
    gain: float = option(0.5, "How much.", minimum=0.0)
    loud: bool = option(False, "Whether it is heard.")
    mode: str = option("fast", "In which way.", choices=("fast", "slow"))
    label: str = option("", "What stands on it.")


def test_only_declared_fields_are_options_in_their_order() -> None:
    assert [each.name for each in options(Machine)] == ["rounds", "gain", "loud", "mode", "label"]
    assert options(Machine)[0] == Option("rounds", 40, "How often.", 1, 100)
    assert options(int) == ()


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("rounds", "7", 7),
        ("rounds", 7.0, 7),
        ("rounds", "1e2", 100),
        ("gain", "0.25", 0.25),
        ("gain", 3, 3.0),
        ("loud", "yes", True),
        ("loud", "OFF", False),
        ("loud", True, True),
        ("loud", 0, False),
        ("mode", "slow", "slow"),
        ("label", "12", "12"),
    ],
)
def test_a_value_or_its_text_becomes_the_options_type(
    name: str, text: object, value: object
) -> None:
    parsed = getattr(configured(Machine, {name: text}), name)
    assert parsed == value
    assert type(parsed) is type(value)


@pytest.mark.parametrize(
    ("name", "value", "wanted"),
    [
        ("rounds", 0, "a whole number of at least 1, at most 100"),
        ("rounds", 101, "a whole number"),
        ("rounds", "2.5", "a whole number"),
        ("rounds", "many", "a whole number"),
        ("rounds", True, "a whole number"),
        ("rounds", None, "a whole number"),
        ("gain", -0.1, "a number of at least 0"),
        ("gain", "nan", "a number"),
        ("gain", "inf", "a number"),
        ("loud", "perhaps", "true or false"),
        ("loud", 2, "true or false"),
        ("mode", "medium", "one of fast, slow"),
    ],
)
def test_a_value_that_an_option_cannot_have_is_refused_with_what_would_do(
    name: str, value: object, wanted: str
) -> None:
    with pytest.raises(OptionError, match=f"'{name}' is .*, not {wanted}"):
        configured(Machine, {name: value})


def test_an_unknown_option_is_answered_with_those_that_are_there() -> None:
    with pytest.raises(OptionError, match="'machine' has no option 'speed'; it has: rounds, gain"):
        configured(Machine, {"speed": 1})


def test_what_nobody_sets_keeps_its_default() -> None:
    assert configured(Machine, {}) == Machine()
    assert configured(Machine, {"rounds": 3}) == Machine(rounds=3)

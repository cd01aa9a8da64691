"""The verb `detect`: what it prints, where it writes, and what it refuses in one sentence."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

Shot = Callable[..., Path]


@pytest.fixture
def run(typed: Callable[..., str]) -> Callable[..., str]:
    """Return what runs the verb."""
    return lambda words, **asked: typed(f"detect {words}", **asked)


def test_contacts_are_shown_and_the_name_that_was_derived_is_printed(
    run: Callable[..., str], arm: Path
) -> None:
    said = run("arm.usda --joints base")
    assert "</Arm/Skeleton/Edit/base>: space by contacts" in said
    assert "│ Contact01 │ space │" in said
    assert "wrote arm.contacts.usda: 1 contacts" in said


def test_a_layer_of_contacts_is_looked_at_again_under_the_next_name(
    run: Callable[..., str], arm: Path
) -> None:
    run("arm.usda --joints base")
    assert "wrote arm.contacts2.usda" in run("arm.contacts.usda")
    assert "wrote arm.contacts3.usda" in run("arm.contacts2.usda")


def test_json_has_all_of_it(run: Callable[..., str], arm: Path) -> None:
    data = json.loads(run("arm.usda --joints base,wrist --json - --minimum 0.1"))
    base, wrist = data["objects"]
    assert base["object"] == "base"
    assert wrist["object"] == "base/shoulder/elbow/wrist"
    (contact,) = base["contacts"]
    assert contact["path"] == "/Arm/Skeleton/Edit/base/Contact01"
    assert contact["start"] == base["first"] and contact["end"] == base["last"]
    assert contact["seconds"] == pytest.approx((contact["end"] - contact["start"]) / 24.0)
    assert contact["state"] == "detected"


def test_quiet_is_quiet(run: Callable[..., str], arm: Path) -> None:
    assert run("arm.usda --joints base --quiet") == ""


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("none.usda", "usdmotion: none.usda: there is no such file"),
        ("arm.usda", "nobody knows which joints of </Arm/Skeleton> are feet; name joints"),
        ("arm.usda --joints rist", "no joint 'rist' on </Arm/Skeleton>; did you mean 'wrist'?"),
        ("arm.usda --joints /Arm", "'/Arm' is no joint; name prims with --prims"),
        ("arm.usda --joints ''", "no joint '' on </Arm/Skeleton>; it has base, shoulder"),
        ("arm.usda --prims ''", "no prim <>; name one of the stage"),
        ("arm.usda --joints base --kinds ''", "cannot look for ''; it looks for space, line"),
        ("arm.usda --joints base --minimum nan", "--minimum nan is no length of time"),
        ("arm.usda --joints base --minimum -1", "--minimum -1 is no length of time"),
        ("arm.usda --joints base -o arm.usda", "no input is written to; name another"),
        ("arm.usda --joints base -o arm.txt", "name a file that ends in .usda"),
        ("arm.usda --joints base --kinds knot", "cannot look for 'knot'; it looks for space"),
        ("arm.usda --joints base --detector eye", "there is no detector 'eye'; there are:"),
        ("arm.usda --joints base --option pace=1", "has no option 'pace'"),
        ("arm.usda --template base:1", "write --template JOINT:START:END"),
        ("arm.usda --template base:1:900", "base:1:900 is outside of the motion of base"),
        ("arm.usda --joints base --edit /Arm", "</Arm> is no MotionEdit; there are:"),
    ],
)
def test_an_input_at_fault_is_one_sentence(
    run: Callable[..., str], arm: Path, words: str, sentence: str
) -> None:
    said = run(words, status=2)
    assert sentence in said
    assert said.count("\n") == 1
    assert not Path("arm.contacts.usda").exists()

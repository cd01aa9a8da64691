"""USD's own validation finds what `inspect` finds."""

import json
from pathlib import Path

import pytest

import usdmotion.usd.faults
from usdmotion.usd import registration
from usdmotion.usd.faults import CHECKS, find

EDIT = "/Body/Skeleton/Edit"
needs_validators = pytest.mark.skipif(
    not registration.has_python_validators(), reason="validators in Python need USD 26.5"
)


def test_the_validators_that_usd_lists_are_the_checks():
    plugin = Path(usdmotion.usd.faults.__file__).parent.parent / "validation" / "plugInfo.json"
    (declared,) = json.loads(plugin.read_text())["Plugins"]
    validators = declared["Info"]["Validators"]
    assert validators.pop("keywords") == ["UsdMotion"]
    assert declared["Type"] == "python"
    assert validators == {
        check.name: {"doc": check.find.__doc__, "schemaTypes": list(check.types)}
        for check in CHECKS
    }


def validate(stage):
    """Return path, name and sentence of what USD's own validation finds with our validators."""
    from pxr import UsdValidation

    errors = UsdValidation.ValidationContext(keywords=["UsdMotion"]).Validate(stage)
    return {
        (str(error.GetSites()[0].GetPrim().GetPath()), error.GetName(), error.GetMessage())
        for error in errors
    }


@needs_validators
def test_usds_own_validation_finds_the_same(stage, case):
    name, change = case
    change(stage)
    same = {(fault.path, fault.name, fault.sentence) for fault in find(stage)}
    assert name in {fault[1] for fault in same}
    assert validate(stage) == same


@needs_validators
def test_usds_own_validation_is_silent_on_a_good_stage(stage):
    assert validate(stage) == set()


@needs_validators
def test_a_validator_says_which_it_is_and_how_bad_it_is(stage, put):
    from pxr import UsdValidation

    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    context = UsdValidation.ValidationContext(keywords=["UsdMotion"])
    error = context.Validate(stage)[0]
    assert error.GetIdentifier() == "usdmotion.usd.validation:Recruiting.RecruitingRule"
    assert error.GetType() == UsdValidation.ValidationErrorType.Warn

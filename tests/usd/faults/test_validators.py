"""USD's own validation finds what `inspect` finds."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import usdmotion_schemas
from pxr import Gf, Usd, UsdGeom

import usdmotion.usd.faults
from usdmotion.usd import registration
from usdmotion.usd.faults import CHECKS, STAGE_CHECKS, Fault, find

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
    assert validators == {check.name: {"doc": check.find.__doc__} for check in STAGE_CHECKS} | {
        check.name: {"doc": check.find.__doc__, "schemaTypes": list(check.types)}
        for check in CHECKS
    }


SEVERITIES = {"Error": "error", "Warn": "warning", "Info": "note"}


def validate(stage):
    """Return what USD's own validation finds with our validators: who, what, how bad, in words."""
    from pxr import UsdValidation

    errors = UsdValidation.ValidationContext(keywords=["UsdMotion"]).Validate(stage)
    return {
        Fault(
            str(error.GetSites()[0].GetPrim().GetPath()),
            error.GetName(),
            error.GetMessage(),
            SEVERITIES[error.GetType().name],
        )
        for error in errors
    }


@needs_validators
def test_usds_own_validation_finds_the_same(stage, case):
    name, change = case
    change(stage)
    same = {*find(stage)}
    assert name in {fault.name for fault in same}
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


@needs_validators
def test_what_does_not_compose_is_found_too(stage):
    stage.DefinePrim("/Lost").GetReferences().AddReference("./gone.usda")
    (fault,) = find(stage)
    assert (fault.path, fault.name, fault.severity) == ("/Lost", "Composition", "error")
    assert validate(stage) == {fault}


@needs_validators
def test_what_is_drawn_for_people_is_not_told_of(stage):
    home = UsdGeom.Xform.Define(stage, f"{EDIT}/Guides")
    home.CreatePurposeAttr("guide")
    stage.DefinePrim(f"{EDIT}/Guides/Ghost", "Skeleton")
    assert validate(stage) == {*find(stage)} == set()


@needs_validators
def test_selected_prims_are_validated_as_usdview_does(stage, put):
    from pxr import UsdValidation

    put(f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])(stage)
    registry = UsdValidation.ValidationRegistry()
    known = registry.GetValidatorMetadataForKeyword("UsdMotion")
    assert {each.plugin.name for each in known} == {"usdmotion.usd.validation"}
    metadata = [registry.GetValidatorMetadata(each.name) for each in known]
    context = UsdValidation.ValidationContext(metadata=metadata)
    now = UsdValidation.ValidationTimeRange(Gf.Interval(1.0), False)
    found = context.Validate([stage.GetPrimAtPath(EDIT)], now)
    assert {error.GetMessage() for error in found} == {fault.sentence for fault in find(stage)}


@needs_validators
@pytest.mark.parametrize(
    ("fault", "fixer", "spoil"),
    [
        ("RecruitingRule", "ExtendRecruits", (f"{EDIT}/Foot", "usdmotion:recruits", ["hips/leg"])),
        ("MissingAPI", "ApplyAPI", None),
    ],
)
def test_what_has_one_remedy_offers_it(stage, put, tmp_path, fault, fixer, spoil):
    from pxr import UsdValidation

    stage.GetRootLayer().Export(str(tmp_path / "spoilt.usda"))
    shot = Usd.Stage.Open(str(tmp_path / "spoilt.usda"))
    if spoil:
        put(*spoil)(shot)
    else:
        shot.GetPrimAtPath("/Body/Skeleton").RemoveAppliedSchema("MotionSkeletonAPI")
    context = UsdValidation.ValidationContext(keywords=["UsdMotion"])
    errors = [each for each in context.Validate(shot) if each.GetName() == fault]
    if Usd.GetVersion() < (0, 26, 11) and not errors[0].GetFixers():
        pytest.skip("this older USD takes no fixers in Python")
    (remedy,) = errors[0].GetFixersByErrorName()
    assert remedy.name == fixer
    assert not remedy.CanApplyFix(errors[0], Usd.EditTarget(shot.GetSessionLayer()))
    assert remedy.ApplyFix(errors[0], Usd.EditTarget(shot.GetRootLayer()))
    assert find(Usd.Stage.Open(str(tmp_path / "spoilt.usda"))) == []


@needs_validators
def test_usd_finds_them_where_nothing_of_ours_was_imported(tmp_path):
    spoilt = tmp_path / "spoilt.usda"
    spoilt.write_text(Path(__file__).with_name("good.usda").read_text())
    stage = Usd.Stage.Open(str(spoilt))
    stage.GetPrimAtPath(f"{EDIT}/Hand").GetAttribute("usdmotion:joint").Set("hand")
    stage.Save()
    code = """
import sys
from pxr import Usd, UsdValidation
known = UsdValidation.ValidationRegistry().GetValidatorMetadataForKeyword("UsdMotion")
assert "usdmotion" not in sys.modules
print(len(known))
context = UsdValidation.ValidationContext(keywords=["UsdMotion"])
for error in context.Validate(Usd.Stage.Open(sys.argv[1])):
    print(error.GetMessage())
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    environment |= dict(line.split("=", 1) for line in usdmotion_schemas.environment())
    command = [sys.executable, "-c", code, str(spoilt)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    count, *sentences = done.stdout.splitlines()
    assert int(count) == len(CHECKS) + len(STAGE_CHECKS)
    assert sentences == [fault.sentence for fault in find(stage)] != []

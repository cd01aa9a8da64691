"""The checks of `usdmotion.usd.faults` as validators of USD; USD imports this when it needs them.

They carry the keyword UsdMotion:

    UsdValidation.ValidationContext(keywords=["UsdMotion"]).Validate(stage)

The plugInfo.json beside this file names each validator with its doc and prim types, so that USD can
list them without importing anything. Below USD 26.5 there are no validators in Python, and fixers
came after them.
"""

from collections.abc import Callable, Iterable
from typing import Any

from pxr import Usd

from usdmotion.usd.drawn import is_drawn
from usdmotion.usd.faults import CHECKS, STAGE_CHECKS, Check, Fault, StageCheck
from usdmotion.usd.faults.fixes import FIXES, Fix
from usdmotion.usd.registration import has_python_validators

PLUGIN = "usdmotion.usd.validation"


def _of_prims(check: Check) -> Callable[[Usd.Prim, Any], list[Any]]:
    """Return a check of prims as USD calls it."""

    def validate(prim: Usd.Prim, _times: Any) -> list[Any]:
        # What is drawn for people is nothing of the scene.
        return [] if is_drawn(prim) else _errors(prim.GetStage(), check.find(prim))

    return validate


def _of_stages(check: StageCheck) -> Callable[[Usd.Stage, Any], list[Any]]:
    """Return a check of stages as USD calls it."""

    def validate(stage: Usd.Stage, _times: Any) -> list[Any]:
        return _errors(stage, check.find(stage))

    return validate


def _errors(stage: Usd.Stage, faults: Iterable[Fault]) -> list[Any]:
    from pxr import UsdValidation

    types = UsdValidation.ValidationErrorType
    severities = {"error": types.Error, "warning": types.Warn, "note": types.Info}
    return [
        UsdValidation.ValidationError(
            fault.name,
            severities[fault.severity],
            [UsdValidation.ValidationErrorSite(stage, fault.path, stage.GetRootLayer())],
            fault.sentence,
        )
        for fault in faults
    ]


def _fixers(check: Check) -> list[Any]:
    """Return what mends what a check finds, as USD calls it."""
    from pxr import UsdValidation

    return [
        UsdValidation.ValidationFixer(
            name=fix.name,
            description=str(fix.apply.__doc__),
            fixerImplFn=_mending(fix),
            canApplyFn=_is_mendable,
            keywords=["UsdMotion"],
            errorName=fix.fault,
        )
        for fix in FIXES
        if fix.check == check.name
    ]


def _mending(fix: Fix) -> Callable[[Any, Usd.EditTarget, Any], bool]:
    def mend(error: Any, target: Usd.EditTarget, _time: Any) -> bool:
        prim = error.GetSites()[0].GetPrim()
        with Usd.EditContext(prim.GetStage(), target):
            fix.apply(prim)
        return True

    return mend


def _is_mendable(_error: Any, target: Usd.EditTarget, _time: Any) -> bool:
    # USD saves a layer once something in it is mended, which it cannot if that is in no file.
    layer = target.GetLayer()
    return bool(layer) and not layer.anonymous and layer.permissionToEdit


def _register() -> None:
    from pxr import UsdValidation

    registry = UsdValidation.ValidationRegistry()
    for whole in STAGE_CHECKS:
        registry.RegisterPluginStageValidator(f"{PLUGIN}:{whole.name}", _of_stages(whole))
    for check in CHECKS:
        name, validate = f"{PLUGIN}:{check.name}", _of_prims(check)
        try:
            registry.RegisterPluginPrimValidator(name, validate, _fixers(check))
        except (TypeError, RuntimeError):  # validators in Python are older than fixers
            registry.RegisterPluginPrimValidator(name, validate)


if has_python_validators():
    _register()

"""The checks of `usdmotion.usd.faults` as validators of USD; USD imports this when it needs them.

They carry the keyword UsdMotion:

    UsdValidation.ValidationContext(keywords=["UsdMotion"]).Validate(stage)

The plugInfo.json beside this file names each validator with its doc and prim types, so that USD can
list them without importing anything. Below USD 26.5 there are no validators in Python.
"""

from collections.abc import Callable
from typing import Any

from pxr import Usd

from usdmotion.usd.faults import CHECKS, Check
from usdmotion.usd.registration import has_python_validators

PLUGIN = "usdmotion.usd.validation"


def _validator(check: Check) -> Callable[[Usd.Prim, Any], list[Any]]:
    """Return a check as USD calls it."""
    from pxr import UsdValidation

    severities = {
        "error": UsdValidation.ValidationErrorType.Error,
        "warning": UsdValidation.ValidationErrorType.Warn,
    }

    def validate(prim: Usd.Prim, _times: Any) -> list[Any]:
        stage = prim.GetStage()
        return [
            UsdValidation.ValidationError(
                fault.name,
                severities[fault.severity],
                [UsdValidation.ValidationErrorSite(stage, fault.path)],
                fault.sentence,
            )
            for fault in check.find(prim)
        ]

    return validate


if has_python_validators():
    from pxr import UsdValidation

    for _check in CHECKS:
        UsdValidation.ValidationRegistry().RegisterPluginPrimValidator(
            f"{PLUGIN}:{_check.name}", _validator(_check)
        )

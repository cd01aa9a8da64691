"""What mends a fault where only one thing would: who is asked for it need not be."""

from collections.abc import Callable
from dataclasses import dataclass

from pxr import Usd, Vt

from usdmotion.recruiting import mend
from usdmotion.usd.faults.recruits import claims_of
from usdmotion.usd.faults.values import missing_apis
from usdmotion.usd.relations import edit_of


@dataclass(frozen=True, slots=True)
class Fix:
    """A function that mends one kind of fault."""

    check: str
    """Name of the check that finds the fault."""
    fault: str
    """Name of the fault."""
    name: str
    """Name of the fixer in USD."""
    apply: Callable[[Usd.Prim], None]
    """Mends it in the edit target; its docstring is the description of the fixer."""


def extend_recruits(prim: Usd.Prim) -> None:
    """Let constraints of a higher rank recruit what the recruiting rule asks of them."""
    edit = edit_of(prim)
    parents, claims = claims_of(edit) if edit is not None else ({}, [])
    for before, after in zip(claims, mend(parents, claims), strict=True):
        if after.recruits != before.recruits:
            tokens = Vt.TokenArray([joint for joint in parents if joint in after.recruits])
            high = prim.GetStage().GetPrimAtPath(before.name)
            high.GetAttribute("usdmotion:recruits").Set(tokens)


def apply_apis(prim: Usd.Prim) -> None:
    """Apply the API schemas whose properties the prim has."""
    for name in missing_apis(prim):
        prim.AddAppliedSchema(name)


FIXES = (
    Fix("Recruiting", "RecruitingRule", "ExtendRecruits", extend_recruits),
    Fix("MissingAPI", "MissingAPI", "ApplyAPI", apply_apis),
)
"""Every fix."""

"""What the schema advises of a property and USD does not enforce."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from pxr import Sdf, Usd

from usdmotion.usd.faults.fault import Fault, error, warning
from usdmotion.usd.relations import mistyped, suggestion

NAMESPACE = "usdmotion:"
OPTION = "usdmotion:option:"
"""Options are the solver's: the schema does not know them."""


def find_wrong_values(prim: Usd.Prim) -> Iterator[Fault]:
    """Find properties that the schema does not have, and values that it does not allow."""
    known = set(prim.GetPrimDefinition().GetPropertyNames())
    for name in prim.GetAuthoredPropertyNames():
        if name in known:
            attribute = prim.GetAttribute(name)
            if attribute:
                yield from _find_in(prim, attribute)
        elif name.startswith(NAMESPACE) and not name.startswith(OPTION) and not _owner(name):
            ours = tuple(sorted(other for other in known if other.startswith(NAMESPACE)))
            yield warning(
                prim,
                "UnknownProperty",
                f"has {name}, which no schema of it does; {suggestion(name, ours)}",
            )


def find_missing_apis(prim: Usd.Prim) -> Iterator[Fault]:
    """Find properties of an API schema that was not applied."""
    for owner, name in missing_apis(prim).items():
        yield warning(
            prim, "MissingAPI", f"has {name} without the API it is of; apply {owner} to it"
        )


def missing_apis(prim: Usd.Prim) -> dict[str, str]:
    """Return the API schemas of which a prim has a property, with that, and that it lacks."""
    known = set(prim.GetPrimDefinition().GetPropertyNames())
    owners = {_owner(name): name for name in prim.GetAuthoredPropertyNames() if name not in known}
    return {owner: name for owner, name in owners.items() if owner}


def find_misapplied_apis(prim: Usd.Prim) -> Iterator[Fault]:
    """Find API schemas that are applied to a type of prim that they are not for."""
    for name in prim.GetAppliedSchemas():
        allowed = Usd.SchemaRegistry.GetAPISchemaCanOnlyApplyToTypeNames(name)
        ours = name in ("MotionSkeletonAPI", "MotionResultAPI")
        if ours and allowed and not any(prim.IsA(kind) for kind in allowed):
            yield error(
                prim,
                "MisappliedAPI",
                f"is a {prim.GetTypeName() or 'prim without a type'} and has {name} applied; that "
                f"is for a {' or '.join(allowed)}, so move it there",
            )


def limits(attribute: Usd.Attribute) -> tuple[Any, Any]:
    """Return the hard limits of an attribute, None where there is none."""
    written = attribute.GetMetadata("limits")
    # A USD from before limits reads them all the same, as metadata that it does not know.
    held = written.value if isinstance(written, Sdf.UnregisteredValue) else written
    hard = (held or {}).get("hard", {})
    return _number(hard.get("minimum")), _number(hard.get("maximum"))


def _number(limit: Any) -> Any:
    return limit[0] if limit is not None and not isinstance(limit, (int, float)) else limit


def _owner(name: str) -> str:
    """Return the API schema of ours that has a property, or nothing."""
    for api in ("MotionSkeletonAPI", "MotionResultAPI"):
        definition = Usd.SchemaRegistry().FindAppliedAPIPrimDefinition(api)
        if definition and name in definition.GetPropertyNames():
            return api
    return ""


def _find_in(prim: Usd.Prim, attribute: Usd.Attribute) -> Iterator[Fault]:
    name = attribute.GetName()
    written = mistyped(attribute)
    if written:
        meant = prim.GetPrimDefinition().GetPropertyMetadata(name, "typeName")
        yield error(prim, "WrongType", f"has {name} as {written}; write it as {meant}")
        return
    moves = attribute.GetNumTimeSamples() > 0 or attribute.HasSpline()
    if attribute.GetVariability() == Sdf.VariabilityUniform and moves:
        yield error(
            prim,
            "UniformAnimated",
            f"animates {name}, which is one value for the whole shot; set it",
        )
    allowed = attribute.GetMetadata("allowedTokens")
    # Parts have a check of their own, which knows what may have been meant.
    if allowed and name != "usdmotion:parts":
        yield from _find_tokens(prim, attribute, tuple(str(token) for token in allowed))
    yield from _find_out_of_limits(prim, attribute)


def _find_tokens(
    prim: Usd.Prim, attribute: Usd.Attribute, allowed: tuple[str, ...]
) -> Iterator[Fault]:
    written = attribute.Get()
    tokens = [written] if isinstance(written, str) else list(written or ())
    for token in tokens:
        if token not in allowed:
            yield error(
                prim,
                "UnknownToken",
                f"has '{token}' in {attribute.GetName()}; it may be {', '.join(allowed)}",
            )


def _find_out_of_limits(prim: Usd.Prim, attribute: Usd.Attribute) -> Iterator[Fault]:
    lowest, highest = limits(attribute)
    if lowest is None and highest is None:
        return
    for time in _times(attribute):
        numbers = np.atleast_1d(np.asarray(attribute.Get(time), dtype=np.float64))
        for number in numbers:
            below = lowest is not None and number < lowest
            above = highest is not None and number > highest
            # Written so that what is not a number is out of limits as well.
            if below or above or number != number:
                when = "" if time == Usd.TimeCode.Default() else f" at {time.GetValue():g}"
                yield error(
                    prim,
                    "OutOfLimits",
                    f"has {number:g} in {attribute.GetName()}{when}; {_meant(lowest, highest)}",
                )
                return


def _meant(lowest: Any, highest: Any) -> str:
    if highest is None:
        return f"keep it at {lowest:g} or above"
    return f"keep it from {lowest:g} to {highest:g}"


def _times(attribute: Usd.Attribute) -> list[Usd.TimeCode]:
    """Return the times that show all of an attribute: samples, or knots and between them."""
    if attribute.HasSpline():
        knots = sorted(attribute.GetSpline().GetKnots().keys())
        between = [
            first + (last - first) * step / 8
            for first, last in pairwise(knots)
            for step in range(1, 8)
        ]
        return [Usd.TimeCode(time) for time in sorted([*knots, *between])]
    times = [Usd.TimeCode(time) for time in attribute.GetTimeSamples()]
    return times or [Usd.TimeCode.Default()]

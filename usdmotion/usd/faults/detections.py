"""Detections that look at nothing, or with a detector that is not there."""

from collections.abc import Iterator

from pxr import Usd

from usdmotion.plugins import host
from usdmotion.usd.faults.fault import Fault, warning
from usdmotion.usd.relations import mistyped, names_target, suggestion, value

SIGMA, EPSILON = "usdmotion:sigmaMax", "usdmotion:epsilonMax"
"""The two curves of a noise pattern."""


def find_idle_detections(prim: Usd.Prim) -> Iterator[Fault]:
    """Find detections of nothing or of two things, without a detector, or with half a pattern."""
    # Contacts that are there can be solved nevertheless, so that all these are warnings.
    joint, has_object = value(prim, "usdmotion:joint", ""), names_target(prim, "usdmotion:object")
    if not joint and not has_object:
        yield warning(prim, "NoObject", "looks at nothing; set usdmotion:joint or usdmotion:object")
    elif joint and has_object:
        yield warning(
            prim,
            "TwoObjects",
            f"looks at the joint '{joint}' and names a usdmotion:object too; clear one of them",
        )
    detector, known = str(value(prim, "usdmotion:detector", "")), tuple(host().detectors)
    if detector and detector not in known:
        yield warning(
            prim,
            "UnknownDetector",
            f"is by the detector '{detector}', which is not there; {suggestion(detector, known)}",
        )
    missing = _half_a_pattern(prim)
    if missing:
        yield warning(
            prim,
            "HalfAPattern",
            f"has no {missing}, so its noise pattern is estimated; set both",
        )


def _half_a_pattern(prim: Usd.Prim) -> str:
    """Return the attribute of a noise pattern that is missing where the other is there, else ""."""
    says = {name: says_pattern(prim, name) for name in (SIGMA, EPSILON)}
    return next((name for name in says if not says[name]), "") if any(says.values()) else ""


def says_pattern(prim: Usd.Prim, name: str) -> bool:
    """Tell whether a detection says what one of the two curves of its noise pattern is."""
    attribute = prim.GetAttribute(name)
    if not attribute or mistyped(attribute) or not attribute.HasAuthoredValue():
        return False
    return attribute.HasSpline() or attribute.GetNumTimeSamples() > 0 or bool(attribute.Get())

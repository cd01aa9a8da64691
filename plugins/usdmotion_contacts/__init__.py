"""Finds the contacts that a motion obeys (2006)."""

from collections.abc import Iterable

from usdmotion import Detector, hookimpl
from usdmotion_contacts.detector import ContactDetector


@hookimpl
def register_detectors() -> Iterable[type[Detector]]:
    """Return the detectors."""
    return [ContactDetector]

"""Finds the contacts that a motion obeys (2006)."""

from collections.abc import Iterable

from usdmotion import Detector, hookimpl
from usdmotion_contacts.detector import ContactDetector
from usdmotion_contacts.height_and_speed import HeightAndSpeed


@hookimpl
def register_detectors() -> Iterable[type[Detector]]:
    """Return the detectors."""
    return [ContactDetector, HeightAndSpeed]

"""Finds the contacts that a motion obeys (2006)."""

from collections.abc import Iterable

from usdmotion import Detector, hookimpl
from usdmotion_contacts.detector import ContactDetector
from usdmotion_contacts.height_and_speed import HeightAndSpeed
from usdmotion_contacts.thresholds import Thresholds, best_thresholds

__all__ = [
    "ContactDetector",
    "HeightAndSpeed",
    "Thresholds",
    "best_thresholds",
    "register_detectors",
]


@hookimpl
def register_detectors() -> Iterable[type[Detector]]:
    """Return the detectors."""
    return [ContactDetector, HeightAndSpeed]

"""Contacts of a stage: what is looked at, what for, and how what was found is written."""

from usdmotion.usd.detections.authoring import (
    Authored,
    Found,
    author_detections,
    detection_provenance,
)
from usdmotion.usd.detections.entries import Entry
from usdmotion.usd.detections.feet import author_feet
from usdmotion.usd.detections.searches import Sought, read_searches
from usdmotion.usd.detections.templates import author_template

__all__ = [
    "Authored",
    "Entry",
    "Found",
    "Sought",
    "author_detections",
    "author_feet",
    "author_template",
    "detection_provenance",
    "read_searches",
]

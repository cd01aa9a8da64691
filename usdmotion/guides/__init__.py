"""The shapes of what there is to look at: arrays in, arrays out, in metres."""

from usdmotion.guides.contacts import (
    ContactGuide,
    Held,
    apart,
    contact_guide,
    size_of,
    trajectory,
)
from usdmotion.guides.palette import COLORS, Color, another, same
from usdmotion.guides.segments import GIRTH, SegmentGuide, is_segment_guide, segment_guide

__all__ = [
    "COLORS",
    "GIRTH",
    "Color",
    "ContactGuide",
    "Held",
    "SegmentGuide",
    "another",
    "apart",
    "contact_guide",
    "is_segment_guide",
    "same",
    "segment_guide",
    "size_of",
    "trajectory",
]

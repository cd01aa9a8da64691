"""The shapes of what there is to look at: arrays in, arrays out, in metres."""

from usdmotion.guides.axes import OCTAHEDRON_FACES, octahedron
from usdmotion.guides.contacts import (
    ContactGuide,
    ContactMark,
    ContactObject,
    Held,
    apart,
    contact_guide,
    size_of,
    trajectory,
)
from usdmotion.guides.palette import COLORS, MISSED, Color, another, same
from usdmotion.guides.polylines import simplified
from usdmotion.guides.segments import GIRTH, SegmentGuide, is_segment_guide, segment_guide
from usdmotion.guides.supports import SupportGuide, support_guide
from usdmotion.guides.thinning import thinned

__all__ = [
    "COLORS",
    "GIRTH",
    "MISSED",
    "OCTAHEDRON_FACES",
    "Color",
    "ContactGuide",
    "ContactMark",
    "ContactObject",
    "Held",
    "SegmentGuide",
    "SupportGuide",
    "another",
    "apart",
    "contact_guide",
    "is_segment_guide",
    "octahedron",
    "same",
    "segment_guide",
    "simplified",
    "size_of",
    "support_guide",
    "thinned",
    "trajectory",
]

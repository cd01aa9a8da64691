"""The shapes of what there is to look at: arrays in, arrays out, in metres."""

from usdmotion.guides.segments import GIRTH, SegmentGuide, segment_guide

__all__ = ["GIRTH", "SegmentGuide", "segment_guide"]

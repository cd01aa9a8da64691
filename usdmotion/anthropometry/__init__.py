"""What the segments of a body weigh: as authored, by a published table, or by their lengths."""

from usdmotion.anthropometry.weighing import MassSource, with_masses

__all__ = ["MassSource", "with_masses"]

"""Normalized motions and what travels with them, as prims."""

from usdmotion.usd.normalized.motions import author_normalized, read_normalized

__all__ = ["author_normalized", "read_normalized"]

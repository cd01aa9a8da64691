"""Normalized motions and what travels with them, as prims."""

from usdmotion.usd.normalized.gathering import Left, gather
from usdmotion.usd.normalized.motions import author_normalized, read_normalized
from usdmotion.usd.normalized.settings import author_settings, read_settings
from usdmotion.usd.normalized.travellers import (
    author_travellers,
    normalized_prims,
    read_travellers,
)

__all__ = [
    "Left",
    "author_normalized",
    "author_settings",
    "author_travellers",
    "gather",
    "normalized_prims",
    "read_normalized",
    "read_settings",
    "read_travellers",
]

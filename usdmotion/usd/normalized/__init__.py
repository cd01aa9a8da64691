"""Normalized motions and what travels with them, as prims: files, where they come from and go."""

from usdmotion.usd.normalized.files import normalized_prims, read_luggage, write_normalized
from usdmotion.usd.normalized.lowering import low_joints
from usdmotion.usd.normalized.motions import author_normalized, read_normalized
from usdmotion.usd.normalized.placing import place_travellers
from usdmotion.usd.normalized.recorded import (
    Recorded,
    carry,
    feet_of,
    fingerprint,
    read_recorded,
)
from usdmotion.usd.normalized.subjects import (
    Subject,
    find_subjects,
    in_edit_of,
    name_of,
    notes_of,
)
from usdmotion.usd.normalized.targets import (
    Target,
    author_animation,
    edit_path,
    find_target,
    read_target,
    set_range,
    ways_onto,
)

__all__ = [
    "Recorded",
    "Subject",
    "Target",
    "author_animation",
    "author_normalized",
    "carry",
    "edit_path",
    "feet_of",
    "find_subjects",
    "find_target",
    "fingerprint",
    "in_edit_of",
    "low_joints",
    "name_of",
    "normalized_prims",
    "notes_of",
    "place_travellers",
    "read_luggage",
    "read_normalized",
    "read_recorded",
    "read_target",
    "set_range",
    "ways_onto",
    "write_normalized",
]

"""The input of an edit, put on the ground before anything is asked of it (2005, section 7).

Footprints are the contacts of its feet, which go along with them onto the ground.
"""

from usdmotion.grounding.account import Grounding
from usdmotion.grounding.contacts import is_footprint
from usdmotion.grounding.inputs import Grounded, grounded
from usdmotion.grounding.looking import Detect
from usdmotion.grounding.told import PROGRAM, Asked, Told, prims_of, standing_on, told_by

__all__ = [
    "PROGRAM",
    "Asked",
    "Detect",
    "Grounded",
    "Grounding",
    "Told",
    "grounded",
    "is_footprint",
    "prims_of",
    "standing_on",
    "told_by",
]

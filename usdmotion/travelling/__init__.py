"""What is asked of a motion goes with it from one body to another.

A constraint of any kind, ours or a third party's, is carried field by field: what its attributes
say of unit and frame says what is a length, in whose frame it is, and whose orientation.
"""

from usdmotion.travelling.balls import with_points_for_balls
from usdmotion.travelling.carrying import Traveller, bodies, carried
from usdmotion.travelling.feet import with_own_feet
from usdmotion.travelling.footprints import (
    contacts_of_feet,
    footprint_of,
    footprints_of,
    frames_of,
    held_by,
    is_footprint,
)
from usdmotion.travelling.luggage import Left, Luggage
from usdmotion.travelling.meanings import Meanings
from usdmotion.travelling.settings import Settings
from usdmotion.travelling.ways import StaysBehind, Turned, Way

__all__ = [
    "Left",
    "Luggage",
    "Meanings",
    "Settings",
    "StaysBehind",
    "Traveller",
    "Turned",
    "Way",
    "bodies",
    "carried",
    "contacts_of_feet",
    "footprint_of",
    "footprints_of",
    "frames_of",
    "held_by",
    "is_footprint",
    "with_own_feet",
    "with_points_for_balls",
]

"""What is asked of a motion goes with it from one body to another.

A constraint of any kind, ours or a third party's, is carried field by field: what its attributes
say of unit and frame says what is a length, in whose frame it is, and whose orientation.
"""

from usdmotion.travelling.carrying import Traveller, carried
from usdmotion.travelling.measures import Measures
from usdmotion.travelling.settings import Settings
from usdmotion.travelling.ways import StaysBehind, Turned, Way

__all__ = ["Measures", "Settings", "StaysBehind", "Traveller", "Turned", "Way", "carried"]

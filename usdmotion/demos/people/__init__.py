"""The body of the demos on other skeletons: names, joint counts, rest poses, axes."""

from usdmotion.demos.people.namings import NAMINGS
from usdmotion.demos.people.person import RESTS, Person, person

__all__ = ["NAMINGS", "RESTS", "Person", "person"]

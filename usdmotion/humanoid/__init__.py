"""Which joint is which part of a human body.

`guess` tells from names and hierarchy, and refuses what it is not sure of; `recognize` is the same
without a word, and `pelvis` asks for one part only. What a skeleton says
itself (`usdmotion:parts`) wins over any guess.
"""

from usdmotion.humanoid.guessing import guess, pelvis, recognize
from usdmotion.humanoid.part_map import PartMap
from usdmotion.humanoid.parts import ANKLE, BALL, FEET, NECK, NEEDED, PARTS, SPINE

__all__ = [
    "ANKLE",
    "BALL",
    "FEET",
    "NECK",
    "NEEDED",
    "PARTS",
    "SPINE",
    "PartMap",
    "guess",
    "pelvis",
    "recognize",
]

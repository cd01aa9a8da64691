"""A walk from published curves, with feet that really stand still in stance."""

from usdmotion.demos.gait.walking import Stance, Walk, walk

__all__ = ["Stance", "Walk", "walk"]

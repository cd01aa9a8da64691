"""What a camera sees of a stage at some times: surfaces, skinned by UsdSkel, and the camera."""

from usdmotion.usd.seeing.bodies import moved_skeletons, see_bodies
from usdmotion.usd.seeing.cameras import find_camera, see_through
from usdmotion.usd.seeing.seen import SeenBody, SeenSurface
from usdmotion.usd.seeing.sides import Side, in_common, sides_of
from usdmotion.usd.seeing.sights import Sight
from usdmotion.usd.seeing.spans import span_of

__all__ = [
    "SeenBody",
    "SeenSurface",
    "Side",
    "Sight",
    "find_camera",
    "in_common",
    "moved_skeletons",
    "see_bodies",
    "see_through",
    "sides_of",
    "span_of",
]

"""What a camera sees of a stage at some times: surfaces, skinned by UsdSkel, and the camera."""

from usdmotion.usd.seeing.bodies import see_bodies
from usdmotion.usd.seeing.cameras import find_camera, see_through
from usdmotion.usd.seeing.seen import SeenBody, SeenSurface, SeenThrough
from usdmotion.usd.seeing.sights import Sight

__all__ = [
    "SeenBody",
    "SeenSurface",
    "SeenThrough",
    "Sight",
    "find_camera",
    "see_bodies",
    "see_through",
]

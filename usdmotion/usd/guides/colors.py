"""A colour for each object, which it keeps."""

from collections.abc import Sequence

from pxr import Usd

from usdmotion.guides import COLORS, Color, another, same
from usdmotion.usd.drawn import GUIDES
from usdmotion.usd.relations import is_a

TRAJECTORY = f"{GUIDES}/Trajectory"
"""The guide below a detection that has its colour: the whole way of its object."""


def colors_of(stage: Usd.Stage, detections: Sequence[str]) -> list[Color]:
    """Return a colour for each of some detections: the one it has, else one that is used least."""
    known = {
        str(prim.GetPath()): _color(prim)
        for prim in stage.Traverse()
        if is_a(prim, "UsdMotionDetection")
    }
    used = [color for color in known.values() if color is not None]
    found = []
    for path in detections:
        color = known.get(path)
        if color is None:
            color = another(used)
            used.append(color)
        found.append(color)
    return found


def _color(detection: Usd.Prim) -> Color | None:
    path = detection.GetPath().AppendPath(TRAJECTORY).AppendProperty("primvars:displayColor")
    attribute = detection.GetStage().GetAttributeAtPath(path)
    colors = attribute.Get() if attribute else None
    if not colors:
        return None
    red, green, blue = colors[0]
    return next((each for each in COLORS if same(each, colors[0])), (red, green, blue))

"""A colour for each object, which it keeps."""

from collections.abc import Sequence

from pxr import Usd

from usdmotion.guides import COLORS, Color, another, same
from usdmotion.usd.drawn import GUIDES
from usdmotion.usd.relations import is_a

TRAJECTORY = f"{GUIDES}/Trajectory"
"""The guide below a detection that has its colour: the whole way of its object."""
HELD = f"{GUIDES}/Held"
"""The guide below a contact that has its colour."""


def colors_of(stage: Usd.Stage, objects: Sequence[Sequence[Usd.Prim]]) -> list[Color]:
    """Return a colour for each of some objects: the one it has, else one that is used least.

    Args:
        stage: The stage.
        objects: The contacts of each.
    """
    prims = [prim for prim in stage.Traverse() if is_a(prim, "UsdMotionDetection")]
    detected = [color for prim in prims if (color := _color(prim, TRAJECTORY))]
    known = [
        next((color for prim in contacts if (color := _known(prim))), None) for contacts in objects
    ]
    used = [*detected, *(color for color in known if color and color not in detected)]
    found = []
    for color in known:
        if color is None:
            color = another(used)
            used.append(color)
        found.append(color)
    return found


def _known(contact: Usd.Prim) -> Color | None:
    """Return the colour that a contact has, or its detection."""
    above = contact.GetParent()
    found = _color(above, TRAJECTORY) if is_a(above, "UsdMotionDetection") else None
    return found or _color(contact, HELD)


def _color(prim: Usd.Prim, name: str) -> Color | None:
    path = prim.GetPath().AppendPath(name).AppendProperty("primvars:displayColor")
    attribute = prim.GetStage().GetAttributeAtPath(path)
    colors = attribute.Get() if attribute else None
    if not colors:
        return None
    red, green, blue = colors[0]
    return next((each for each in COLORS if same(each, colors[0])), (red, green, blue))

"""From where a picture looks: from the front, the side, above, or between."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import facing
from usdmotion.errors import OptionError

if TYPE_CHECKING:
    from usdmotion.usd.seeing import SeenBody

USUAL = "three-quarter"
VIEWS = {
    "front": (0.0, 4.0),
    "side": (-90.0, 4.0),
    "top": (-90.0, 90.0),
    "three-quarter": (-42.0, 14.0),
}
"""How far the eye stands to the left of who is looked at, and how far it looks down [degrees].

Whoever walks goes to the right of the picture.
"""
_TOGETHER = 0.5
"""Bodies that look different ways have no common front: length of their mean direction."""


def require_askable(views: Sequence[str], camera: str) -> None:
    """Raise if nobody can look so.

    Raises:
        OptionError: A view is not known, or there is a camera besides.
    """
    if camera and views:
        raise OptionError("--camera and --view name two ways to look; leave one of them out")
    for each in views:
        if each not in VIEWS:
            raise OptionError(f"--view '{each}' is no view; name some of {', '.join(VIEWS)}")


def camera_of(view: str, ahead: Floats, up: Floats) -> Camera:
    """Return the eye of a view of somebody who looks ahead, level."""
    return Camera.at(ahead, up, *VIEWS[view])


def ahead_of(bodies: Sequence[SeenBody], up: Floats) -> Floats:
    """Return where bodies look, on the average of what is drawn, level, of length one, shape (3,).

    Where they look different ways, or nobody is there, it is the front of the stage.
    """
    ways = [
        facing(each.character, positions, up)
        for each in bodies
        for positions in each.pose[0]
        if each.character.parts is not None
    ]
    mean = np.mean(ways, axis=0) if ways else np.zeros(3)
    length = float(np.linalg.norm(mean))
    if length > _TOGETHER:
        return np.asarray(mean / length)
    # The front is where a viewer stands: +Z where Y is up, -Y where Z is.
    return np.array((0.0, 0.0, 1.0)) if up[1] > 0.5 else np.array((0.0, -1.0, 0.0))

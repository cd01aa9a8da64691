"""Drawing one body into axes, and its limbs as polygons."""

from typing import TYPE_CHECKING, Literal

import numpy as np

from usdmotion.arrays import Bools, Floats
from usdmotion.drawing.eyes import Eye
from usdmotion.drawing.mannequin import Mannequin, outlines
from usdmotion.drawing.polygons import Polygons, rgb
from usdmotion.motion import WorldPose

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Kind = Literal["before", "after", "other"]
_FILLS = {"before": "#dfe3e7", "after": "#3f8fc6", "other": "#c9a0c0"}
_FAR_FILLS = {"before": "#c6cdd4", "after": "#0a5f9b", "other": "#a9739d"}
"""Of the body's right side, so that the limbs can be told apart."""
_RESULTS = (
    (_FILLS["after"], _FAR_FILLS["after"]),
    ("#ab93cf", "#7453a6"),
    ("#72b8a8", "#2c7a6b"),
    ("#b9a26b", "#86682a"),
)
"""Of the results of several characters, both sides of each."""
_EDGES = {"before": "#aeb5bc", "after": "#ffffff", "other": "#ffffff"}
_LINE = 0.5
"""Width of the line around a limb [points]."""


def draw_body(
    axes: "Axes",
    mannequin: Mannequin,
    camera: Eye,
    pose: WorldPose,
    *,
    kind: Kind,
    scale: float = 1.0,
    shift: tuple[float, float] = (0.0, 0.0),
) -> None:
    """Draw a body: the input pale, the result solid, somebody else in another colour.

    Args:
        axes: Where.
        mannequin: Its capsules.
        camera: From where it is seen.
        pose: World positions [m] and orientations of its joints.
        kind: Who it is.
        scale: Of the picture.
        shift: Where the origin of the picture is put.
    """
    drawn = limbs(mannequin, camera, pose, kind)
    shapes = [shape * scale + np.array(shift) for shape in drawn.shapes]
    moved = Polygons(shapes, drawn.near, drawn.fills, drawn.edges, drawn.widths)
    moved.draw(axes, order={"before": 2, "other": 3, "after": 4}[kind])


def limbs(mannequin: Mannequin, eye: Eye, pose: WorldPose, kind: Kind, number: int = 0) -> Polygons:
    """Return the limbs of a body, those left out that are partly behind the eye.

    Args:
        mannequin: Its capsules.
        eye: From where it is seen.
        pose: World positions [m] and orientations of its joints.
        kind: Who it is.
        number: Which of several characters, whose results differ in colour.
    """
    starts, ends = mannequin.capsules(*pose)
    seen = np.maximum(eye.near(starts), eye.near(ends)) < eye.limit
    starts, ends, radii = starts[seen], ends[seen], mannequin.radii[seen]
    shapes, order = outlines(eye, starts, ends, radii)
    right, inner = mannequin.right[seen][order], mannequin.inner[seen][order]
    one, far = _RESULTS[number % len(_RESULTS)]
    if kind != "after":
        one, far = _FILLS[kind], _FAR_FILLS[kind]
    fills = _either(right, far, one)
    return Polygons(
        list(shapes),
        (eye.near(0.5 * (starts + ends)) + radii)[order],
        fills,
        np.where(inner[:, None], fills, rgb(_EDGES[kind])),
        np.full(len(order), _LINE),
    )


def _either(mask: Bools, one: str, other: str) -> Floats:
    """Return one colour where a mask holds, else another, (count,) to (count, 4)."""
    return np.where(mask[:, None], rgb(one), rgb(other))

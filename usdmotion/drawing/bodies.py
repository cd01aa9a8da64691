"""Drawing one body, or the ground under it, into axes."""

from typing import TYPE_CHECKING, Literal

import numpy as np

from usdmotion.drawing.mannequin import Camera, Mannequin, outlines
from usdmotion.motion import WorldPose

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Kind = Literal["before", "after", "other"]
_FILLS = {"before": "#dfe3e7", "after": "#3f8fc6", "other": "#c9a0c0"}
_FAR_FILLS = {"before": "#d3d8dd", "after": "#0a5f9b", "other": "#a9739d"}
"""Of the body's right side, so that the limbs can be told apart."""
_EDGES = {"before": "#aeb5bc", "after": "#ffffff", "other": "#ffffff"}


def draw_body(
    axes: "Axes",
    mannequin: Mannequin,
    camera: Camera,
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
    from matplotlib.collections import PolyCollection

    starts, ends = mannequin.capsules(*pose)
    polygons, order = outlines(camera, starts, ends, mannequin.radii)
    right = mannequin.right[order]
    colors = np.where(right, _FAR_FILLS[kind], _FILLS[kind])
    edges = np.where(mannequin.inner[order], colors, _EDGES[kind])
    axes.add_collection(
        PolyCollection(
            list(polygons * scale + np.array(shift)),
            facecolors=list(colors),
            edgecolors=list(edges),
            linewidths=0.5,
            zorder={"before": 2, "other": 3, "after": 4}[kind],
        )
    )

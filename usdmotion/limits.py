"""How far a motion leaves the limits of its joints, measured by the host and not by the solver."""

from collections.abc import Iterator

import numpy as np

from usdmotion.arrays import Bools, Floats, Ints
from usdmotion.cast import Cast
from usdmotion.scene import Scene
from usdmotion.solving import Solution

KEPT = 0.01
"""A joint that is less than this beyond its limits keeps them [degrees]."""
_LISTED = 6
"""How many joints a sentence names."""


def sentences(scene: Scene, solution: Solution, solver: str) -> Iterator[str]:
    """Yield what there is to say of the limits of the joints that constraints may move.

    Args:
        scene: What was asked.
        solution: What came back.
        solver: Name of the solver that it came from.
    """
    cast = scene.cast
    before = cast.beyond_limits(cast.rotations) * scene.recruited
    after = cast.beyond_limits(solution.rotations) * scene.recruited
    left: Bools = np.any(after > KEPT, axis=0)
    mended: Bools = np.any(before > KEPT, axis=0) & ~left
    if left.any():
        joints = _listed(cast, after, left)
        yield f"the solver '{solver}' leaves joints beyond their limits: {joints}"
    if mended.any():
        joints = _listed(cast, before, mended)
        yield f"the result keeps the limits of joints that the input leaves: {joints}"


def _listed(cast: Cast, beyond: Floats, which: Bools) -> str:
    """Return the joints that are farthest beyond, how far, and how often."""
    nodes: Ints = np.flatnonzero(which)
    nodes = nodes[np.argsort(-beyond[:, nodes].max(axis=0), kind="stable")]
    told = [
        f"{cast.joints[node][1]} by up to {beyond[:, node].max():.2f}° "
        f"on {(beyond[:, node] > KEPT).sum()} of {cast.frame_count} frames"
        for node in nodes[:_LISTED]
    ]
    return "; ".join(told) + (f"; … ({len(nodes)} joints)" if len(nodes) > _LISTED else "")

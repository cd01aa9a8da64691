"""What curves are drawn from: what a stage shows, and how one of its joints moves."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.asking import Asked
from usdmotion.detecting import Search
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.showing import ShownScene
from usdmotion.surveying import survey
from usdmotion.usd import read_searches
from usdmotion.usd.stages import open_stage


def shown_on(path: Path) -> tuple[ShownScene, ...]:
    """Return what there is to see of the scenes of a stage."""
    return survey(open_stage(path), path, program="").scenes


def search_of(path: Path, joint: str) -> Search:
    """Return how a joint of a stage moves, to be searched for contacts."""
    (sought,) = read_searches(open_stage(path), Asked(joints=(joint,)))
    return sought.search


@dataclass(frozen=True, eq=False)
class Steps:
    """How an object moves from each frame to the next (2006, section 4)."""

    sigma: Floats
    """Largest singular value of R − I, shape (frame_count − 1,)."""
    local: Floats
    """Length of the translation in the object's own frame [m], shape (frame_count − 1,)."""
    world: Floats
    """The same in the world's frame, about its origin [m]."""

    @classmethod
    def of(cls, search: Search, offset: Floats | None = None) -> "Steps":
        """Return the steps of an object, which somebody may have put elsewhere [m], (3,)."""
        places = search.translations + (np.zeros(3) if offset is None else offset)
        turns = search.rotations
        between = multiply(turns[1:], conjugate(turns[:-1]))
        angle = 2.0 * np.arctan2(np.linalg.norm(between[:, :3], axis=1), np.abs(between[:, 3]))
        return cls(
            2.0 * np.sin(0.5 * angle),
            np.linalg.norm(np.diff(places, axis=0), axis=1),
            np.linalg.norm(places[1:] - rotate(between, places[:-1]), axis=1),
        )

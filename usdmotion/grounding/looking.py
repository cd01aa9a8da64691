"""Feet that stand, looked for where nobody has said when they do."""

from collections.abc import Callable, Iterator

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Cast, Character
from usdmotion.detecting import Detected, Search
from usdmotion.humanoid import BALL, FEET
from usdmotion.quality import ground_height
from usdmotion.s4d import Footprint

Detect = Callable[[Search], Detected]
"""Finds the contacts of one joint."""
_SHORTEST = 0.1
"""A foot that stands for less does not stand [s]."""
_BENT = 20.0
"""How far toes may bend while the ball of their foot stands [degrees]."""


def find_footprints(character: Character, detect: Detect, up: Floats) -> Iterator[Footprint]:
    """Yield the footprints that are found of ankles and balls of the feet of a character.

    Args:
        character: In the world, with its parts known.
        detect: What finds contacts of a joint.
        up: The direction away from the ground, shape (3,).
    """
    if character.motion.frame_count < 2 or character.parts is None:
        return
    cast, skeleton = Cast.of([character]), character.skeleton
    ground = ground_height(cast.positions[:, 1:], up)
    for part in FEET:
        joint = character.parts.joint(part)
        if joint is None:
            continue
        ends = skeleton.rest_translations[skeleton.parents == joint]
        search = Search(
            name=skeleton.joints[joint],
            times=cast.times,
            translations=cast.positions[:, joint + 1],
            rotations=cast.orientations[:, joint + 1],
            points=np.concatenate([np.zeros((1, 3)), ends]),
            up=up,
            ground=ground,
            minimum=_SHORTEST,
            parallel_angle=_BENT if part.endswith(BALL) else 5.0,
        )
        for each in detect(search).contacts:
            yield Footprint(part, each.start, each.end, each.location)

"""2005, figure 9: a walk on level ground goes over a slope, down steps, and over bumps."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from usdmotion import usd
from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint, ContactConstraint, Region
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import Walk, walk
from usdmotion.demos.gait.stance import FOOT_FLAT, HEEL_STRIKE
from usdmotion.demos.gait.walking import cycle_rate
from usdmotion.demos.walker import SKELETON, write_walk
from usdmotion.kernels import Shape, forward

GROUND = "/Terrain"
"""What is walked on: all that is below it."""
SLOPE = (1.3, 3.5)
"""Where the slope begins and ends along the way [m]."""
TOP = 0.22
"""How high it goes [m]."""
STEPS = ((3.5, 4.15, TOP), (4.15, 4.85, 0.15), (4.85, 5.5, 0.08))
"""Where each step begins and ends along the way, and how high it is [m]."""
BUMPS = (5.5, 8.7)
"""Where the bumps begin and end along the way [m]."""
_HIGHEST = 0.06
"""How high they are at most [m]."""
_HALF_WIDTH = 0.8
"""Half of how wide everything is [m]."""
_APART = 0.08
"""How far the points of the bumps are apart [m]."""
_FLAT = (FOOT_FLAT - HEEL_STRIKE) / cycle_rate(1.7)
"""How long after its heel a foot is flat [s]."""
_LEVEL = np.array((-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)))
"""What turns z up."""
_STONE, _GRASS = (0.55, 0.53, 0.5), (0.36, 0.5, 0.3)


def bumps(x: Floats, z: Floats) -> Floats:
    """Return how high the bumps are [m]; they fade towards every edge."""
    start, end = BUMPS
    fade = np.minimum(np.minimum(z - start, end - z) / 0.4, (_HALF_WIDTH - np.abs(x)) / 0.3)
    share = np.clip(fade, 0.0, 1.0)
    waves = 0.5 + 0.25 * (np.sin(3.5 * z + 1.3 * x) + np.cos(5.3 * x + 1.9 * z))
    return np.asarray(_HIGHEST * share**2 * (3.0 - 2.0 * share) * waves)


def contacts(walking: Walk) -> Iterator[Constraint]:
    """Yield the contacts of balls while they stand, and of ankles while feet are flat."""
    motion, skeleton = walking.motion, walking.skeleton
    positions, rotations = forward(skeleton.parents, motion.translations, motion.rotations)
    for number, each in enumerate(walking.stances):
        start = each.start + (_FLAT if each.effector == "heel" else 0.0)
        frames = (motion.times >= start) & (motion.times <= each.end)
        joint = skeleton.index[each.joint]
        if frames.any():
            first = int(frames.argmax())
            yield ContactConstraint(
                path=f"{each.side}{each.effector.capitalize()}{number:02d}",
                skeleton=SKELETON,
                joint=each.joint,
                priority=1 if each.effector == "toe" else 2,
                times=(start, each.end),
                location=positions[first, joint],
                orientation=rotations[first, joint],
            )


def build(output: Path) -> None:
    """Write the stage."""
    walking = walk()
    write_walk(
        output,
        walking,
        "Terrain",
        list(contacts(walking)),
        props=list(_shapes()),
        scenery=_author_meshes,
        ground=[GROUND],
    )


def _shapes() -> Iterator[Region]:
    """Yield the floor and the steps."""
    yield Region(path=f"{GROUND}/Floor", shape=Shape.HALF_SPACE, rotation=_LEVEL)
    for number, (start, end, height) in enumerate(STEPS, 1):
        yield Region(
            path=f"{GROUND}/Step{number}",
            extent=np.array((_HALF_WIDTH, 0.5 * height, 0.5 * (end - start))),
            translation=np.array((0.0, 0.5 * height, 0.5 * (start + end))),
        )


def _author_meshes(stage: Any) -> None:
    """Author the slope and the bumps."""
    usd.author_prop(stage, GROUND)
    start, end = SLOPE
    edges = [(start, 0.0), (end, TOP), (end, 0.0)]
    sides = np.array([(x, y, z) for x in (-_HALF_WIDTH, _HALF_WIDTH) for z, y in edges])
    faces = [[0, 1, 4, 3], [0, 2, 1], [3, 4, 5], [1, 2, 5, 4], [0, 3, 5, 2]]
    usd.author_mesh(stage, f"{GROUND}/Slope", sides, faces, color=_STONE)
    counts = [round(length / _APART) + 1 for length in (2.0 * _HALF_WIDTH, BUMPS[1] - BUMPS[0])]
    x, z = np.meshgrid(
        np.linspace(-_HALF_WIDTH, _HALF_WIDTH, counts[0]), np.linspace(*BUMPS, counts[1])
    )
    points: Floats = np.stack([x, bumps(x, z), z], axis=-1).reshape(-1, 3).round(4)
    index = np.arange(len(points)).reshape(x.shape)
    corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    quads = np.stack([each.ravel() for each in corners], axis=1)
    usd.author_mesh(stage, f"{GROUND}/Bumps", points, quads.tolist(), color=_GRASS)


PICTURE = Figure(
    "2005, figure 9: a walk on level ground goes over a slope, down steps, and over bumps",
    frames=(19.0, 43.0, 61.0, 73.0, 91.0, 108.0, 133.0),
    views=("side",),
)

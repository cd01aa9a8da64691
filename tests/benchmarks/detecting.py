"""The searches that the benchmarks measure: joints of a walker, with the noise of a capture."""

from dataclasses import replace

import numpy as np

from usdmotion import Search, Template
from usdmotion.demos.gait import walk
from usdmotion.demos.walker import RATE
from usdmotion.kernels import forward, from_vector, multiply
from usdmotion.plugins import host

PLACE, TURN = 2e-4, 1e-3
"""Standard deviations of the noise [m, rad]."""


def searches(frames: int, joints: int) -> list[Search]:
    """Return searches for what so many joints obey, the first again where there are no more."""
    walking = walk((frames + 1) / RATE)
    motion, skeleton = walking.motion, walking.skeleton
    positions, orientations = forward(skeleton.parents, motion.translations, motion.rotations)
    random = np.random.default_rng(0)

    def search(index: int) -> Search:
        joint = index % len(skeleton.joints)
        noise = random.normal(size=(2, frames, 3))
        return Search(
            name=skeleton.joints[joint],
            times=motion.times[:frames],
            translations=positions[:frames, joint] + PLACE * noise[0],
            rotations=multiply(orientations[:frames, joint], from_vector(TURN * noise[1])),
        )

    return [search(index) for index in range(joints)]


def toes(frames: int) -> Search:
    """Return a search for the rests of a foot, the first of them given as a template."""
    every = searches(frames, 31)
    foot = next(each for each in every if each.name.endswith("LeftToeBase"))
    first = host().detector("contacts")().detect(foot).contacts[0]
    return replace(foot, templates=(Template("space", first.start, first.end),))

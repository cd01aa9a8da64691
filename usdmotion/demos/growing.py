"""2005, section 6: a child walks, grows up on the way, and goes on; no length stays what it was."""

from pathlib import Path

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.demos.body import Proportions
from usdmotion.demos.company import Member, write_company
from usdmotion.demos.figures import Figure
from usdmotion.demos.gait import walk
from usdmotion.demos.people import Person, person
from usdmotion.humanoid import PartMap
from usdmotion.kernels import forward
from usdmotion.motion import Motion, Placement
from usdmotion.s4d import Footprint, Morphology, normalize, restore, stand

NEXT = "usdmotion inspect {stage}"
LENGTH = 4.0
"""How long it is [s]."""
GROWS = (0.8, 3.2)
"""When it begins to grow, and has grown [s]."""
SKELETON = "/Growing/Walker/Skeleton"
UP = np.array((0.0, 1.0, 0.0))


def build(output: Path) -> None:
    """Write the stage."""
    write_company(output, "Growing", [Member("Walker", child(), grow())])


def child() -> Person:
    """Return who grows, as small as at first."""
    return person(1.02, proportions=Proportions(legs=0.85, arms=0.9, head=1.5))


def adult() -> Person:
    """Return the same person, grown."""
    return person(2.2, proportions=Proportions(legs=1.1, head=0.85))


def lengths(times: Floats) -> Floats:
    """(F,) to (F, J, 3): where joints at rest are in their parents, as they grow [m]."""
    start, end = GROWS
    s = np.clip((times - start) / (end - start), 0.0, 1.0)
    share = (s**3 * (10.0 - 15.0 * s + 6.0 * s**2))[:, None, None]
    small, large = (who.skeleton.rest_translations for who in (child(), adult()))
    return np.asarray(small + share * (large - small))


def grow() -> Motion:
    """Return the walk on a body that grows, on feet that stand where they stood in the walk."""
    walking, who = walk(seconds=LENGTH), child()
    times = walking.motion.times
    still = Placement.identity(len(times))
    usual = Morphology.of(walking.skeleton, PartMap(walking.parts))
    normalized = normalize(walking.motion, still, usual, up=UP)
    small = Morphology.of(who.skeleton, PartMap(who.parts))
    motion = restore(normalized, small, still, up=UP, translations=lengths(times))
    positions, _ = forward(who.skeleton.parents, motion.translations, motion.rotations)
    prints = []
    for each in walking.stances:
        joint = walking.skeleton.index[each.joint]
        during = (times >= each.start) & (times <= each.end)
        if each.effector == "toe" and during.any():
            place = positions[during, joint].mean(axis=0)
            prints.append(Footprint(who.parts[joint], each.start, each.end, place))
    return stand(motion, still, small, prints, up=UP).motion


PICTURE = Figure(
    "2005, section 6: a child grows while it walks",
    frames=(1.0, 17.0, 33.0, 49.0, 65.0, 81.0, 97.0),
    views=("side",),
)

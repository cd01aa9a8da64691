"""2004, section 4: the centre of mass of a captured body goes ahead, the feet stay."""

import numpy as np
import pytest

from usdmotion.constraints import CenterOfMassConstraint
from usdmotion.curves import ease

LEAN, LEAN_OF_WALKS = 0.06, 0.1
"""How far the centre of mass is to go ahead [m], on a body of 1.7 m.

Walkers lean as far as in the paper. Knees that kick or leap turn by 25 degrees a frame here; a lean
of 0.1 m makes them faster by 4, in proportion to the lean and without a jump.
"""
WALKS = ("walk", "brisk-walk", "turns", "zombie")


@pytest.fixture(scope="module")
def displacement(clip):
    """Return how far the centre of mass is to be displaced [m], (F, 3): ahead and a bit down."""
    wind = ease(clip.seconds, tuple(clip.seconds[-1] * np.array([0.1, 0.4, 0.6, 0.9])))
    ahead = clip.ahead(len(wind) // 2)
    lean = (LEAN_OF_WALKS if clip.shot.stem in WALKS else LEAN) / 1.7
    return wind[:, None] * clip.height * lean * (ahead - 0.2 * clip.up)


@pytest.fixture(scope="module")
def solved(clip, ask, displacement):
    soles = [sole for side in "lr" for sole in clip.soles(side)]
    lean = CenterOfMassConstraint(
        path="Lean",
        skeleton=clip.skeleton,
        priority=2,
        supports=tuple(joint for joint, _ in soles),
        support_points=np.array([point for _, point in soles]),
        displacement=displacement,
    )
    return ask(clip, [*clip.feet(priority=1), lean])


def test_the_centre_of_mass_is_where_it_was_asked_to_be(clip, solved, displacement):
    moved = solved.after.center_of_mass(clip.body) - solved.before.center_of_mass(clip.body)
    assert solved.millimetres(moved - displacement) <= 5.0


def test_the_feet_stay_where_they_were(clip, solved):
    for side in "lr":
        for sole in clip.soles(side):
            assert solved.moved(*sole) <= 1.0

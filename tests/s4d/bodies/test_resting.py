"""How a body stands is told by how it moves, where its rest pose is none."""

from dataclasses import replace

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.kernels import conjugate, multiply, rotate
from usdmotion.motion import Motion
from usdmotion.s4d import Morphology
from usdmotion.s4d.bodies.anatomy import rest_pose
from usdmotion.s4d.bodies.resting import Resting
from usdmotion.s4d.turns import X, about, unit

from ..conftest import UP, moving


def standing(body: Morphology, heels: tuple[float, float]) -> Motion:
    """Return somebody who stands with his heels in the air, left and right [degrees]."""
    motion = moving(body, size=0.01)
    rotations = np.array(motion.rotations)
    _, orientations = rest_pose(body.skeleton)
    for side, heel in zip("lr", heels, strict=True):
        ankle = body.joint(f"{side}_talocrural")
        turn = orientations[ankle]
        down = multiply(conjugate(turn), multiply(about(X, np.radians([heel]))[0], turn))
        rotations[:, ankle] = multiply(rotations[:, ankle], down)
    return replace(motion, rotations=rotations)


def slants(body: Morphology, heels: tuple[float, float]) -> list[float]:
    """Return how far the soles that are seen are from those of a body at rest [degrees]."""
    soles = Resting.seen(body.skeleton, body.parts, standing(body, heels)).soles
    _, orientations = rest_pose(body.skeleton)
    return [
        angle(rotate(orientations[ankle], soles[ankle]), UP)
        for ankle in (body.joint(f"{side}_talocrural") for side in "lr")
    ]


def angle(a: Floats, b: Floats) -> float:
    return float(np.degrees(np.arccos(np.clip(unit(a) @ unit(b), -1.0, 1.0))))


@pytest.mark.parametrize("heels", [(0.0, 0.0), (0.0, 28.0), (35.0, 0.0)])
def test_a_foot_that_is_always_on_tiptoe_has_the_sole_of_the_other(
    body: Morphology, heels: tuple[float, float]
) -> None:
    assert max(slants(body, heels)) < 3.0


def test_feet_that_are_built_a_little_differently_keep_their_own_soles(body: Morphology) -> None:
    left, right = slants(body, (0.0, 4.0))
    assert left < 2.0
    assert 3.0 < right < 5.0

"""Knees and elbows of a body with limits, moved by a body that is built otherwise."""

import numpy as np
import pytest

from usdmotion.arrays import Floats
from usdmotion.demos.people import person
from usdmotion.humanoid import PartMap
from usdmotion.kernels import beyond_limits, forward, from_vector, limit_boxes, multiply
from usdmotion.motion import Body, Motion
from usdmotion.s4d import Morphology, hinged

from .conftest import steps

ELBOWS = ("l_elbow", "r_elbow")
FRAMES = 61


def beyond(morphology: Morphology, body: Body, motion: Motion) -> float:
    """Return how far elbows are beyond their limits at most [degrees]."""
    joints = [morphology.joint(part) for part in ELBOWS]
    boxes = limit_boxes(body.limits_min[joints], body.limits_max[joints])
    rest = morphology.skeleton.rest_rotations[joints]
    return float(np.degrees(beyond_limits(motion.rotations[:, joints], rest, *boxes)).max())


def bending(morphology: Morphology, *, tilt: float, twist: float) -> Motion:
    """Return elbows that bend and stretch about an axis that is tilted, forearms turned in."""
    skeleton = morphology.skeleton
    rotations = np.tile(skeleton.rest_rotations, (FRAMES, 1, 1))
    bend = 0.9 + 0.8 * np.sin(np.linspace(0.0, 6.0, FRAMES))
    for part, sign in zip(ELBOWS, (-1.0, 1.0), strict=True):
        joint = morphology.joint(part)
        axis = np.array((0.0, np.cos(tilt), np.sin(tilt)))
        turn = multiply(
            from_vector(sign * bend[:, None] * axis), from_vector(np.array((twist, 0.0, 0.0)))
        )
        rotations[:, joint] = multiply(rotations[:, joint], turn)
    places = np.broadcast_to(skeleton.rest_translations, (FRAMES, len(skeleton.joints), 3))
    return Motion(np.arange(FRAMES) / 30.0, places, rotations)


def poses(morphology: Morphology, motion: Motion) -> tuple[Floats, Floats]:
    return forward(morphology.skeleton.parents, motion.translations, motion.rotations)


@pytest.mark.parametrize("twist", [0.0, -0.5])
@pytest.mark.parametrize("rest", ["T", "A"])
def test_an_elbow_bends_about_its_own_hinge(rest: str, twist: float) -> None:
    made = person(rest=rest)
    morphology = Morphology.of(made.skeleton, PartMap(made.parts))
    motion = bending(morphology, tilt=0.5, twist=twist)
    rolled = hinged(motion, morphology, made.body)
    assert beyond(morphology, made.body, motion) > 30.0
    assert beyond(morphology, made.body, rolled) < 0.6
    (places, turns), (others, turned) = (poses(morphology, each) for each in (motion, rolled))
    assert np.abs(places - others).max() < 1e-9
    for part in ("l_radiocarpal", "r_radiocarpal", "skullbase", "l_talocrural"):
        joint = morphology.joint(part)
        same = np.abs(np.sum(turns[:, joint] * turned[:, joint], axis=-1))
        assert np.allclose(same, 1.0, atol=1e-9)
    assert steps(rolled.rotations).max() < 3.0 * steps(motion.rotations).max()


def test_what_is_within_its_limits_is_left_alone() -> None:
    made = person()
    morphology = Morphology.of(made.skeleton, PartMap(made.parts))
    motion = bending(morphology, tilt=0.02, twist=0.0)
    assert np.array_equal(hinged(motion, morphology, made.body).rotations, motion.rotations)


def test_a_body_without_limits_is_left_alone() -> None:
    made = person(axes=3)
    morphology = Morphology.of(made.skeleton, PartMap(made.parts))
    motion = bending(morphology, tilt=0.5, twist=0.2)
    assert np.array_equal(hinged(motion, morphology, made.body).rotations, motion.rotations)


def test_an_overstretched_elbow_is_not_rolled() -> None:
    """No roll helps where an elbow bends the wrong way; a little of that must not throw it over."""
    made = person()
    morphology = Morphology.of(made.skeleton, PartMap(made.parts))
    rotations = np.tile(made.skeleton.rest_rotations, (FRAMES, 1, 1))
    wrong = np.linspace(-0.3, 0.3, FRAMES)
    rotations[:, morphology.joint("l_elbow")] = from_vector(wrong[:, None] * (0.0, 1.0, 0.05))
    places = np.broadcast_to(made.skeleton.rest_translations, (FRAMES, len(made.parts), 3))
    motion = Motion(np.arange(FRAMES) / 30.0, places, rotations)
    rolled = hinged(motion, morphology, made.body)
    assert steps(rolled.rotations).max() < 1.5 * steps(motion.rotations).max()
